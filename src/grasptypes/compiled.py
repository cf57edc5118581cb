"""Compiled functions whose machine code is cached on disk until their sources change.

Numba keys its cache on the file of the function alone; edit a constant or a callee in another file,
and the old machine code keeps answering (its documentation lists this under "Caching limitations").
Here the key is the content of every module of this package that the function's module imports,
directly or not, so every entry point sees an edit: jobs, commands, served models and tests.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numba
from numba.core.caching import InTreeCacheLocator, UserProvidedCacheLocator, UserWideCacheLocator

from grasptypes.content_hash import CodeHash

P = ParamSpec("P")
R = TypeVar("R")

_code_hash = CodeHash()
_config: Any = numba.config  # its names are set when it is imported


class _ByReachableCode:
    """What a cache locator of Numba compares: the file's content, and all that it can reach."""

    _py_file: str

    def get_source_stamp(self) -> tuple[Any, str]:
        """A stamp that differs once any module that the function can reach does."""
        own: Any = super().get_source_stamp()  # type: ignore[misc]  # the locator's, mixed in below
        return own, _code_hash(self._py_file)


class UserProvidedLocator(_ByReachableCode, UserProvidedCacheLocator):
    """In the folder that ``NUMBA_CACHE_DIR`` names."""


class InTreeLocator(_ByReachableCode, InTreeCacheLocator):
    """In ``__pycache__`` next to the module."""


class UserWideLocator(_ByReachableCode, UserWideCacheLocator):
    """In the user's cache folder, where the module's own cannot be written."""


# In Numba's own order: the first that can be written is used.
_LOCATORS = ",".join(
    f"{__name__}.{locator.__name__}"
    for locator in (UserProvidedLocator, InTreeLocator, UserWideLocator)
)


def compiled(*, inline: bool = False) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorate a function that Numba compiles at its first call, for every later process too.

    Args:
        inline: whether callers get the function's body in place of a call.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        """The function, compiled, with a cache that knows all it calls."""
        usual = _config.CACHE_LOCATOR_CLASSES
        _config.CACHE_LOCATOR_CLASSES = _LOCATORS
        try:
            how = numba.njit(cache=True, inline="always" if inline else "never")
            return cast(Callable[P, R], how(function))
        finally:
            _config.CACHE_LOCATOR_CLASSES = usual

    return decorate

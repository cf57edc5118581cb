"""The one exception a user is meant to see."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


class InputError(ValueError):
    """Something handed in by the user cannot be used.

    Its text is a single line that names the file, the key within it, and what is allowed, so that
    it can be shown as it is, without a stack trace.

    Args:
        file: the file (or the environment variable or option) that is at fault.
        key: the key, column, row or property within it; empty if the file as a whole is.
        message: what is wrong and what would be right.
    """

    def __init__(self, file: str | Path, key: str, message: str) -> None:
        self.file = str(file)
        self.key = key
        self.message = " ".join(message.split())
        where = f"{self.file}: {key}" if key else self.file
        super().__init__(f"{where}: {self.message}")

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str]]:
        return InputError, (self.file, self.key, self.message)


@contextmanager
def parsing(file: str | Path, refusal: str) -> Iterator[None]:
    """Have a library read a user's file; whatever it raises over it becomes an :class:`InputError`.

    Damaged files lead parsers to errors that nobody lists, down to an UnboundLocalError. Memory
    that is too short is not the file's fault.

    Args:
        file: what is read.
        refusal: what to say of a file that cannot be read; the parser's own words follow.
    """
    try:
        yield
    except (InputError, MemoryError):
        raise
    except Exception as error:
        reason = str(error).split("\n")[0].split(". ")[0] or type(error).__name__
        raise InputError(file, "", f"{refusal}: {reason}") from error

"""The exception for user errors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path


class InputError(ValueError):
    """Input from the user cannot be used.

    The message is a single line that names the file, the key in it, and what is allowed, and is
    shown without a stack trace.

    Args:
        file: the file, environment variable or option with the error.
        key: the key, column, row or property in it; empty for the file as a whole.
        message: what is wrong and what is allowed.
    """

    def __init__(self, file: str | Path, key: str, message: str) -> None:
        self.file = str(file)
        self.key = key
        self.message = " ".join(message.split())
        where = f"{self.file}: {key}" if key else self.file
        super().__init__(f"{where}: {self.message}")

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str]]:
        return InputError, (self.file, self.key, self.message)


class InputErrors(Exception):
    """Several mistakes in a user's input, which are shown one line each."""

    def __init__(self, errors: Iterable[InputError]) -> None:
        self.errors = list(errors)
        super().__init__("; ".join(map(str, self.errors)))


@contextmanager
def parsing(file: str | Path, refusal: str) -> Iterator[None]:
    """Turn any error that a library raises while parsing a user's file into an :class:`InputError`.

    Parsers raise undocumented errors on damaged files, even UnboundLocalError. MemoryError is
    passed on, since it is not the file's fault.

    Args:
        file: the file being parsed.
        refusal: message for an unreadable file; the parser's own message is appended.
    """
    try:
        yield
    except (InputError, MemoryError):
        raise
    except Exception as error:
        reason = str(error).split("\n")[0].split(". ")[0] or type(error).__name__
        raise InputError(file, "", f"{refusal}: {reason}") from error

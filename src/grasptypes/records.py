"""Small JSON files of the project's own, typed and checked like the parameters."""

from __future__ import annotations

from pathlib import Path
from typing import Self

from pydantic import ValidationError

from grasptypes.errors import InputError
from grasptypes.files import write_json
from grasptypes.settings.base import Settings, explained


class Record(Settings):
    """Content of a JSON file, checked on creation and immutable."""

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """Read a file of :meth:`write`.

        Raises:
            InputError: names the file, and what is wrong with it.
        """
        try:
            return cls.model_validate_json(Path(path).read_bytes())
        except OSError as error:
            raise InputError(path, "", f"cannot be read: {error.strerror}") from error
        except ValidationError as error:
            raise explained(error, cls, path) from error

    def write(self, path: str | Path) -> None:
        """Write the fields as JSON."""
        write_json(path, self.model_dump(mode="json"))

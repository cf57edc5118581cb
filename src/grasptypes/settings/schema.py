"""JSON schema of params.yaml for editors; ``python -m grasptypes.settings.schema`` writes it."""

from __future__ import annotations

from pathlib import Path

from grasptypes.files import write_json
from grasptypes.settings.params import Params

PLACE = "workflow/schemas/params.schema.json"


def write_schema(path: str | Path = PLACE) -> None:
    """Write the schema of the settings' types."""
    write_json(path, Params.model_json_schema())


if __name__ == "__main__":
    write_schema()

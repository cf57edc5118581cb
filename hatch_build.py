"""The build hook of the wheel: it contains the parameters of the checkout it is built from."""

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class DefaultParams(BuildHookInterface[Any]):
    """Adds params.yaml to wheels; an editable install reads the checkout's own."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by Hatch before it builds a `standard` or an `editable` wheel."""
        if version == "standard":
            build_data["force_include"]["params.yaml"] = "grasptypes/params.yaml"

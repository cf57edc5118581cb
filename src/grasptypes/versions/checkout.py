"""A copy of this checkout with other parameters, for the demo and the end-to-end tests.

``python -m grasptypes.versions.checkout SOURCE TARGET CHANGES.yaml``
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import yaml

from grasptypes.errors import InputError
from grasptypes.files import write_text
from grasptypes.versions.git import git
from grasptypes.yaml_files import merge, read_yaml


def copy_checkout(source: str | Path, target: str | Path, changes: str | Path) -> None:
    """Copy the files that git tracks or would add, with changes to ``params.yaml``.

    Results of an earlier call stay in ``target``, so that a second run is incremental.

    Args:
        source: root of a git checkout.
        target: folder to write to.
        changes: YAML file whose values override those of ``params.yaml``.

    Raises:
        InputError: ``source`` is not a checkout, a YAML file cannot be read, or git is missing.
    """
    source, target = Path(source), Path(target)
    listing = git("ls-files", "-z", "--cached", "--others", "--exclude-standard", folder=source)
    params = merge(read_yaml(source / "params.yaml"), read_yaml(changes))
    for name in filter(None, listing.split("\0")):
        if (source / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source / name, target / name)
    write_text(target / "params.yaml", yaml.safe_dump(params, sort_keys=False))


if __name__ == "__main__":
    try:
        copy_checkout(*sys.argv[1:])
    except InputError as error:
        sys.exit(f"error: {error}")

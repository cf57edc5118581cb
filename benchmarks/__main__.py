"""All benchmarks in one run, printed and written to `reports/benchmarks.csv`; see `make bench`.

``python -m benchmarks [PART ...]`` prints some parts only and writes nothing.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from benchmarks.figures import FIGURE_SCHEMA, Figure, NotReady, header, line, table

from grasptypes.settings.params import Params, read_params
from grasptypes.tables import write_table
from grasptypes.yaml_files import read_yaml

TABLE = Path("reports/benchmarks.csv")
SETTINGS = Path(__file__).with_name("settings.yaml")
# Each part is a module here, with the files it needs and the command that makes them. Renders come
# last: torch's compiler must not be loaded after OpenGL (see grasptypes.renders.renderer).
PARTS = {
    "records": ("logs/benchmarks", "snakemake"),
    "idle": (".snakemake/metadata", "dvc repro"),
    "parallel": ("params.yaml", ""),
    "synthesis": ("data/contact_maps", "snakemake contact_maps"),
    "features": ("data/renders", "snakemake renders"),
    "training": ("data/features", "snakemake features data/samples.csv data/folds.csv"),
    "renders": ("data/objects", "snakemake objects"),
}


def measured(parts: list[str], settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """Print and yield what the parts measure; say why a part cannot be measured."""
    for part in parts:
        needed, maker = PARTS[part]
        try:
            if not Path(needed).exists():
                raise NotReady(f"{needed} is missing; make it with: {maker}")
            for found in importlib.import_module(f"benchmarks.{part}").measure(
                settings[part], params
            ):
                sys.stdout.write(line(found) + "\n")
                sys.stdout.flush()
                yield found
        except NotReady as reason:
            sys.stdout.write(f"{part} is left out: {reason}\n")


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description="Print all benchmarks, or some of them.")
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    asked = parser.parse_args().parts
    if unknown := set(asked) - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    parts = [part for part in PARTS if part in asked or not asked]
    sys.stdout.write(header() + "\n")
    settings, params = read_yaml(SETTINGS), read_params("params.yaml")
    found = table(measured(parts, settings, params))
    if not asked:
        write_table(found, TABLE, FIGURE_SCHEMA)


if __name__ == "__main__":
    main()

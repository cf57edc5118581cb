"""The dataset as pandas tables, by name; needs only pandas. `python load_dataset.py` lists them."""

from pathlib import Path

import pandas as pd


def load_dataset(folder: str | Path = Path(__file__).parent) -> dict[str, pd.DataFrame]:
    """The tables of a release: `load_dataset()["grasps"]` has the split of each grasp's object."""
    tables = {path.stem: pd.read_csv(path) for path in sorted(Path(folder).glob("*.csv"))}
    return tables | {"grasps": tables["grasps"].merge(tables["splits"], on="Object")}


if __name__ == "__main__":
    for name, table in load_dataset().items():
        print(f"{name}: {len(table)} rows: {', '.join(table.columns)}")

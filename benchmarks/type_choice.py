"""What choosing grasp types first saves on meshes that nobody has labelled: `plan` with the types
that `general` chooses, and with all types, for YCB objects.

`GRASPTYPES_YCB` names a checkout of elpis-lab/YCB_Dataset. Plans for which the chosen types need
all grips are the same either way, and are not made.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.files import write_text
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.loading import load_object
from grasptypes.planning.plan_comparison import tests
from grasptypes.planning.plan_contacts import grips_of
from grasptypes.planning.planner import Planner
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.shown import Hints, look
from grasptypes.reports.kind_sizes import MASSES, YCB
from grasptypes.runtime import pin_runtime

# Names the objects that are also inspected (`reports/ycb_parts.csv`).
INSPECTED = Path("docs/results/ycb_parts.csv")
ALL = GRASP_TYPES[:-1]


def rows_of(name: str, folder: Path, predictor: Predictor, jobs: int) -> list[dict[str, object]]:
    """The plans of an object, two per task, unless they are the same."""
    masses_kg = json.loads((folder / MASSES).read_text(encoding="utf-8"))
    mesh = folder / "ycb" / name / "textured.obj"
    thing = load_object(mesh, mass_kg=masses_kg.get(name), name=name)
    shown, params = look(thing, Hints(), predictor.params), predictor.params
    rows: list[dict[str, object]] = []
    for task in params.tasks:
        chosen = predictor.answer([shown], task)[0].chosen
        wanted = tuple(kind for kind in ALL if kind in chosen)
        same = set(grips_of(wanted)) == set(grips_of(ALL))
        for choice, types in (("chosen", wanted), ("all", ALL)):
            row: dict[str, object] = {"object": name, "task": task, "choice": choice}
            row |= {"types": "; ".join(types), "same": same}
            if not same:
                plan = Planner(jobs=jobs).plan(
                    thing, task, types, sessions=params.plan.comparison.sessions
                )
                right = plan.ranking.valid & plan.ranking.grasp_type.isin(wanted)
                row |= {"tests": tests(plan.attempts), "valid": int(right.sum())}
            rows.append(row)
            sys.stdout.write(f"{row}\n")
            sys.stdout.flush()
    return rows


def summary(table: pd.DataFrame) -> str:
    """Tests per valid grasp of a chosen type, and what is saved, with its standard error."""
    made = table[~table["same"]]
    sums = made.groupby(["choice", "object"])[["tests", "valid"]].sum()
    ratio = {c: sums.loc[c].sum().tests / sums.loc[c].sum().valid for c in ("chosen", "all")}
    objects = sums.loc["all"].index

    def saving(kept: pd.Index) -> float:
        one, other = (sums.loc[c].loc[kept].sum() for c in ("all", "chosen"))
        return float(one.tests / one.valid - other.tests / other.valid)

    without = [saving(objects.drop(name)) for name in objects]
    error = np.sqrt((len(without) - 1) * np.var(without))
    plans = len(made) // 2
    return (
        f"{plans} of {len(table) // 2} plans differ, of {len(objects)} objects: "
        f"{ratio['all']:.2f} tests per valid grasp of a chosen type with all types, "
        f"{ratio['chosen']:.2f} with those chosen; saved {saving(objects):.2f} ± {error:.2f}\n"
    )


if __name__ == "__main__":
    pin_runtime()
    predictor = Predictor.load()
    found = [
        row
        for name in pd.read_csv(INSPECTED)["object"]
        for row in rows_of(name, Path(os.environ[YCB]), predictor, jobs=2)
    ]
    table = pd.DataFrame(found)
    write_text("build/type_choice.csv", table.to_csv(index=False))
    sys.stdout.write(summary(table))

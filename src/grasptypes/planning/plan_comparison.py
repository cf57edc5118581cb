"""Study: does it help to choose grasp types before planning grasps?

Every object and task is planned three times with equally many sessions: with the grips of the types
chosen by a predictor that has not seen the object, with those of the types in the dataset's labels,
and with all grips in turn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
from scipy.special import expit, softmax

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.labels.samples import TYPES
from grasptypes.planning.plan_contacts import grips_of, plan_contacts
from grasptypes.planning.sessions import PlanningContext, plan_sessions
from grasptypes.predictors.answers import Answer, spelled
from grasptypes.predictors.general_protocol import OBJECTS, OCCURS, SHARES, VIEWS_WITH_SIZE
from grasptypes.predictors.members import members_by_object
from grasptypes.predictors.problem import LearningProblem
from grasptypes.predictors.protocol import try_splits

PREDICTED, LABELLED, ANY = "predicted", "labelled", "any"
CHOICES = (PREDICTED, LABELLED, ANY)

PLANNING_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "choice": pa.Column(str, pa.Check.isin(CHOICES), description="whose types are planned for"),
        "types": pa.Column(str, description="planned for, separated by semicolons"),
        "sessions": pa.Column(int, pa.Check.ge(1)),
        "tests": pa.Column(int, pa.Check.ge(0), description="hands that physics saw"),
        "valid": pa.Column(int, pa.Check.ge(0), description="sessions with a valid grasp"),
        "energy": pa.Column(float, nullable=True, description="of the best valid grasp"),
        "valid_predicted": pa.Column(int, pa.Check.ge(0), description="of a predicted type"),
        "energy_predicted": pa.Column(float, nullable=True),
        "valid_labelled": pa.Column(int, pa.Check.ge(0), description="of a type of the labels"),
        "energy_labelled": pa.Column(float, nullable=True),
    },
    strict=True,
    ordered=True,
    unique=["object", "task", "choice"],
)


class Case(NamedTuple):
    """One plan to make."""

    context: PlanningContext
    choice: str
    types: Mapping[str, Sequence[str]]
    """Grasp types by way of choosing them, of `CHOICES` without `ANY`."""


def unseen_types(
    problem: LearningProblem, seeds: int, seed: int
) -> dict[tuple[str, str], list[str]]:
    """Chosen types of every object and task, from predictors trained on all other objects.

    Variants of an object are left out with it, and have no prediction of their own. Predictions are
    averaged over the views, as for a user's mesh.

    Args:
        seeds: number of predictors per object, whose predictions are averaged too.
        seed: part of the key of every random draw.
    """
    examples = problem.examples
    members = members_by_object(examples.index["object"], seeds)
    key = ("unseen", problem.model, seed)
    predictions = try_splits(examples, members, problem.settings, key, problem.backbone).predictions
    logits = [f"logit_{kind}" for kind in TYPES]
    return {
        (str(name), str(task)): _chosen(
            softmax(rows[logits].to_numpy(), axis=-1).mean(axis=0),
            expit(rows[logits].to_numpy()).mean(axis=0),
        )
        for (name, task), rows in predictions.groupby(["object", "task"])
    }


def held_out_types(answers: pd.DataFrame) -> dict[tuple[str, str], list[str]]:
    """Types that `general` chooses for objects held out with their relatives, by size and 12 views.

    Args:
        answers: of `general_protocol.ANSWER_SCHEMA`.
    """
    rows = answers[(answers["shown"] == OBJECTS) & (answers["model"] == VIEWS_WITH_SIZE)]
    told = zip(rows[list(SHARES)].to_numpy(), rows[list(OCCURS)].to_numpy(), strict=True)
    names = zip(rows["object"], rows["task"], strict=True)
    return {name: _chosen(*answer) for name, answer in zip(names, told, strict=True)}


def _chosen(shares: np.ndarray, occurs: np.ndarray) -> list[str]:
    """The types that a predictor chooses, from shares and probabilities (types,)."""
    chosen = Answer.of("", TYPES, shares, occurs).chosen
    return [name for name in map(spelled, TYPES) if name in chosen]


def compare(
    cases: Sequence[Case], jobs: int, tell: Callable[[str], None] = lambda line: None
) -> pd.DataFrame:
    """One row per case: a table of `PLANNING_SCHEMA`, independent of the number of jobs."""
    rows = []
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        for row in pool.map(outcome, cases):
            rows.append(row)
            tell(f"{row['object']} {row['task']}, {row['choice']}: {row['tests']} tests")
    return pd.DataFrame(rows)


def outcome(case: Case) -> dict[str, Any]:
    """Make and evaluate one plan."""
    context, params = case.context, case.context.params
    types = GRASP_TYPES[:-1] if case.choice == ANY else case.types[case.choice]
    settings = params.contact_maps.changed(sessions=params.plan.comparison.sessions)
    name = context.word, context.task
    drawn = MapTask.of_object(context.geometry, name, params.seed, settings)
    contacts = plan_contacts(drawn, None, grips_of(types), context.word)
    attempts, grasps = plan_sessions(context, contacts, types)
    return {
        "object": context.geometry.name,
        "task": context.task,
        "choice": case.choice,
        "types": "; ".join(types),
        "sessions": len(grasps),
        "tests": tests(attempts),
        **_counts(attempts, "", GRASP_TYPES[:-1]),
        **_counts(attempts, "_predicted", case.types[PREDICTED]),
        **_counts(attempts, "_labelled", case.types[LABELLED]),
    }


def tests(attempts: pd.DataFrame) -> int:
    """Number of physics tests; under gravity every object moves, if only by micrometres."""
    return int((attempts.moved_m > 0).sum())


def summary(table: pd.DataFrame) -> pd.DataFrame:
    """One row per choice: tests per valid grasp, and median energy of the best, by kind of grasp.

    Energies are compared only where all three choices have a grasp of that kind.
    """
    rows = {}
    for choice in CHOICES:
        chosen = table[table.choice == choice].set_index(["object", "task"])
        row = {"sessions": chosen.sessions.sum(), "tests": chosen.tests.sum()}
        for kind in ("", "_predicted", "_labelled"):
            common = table.groupby(["object", "task"])[f"energy{kind}"].agg(
                lambda energies: bool(energies.notna().all())
            )
            count = chosen[f"valid{kind}"].sum()
            row[f"valid{kind}"] = count
            row[f"tests_per_valid{kind}"] = row["tests"] / count if count else np.nan
            row[f"energy{kind}"] = chosen[f"energy{kind}"][common].median()
        rows[choice] = row
    return pd.DataFrame(rows).T


def savings(table: pd.DataFrame) -> pd.DataFrame:
    """Tests per valid grasp of the chosen types, minus those with all types, where plans differ.

    Six types share four grips, so types that need all four grips give the same plan as all types:
    such plans say nothing about the choice and are left out.

    Returns:
        One row per choice except `ANY`: number of `plans` (object, task) that differ and of their
        `objects`, the `saving`, and its `error`: the jackknife standard error over these objects,
        NaN for fewer than two.
    """
    rows = {}
    everything = grips_of(GRASP_TYPES[:-1])
    by_choice = {c: rows.set_index(["object", "task"]) for c, rows in table.groupby("choice")}
    for choice in (PREDICTED, LABELLED):
        chosen = by_choice[choice]
        other = [grips_of(types.split("; ")) != everything for types in chosen.types]
        names = chosen.index[other]
        valid = f"valid_{choice}"
        pair = [by_choice[c].loc[names].groupby("object")[["tests", valid]].sum()
                for c in (choice, ANY)]  # fmt: skip
        without = [
            _saving(*(sums.drop(name).sum().to_numpy() for sums in pair)) for name in pair[0].index
        ]
        spread = np.sqrt((len(without) - 1) * np.var(without)) if len(without) > 1 else np.nan
        rows[choice] = {
            "plans": len(names),
            "objects": len(without),
            "saving": _saving(*(sums.sum().to_numpy() for sums in pair)),
            "error": spread,
        }
    return pd.DataFrame(rows).T


def _saving(chosen: np.ndarray, everything: np.ndarray) -> float:
    """Tests per valid grasp minus the same with all types, from (tests, valid grasps) of both."""
    if not (chosen[1] and everything[1]):
        return float("nan")
    return float(chosen[0] / chosen[1] - everything[0] / everything[1])


def text(table: pd.DataFrame) -> str:
    """The summary and the savings as Markdown."""
    kinds = {"": "of any type", "_predicted": "of a predicted type", "_labelled": "of the labels"}
    totals = summary(table)
    lines = [
        "| grips of | tests | " + " | ".join(f"valid {kind}: tests each" for kind in kinds.values())
        + " | " + " | ".join(f"best energy {kind}" for kind in kinds.values()) + " |",
        "|---" * (2 + 2 * len(kinds)) + "|",
    ]  # fmt: skip
    names = {PREDICTED: "predicted types", LABELLED: "types of the labels", ANY: "all types"}
    for choice, row in totals.iterrows():
        valid = [f"{row[f'valid{k}']:.0f}: {row[f'tests_per_valid{k}']:.2f}" for k in kinds]
        energy = [f"{row[f'energy{k}']:.2f}" for k in kinds]
        cells = [names[str(choice)], f"{row['tests']:.0f}", *valid, *energy]
        lines.append("| " + " | ".join(cells) + " |")
    count = len(table[table.choice == ANY])
    lines.append("")
    for choice, row in savings(table).iterrows():
        sentence = f"{names[str(choice)]}: other grips than with all types in {row.plans:.0f} of "
        sentence += f"{count} plans"
        if row.objects > 1:
            sentence += (
                f", of {row.objects:.0f} objects; there {row.saving:+.2f} ± {row.error:.2f} "
            )
            sentence += "tests a valid grasp of them (standard error over these objects)"
        lines.append(f"{sentence}.")
    return "\n".join(lines) + "\n"


def _counts(attempts: pd.DataFrame, suffix: str, types: Sequence[str]) -> dict[str, Any]:
    """Sessions with a valid grasp of the types among all tries, and the best energy.

    The grasp that the plan chose in each session is not used, since it depends on the types.
    """
    found = attempts[attempts.valid & attempts.grasp_type.isin(types)]
    return {f"valid{suffix}": found.session.nunique(), f"energy{suffix}": found.energy.min()}

"""The sessions of a plan: searched one by one, tested, labelled, chosen from and ranked."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import active_children, get_context
from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.hands.reading import load_hand
from grasptypes.labels.dataset import label_grasps
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.loads import task_load
from grasptypes.planning.plan_contacts import PlanContacts
from grasptypes.planning.touching import touches_avoided
from grasptypes.seeds import seed
from grasptypes.settings.params import Params
from grasptypes.settings.tasks import read_tasks
from grasptypes.synthesis.trials import SynthesisTask, synthesize


@dataclass(frozen=True)
class PlanningContext:
    """Shared by all sessions of a plan.

    Attributes:
        word: name of the object in the keys of all random draws.
        hand: name or folder of the hand.
    """

    geometry: ObjectGeometry
    task: str
    word: str
    hand: str | Path
    params: Params


def plan_sessions(
    context: PlanningContext,
    contacts: PlanContacts,
    types: Sequence[str],
    jobs: int = 1,
    tell: Callable[[str], None] = lambda line: None,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Attempts and ranked grasps of the contacts' sessions, see `Plan`.

    Args:
        types: requested grasp types, which rank before all others.
        jobs: number of processes.
        tell: called with a line for every session.
    """
    work, last = partial(_search, context, contacts), contacts.numbers[-1]
    found = []
    for attempts in _each(work, len(contacts.numbers), jobs):
        found.append(attempts)
        number, grip = attempts.session.iloc[0], attempts.grip.iloc[0]
        outcome = "holds" if attempts.valid.any() else attempts.reason.iloc[0]
        tell(f"session {number} of {last} ({grip}): {outcome}")
    table = pd.concat(found, ignore_index=True)
    grid, settings = context.geometry.distance_grid, context.params.grasp_types
    hand = load_hand(context.hand)
    labelled = label_grasps(table, hand, grid, settings)
    touch, trace = context.params.hold_fit.touch, context.params.plan.trace
    avoided = touches_avoided(labelled, contacts, hand, grid, touch, trace)
    labelled = choose(labelled.assign(touches_avoided=avoided), types)
    return labelled, ranked(labelled[labelled.chosen], types)


def choose(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled attempts with the column `chosen` set again, once per session.

    A valid grasp that keeps off avoided parts, and then one of a requested type, takes precedence
    over the one chosen by the synthesis, which knows neither.
    """
    wanted = labelled.valid & labelled.grasp_type.isin(types)
    keys = {"wrong": ~labelled.valid | labelled.touches_avoided, "other": ~wanted}
    order = labelled.assign(**keys, passed=~labelled.chosen).sort_values(
        ["session", "wrong", "other", "passed", "energy"]
    )
    return labelled.assign(chosen=labelled.index.isin(order.drop_duplicates("session").index))


def ranked(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled grasps, best first: valid ones of a requested type, other valid ones, those on parts
    that hands should avoid, then invalid ones.

    Each group is sorted by energy. `pose_index` keeps the position among the session's tries.
    """
    keys = {"failed": ~labelled.valid, "other": ~labelled.grasp_type.isin(types)}
    by = ["failed", "touches_avoided", "other", "energy", "session"]
    order = labelled.assign(**keys).sort_values(by).index
    table = labelled.loc[order].reset_index(drop=True)
    table["pose_index"], table["rank"] = table["rank"], np.arange(len(table))
    table["hand_configuration"] = [
        [float(place), *numbers[1:]]
        for place, numbers in zip(table["rank"], table.hand_configuration, strict=True)
    ]
    return table


def _each(work: Callable[[int], pd.DataFrame], count: int, jobs: int) -> Iterator[pd.DataFrame]:
    """Results for 0 to count - 1, in order, as soon as they are available.

    On Ctrl-C, which the terminal sends to every process, the workers end silently.
    """
    if jobs == 1:
        yield from map(work, range(count))
        return
    # Not a fork, which would copy an open OpenGL context and torch's threads.
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        try:
            # Workers inherit the mask of the thread that starts them, here all.
            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
            try:
                results = pool.map(work, range(count))
            finally:
                signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
            yield from results
        except KeyboardInterrupt:
            for worker in active_children():
                worker.terminate()
            raise


def _search(context: PlanningContext, contacts: PlanContacts, index: int) -> pd.DataFrame:
    """Attempts of one session, independent of the others, with its grip and tries."""
    number, params = contacts.numbers[index], context.params
    session_seed = seed("plan", context.word, context.task, number, params.seed)
    held = contacts.contact_map.session(index)
    gravity_m_s2 = params.physics.test.gravity_m_s2
    load = task_load(read_tasks()[context.task], context.geometry, gravity_m_s2)
    task = SynthesisTask(context.word, context.task, context.geometry, held, session_seed, load)
    _, attempts = synthesize(task, load_hand(context.hand), params.synthesis, params.physics)
    added = {"grip": str(held.grip[0]), "tries": len(attempts)}
    return attempts.assign(object=context.geometry.name, session=number, **added)

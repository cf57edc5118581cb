"""Grasps for one object and task: searched session by session, tested, labelled and ranked."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.labels.contacts import ContactSettings
from grasptypes.labels.dataset import label_grasps
from grasptypes.labels.grasp_type import Thresholds
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import COLLISION, DISTANCE_GRID, PROPERTIES
from grasptypes.planning.plan_contacts import PlanContacts
from grasptypes.seeds import seed
from grasptypes.synthesis.holding import PhysicsSettings, read_body
from grasptypes.synthesis.physics import physics
from grasptypes.synthesis.search import read_thing
from grasptypes.synthesis.settings import sampled_hand, search_settings
from grasptypes.synthesis.trials import Problem, ValiditySettings, synthesize


@dataclass(frozen=True)
class Workshop:
    """What every session of a plan shares.

    Attributes:
        folder: of the prepared object's files.
        urdf: the hand's.
        name: object and task.
        seed: part of the key of every draw.
        params: the whole of params.yaml.
        word: stands for the object in the keys of all draws; None: its name does.
    """

    folder: Path
    urdf: Path
    name: tuple[str, str]
    seed: int
    params: Mapping[str, Any]
    word: str | None = None

    @property
    def drawn(self) -> tuple[str, str]:
        """Object and task in the keys of all draws."""
        return self.word or self.name[0], self.name[1]


class Planned(NamedTuple):
    """What came out; both tables are labelled, see `dataset.label_grasps`."""

    attempts: pd.DataFrame
    """One row a hand that was tried: the columns of `grasps.ATTEMPT_SCHEMA` and those that
    `_search` adds."""
    grasps: pd.DataFrame
    """The chosen ones of them, one a session, best first."""


def plan(
    workshop: Workshop,
    contacts: PlanContacts,
    types: Sequence[str],
    jobs: int,
    tell: Callable[[str], None],
) -> Planned:
    """A grasp for each session of the contacts, ranked; the same for any number of jobs.

    Args:
        types: wanted grasp types; grasps of these rank before all others.
        jobs: processes at work.
        tell: takes a line on every session.
    """
    work, last = partial(_search, workshop, contacts), contacts.numbers[-1]
    found = []
    for attempts in _each(work, len(contacts.numbers), jobs):
        found.append(attempts)
        number, grip = attempts.session.iloc[0], attempts.grip.iloc[0]
        outcome = "holds" if attempts.valid.any() else attempts.reason.iloc[0]
        tell(f"session {number} of {last} ({grip}): {outcome}")
    labelled = _labelled(workshop, pd.concat(found, ignore_index=True))
    labelled = choose(labelled, types)
    return Planned(labelled, ranked(labelled[labelled.chosen], types))


def choose(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled attempts with the column `chosen` set anew, once a session.

    A valid grasp of a wanted type goes before the one that the synthesis chose, which does not
    know what is wanted.
    """
    wanted = labelled.valid & labelled.grasp_type.isin(types)
    keys = {"other": ~wanted, "passed": ~labelled.chosen}
    order = labelled.assign(**keys).sort_values(["session", "other", "passed", "energy"])
    return labelled.assign(chosen=labelled.index.isin(order.drop_duplicates("session").index))


def ranked(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled grasps, best first: valid ones of a wanted type, other valid ones, then the rest.

    Within these the energy decides. `pose_index` keeps the place among the session's tries.
    """
    keys = {"failed": ~labelled.valid, "other": ~labelled.grasp_type.isin(types)}
    order = labelled.assign(**keys).sort_values(["failed", "other", "energy", "session"]).index
    table = labelled.loc[order].reset_index(drop=True)
    table["pose_index"], table["rank"] = table["rank"], np.arange(len(table))
    table["hand_configuration"] = [
        [float(place), *numbers[1:]]
        for place, numbers in zip(table["rank"], table.hand_configuration, strict=True)
    ]
    return table


def _each(work: Callable[[int], pd.DataFrame], count: int, jobs: int) -> Iterator[pd.DataFrame]:
    """Results for 0 to count - 1, in order and as soon as they are there.

    At Ctrl-C, which the terminal sends to every process, the workers are ended without a word.
    """
    if jobs == 1:
        yield from map(work, range(count))
        return
    # A fork would copy an open OpenGL context and torch's threads.
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        try:
            # Workers start with the mask of who starts them, here all of them.
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


def _search(workshop: Workshop, contacts: PlanContacts, index: int) -> pd.DataFrame:
    """Attempts of one session, whatever sessions there are beside it, with its grip and tries."""
    folder, params, (name, task) = workshop.folder, workshop.params, workshop.drawn
    contact_map, number = contacts.contact_map, contacts.numbers[index]
    thing = read_thing(folder / DISTANCE_GRID, folder / PROPERTIES, contact_map)
    session_seed = seed("plan", name, task, number, workshop.seed)
    problem = Problem(name, task, thing, _one(contact_map, index), session_seed)
    body = read_body(folder / COLLISION, folder / PROPERTIES)
    synthesis, test = params["synthesis"], PhysicsSettings(**params["physics"]["test"])
    with physics(workshop.urdf, body, test) as world:
        _, attempts = synthesize(
            problem,
            sampled_hand(synthesis),
            world,
            search_settings(synthesis),
            ValiditySettings(**params["physics"]["validity"]),
        )
    added = {"grip": str(contact_map.grip[index]), "tries": len(attempts)}
    return attempts.assign(object=workshop.name[0], session=number, **added)


def _one(contact_map: ContactMap, index: int) -> ContactMap:
    """The contact map with one of its sessions only."""
    of_session = ("sessions", "style", "grip", "part", "approach", "closing", "centre_m", "height")
    names = (*of_session, "hand_length_m")
    row = slice(index, index + 1)
    return replace(contact_map, **{name: getattr(contact_map, name)[row] for name in names})


def _labelled(workshop: Workshop, table: pd.DataFrame) -> pd.DataFrame:
    settings = workshop.params["grasp_types"]
    grid = DistanceGrid.load(workshop.folder / DISTANCE_GRID)
    contacts = ContactSettings(**settings["contacts"])
    return label_grasps(table, grid, contacts, Thresholds(**settings["thresholds"]))

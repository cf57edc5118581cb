"""Grasps for one object and task: searched session by session, tested, labelled and ranked."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pandas as pd

from grasptypes.contact_maps.contact_map import ContactMap, MapTask
from grasptypes.errors import InputError
from grasptypes.labels.dataset import label_grasps
from grasptypes.labels.grasp import Grasp, grasps_of
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.planning.plan_contacts import MeasuredMap, PlanContacts, grips_of, plan_contacts
from grasptypes.renders.mesh_views import MESH_WORD
from grasptypes.seeds import seed
from grasptypes.settings.params import Params, checkout_params
from grasptypes.synthesis.trials import SynthesisTask, synthesize

if TYPE_CHECKING:
    from grasptypes.predictors.prediction import Predictor

URDF = "assets/barrett_hand/barrett_hand.urdf"


@dataclass(frozen=True)
class PlanningContext:
    """Shared by all sessions of a plan.

    Attributes:
        word: name of the object in the keys of all random draws.
        urdf: URDF of the hand.
    """

    geometry: ObjectGeometry
    task: str
    word: str
    urdf: Path
    params: Params


class GraspTypeRequest(NamedTuple):
    """The requested grasp types, spelled as in `GRASP_TYPES`, and who chose them."""

    types: tuple[str, ...]
    chosen_by: dict[str, Any] | None = None
    """The predictor and its answer; None if the user chose them."""


@dataclass(frozen=True)
class Plan:
    """Planned grasps for one object and task.

    Attributes:
        params: parameters of the plan.
        contact_map: name of the measured map, if any.
        attempts: one row per grasp tried, labelled: columns of `grasps.ATTEMPT_SCHEMA` and
            `dataset.label_grasps`, `grip` and `tries`.
        ranking: the chosen attempts, one per session, best first.
    """

    geometry: ObjectGeometry
    task: str
    request: GraspTypeRequest
    params: Params
    contact_map: str | None
    attempts: pd.DataFrame
    ranking: pd.DataFrame

    @property
    def grasps(self) -> list[Grasp]:
        """One grasp per session, best first; those that failed the physics test come last."""
        return grasps_of(self.ranking, self.geometry)

    def write(self, folder: str | Path) -> None:
        """Write tables, `plan.json`, exchange formats and an image to a new folder.

        The folder appears completely or not at all.

        Raises:
            OSError: the folder is not writable, or exists and is not empty.
        """
        from grasptypes.planning.plan_files import write_plan

        write_plan(self, Path(folder))


class Planner:
    """Plans grasps of any object.

    Args:
        folder: checkout with the parameters, hand and models.
        jobs: number of processes; the result does not depend on it.
        tell: called with progress messages.

    Raises:
        InputError: the folder has no valid parameters.
    """

    def __init__(
        self,
        folder: str | Path = ".",
        *,
        jobs: int = 1,
        tell: Callable[[str], None] = lambda line: None,
    ) -> None:
        self.folder = Path(folder)
        self.params = checkout_params(self.folder)
        self.jobs = jobs
        self.tell = tell
        self._predictor: Predictor | None = None

    def plan(
        self,
        object: ObjectGeometry,
        task: str,
        types: Sequence[str] = (),
        *,
        contact_map: MeasuredMap | None = None,
        sessions: int | None = None,
    ) -> Plan:
        """Plan ranked grasps of an object for a task.

        Args:
            object: object from `load_object`.
            types: requested grasp types, which rank before all others; default: chosen by the
                predictor.
            contact_map: where to touch the object; default: anywhere.
            sessions: number of ways of holding to search, one grasp each.

        Raises:
            InputError: an unknown task or type, a mass that the hand cannot lift, an unusable
                contact map, or an object that no hand can hold.
        """
        source = object.source or object.name
        wanted = self.check_request(task, types, object.properties.mass_kg, source)
        request = GraspTypeRequest(wanted) if wanted else self._predicted(object, task)
        settings = self.params.contact_maps.changed(sessions=sessions or self.params.plan.sessions)
        name, seed_number = (MESH_WORD, task), self.params.seed
        drawn = MapTask.of_object(object, name, seed_number, settings)
        contacts = plan_contacts(drawn, contact_map, grips_of(request.types), source)
        if left_out := settings.sessions - len(contacts.numbers):
            self.tell(
                f"skipped {left_out} of {settings.sessions} ways of holding: "
                "no place has opposing sides for them"
            )
        self.tell(f"searching for {', '.join(request.types)} grasps of {object.name} for {task}")
        context = PlanningContext(object, task, MESH_WORD, self.folder / URDF, self.params)
        attempts, ranking = plan_sessions(context, contacts, request.types, self.jobs, self.tell)
        used = contact_map.path.name if contact_map else None
        return Plan(object, task, request, self.params, used, attempts, ranking)

    def check_request(
        self, task: str, types: Sequence[str], mass_kg: float | None, source: str = ""
    ) -> tuple[str, ...]:
        """Check a request; returns the requested types, spelled as in `GRASP_TYPES`.

        Args:
            mass_kg: mass of the object, if known.
            source: the mesh, once it is read.

        Raises:
            InputError: an unknown task or type, a mass out of range, or no type although no trained
                predictor can choose one.
        """
        if task not in self.params.tasks:
            allowed = ", ".join(self.params.tasks)
            raise InputError("--task", task, f"unknown; allowed: {allowed}")
        low, high = self.params.plan.min_mass_kg, self.params.plan.max_mass_kg
        if mass_kg is not None and not low <= mass_kg <= high:
            allowed = f"must be {low:g} to {high:g} kg"
            if not source:
                raise InputError("--mass-kg", f"{mass_kg:g}", allowed)
            said = f"is {mass_kg:.3g} kg (as a solid of water, unless it is given); {allowed}"
            raise InputError(source, "--mass-kg", said)
        if not types and self._predictor is None:
            from grasptypes.predictors.prediction import Predictor

            self._predictor = Predictor.load(self.folder, params=self.params)
            self._predictor.check_task(task)
        return tuple(known_type(name) for name in types)

    def _predicted(self, geometry: ObjectGeometry, task: str) -> GraspTypeRequest:
        """The types that the predictor chooses for the object; the likeliest if none."""
        assert self._predictor is not None  # `check_request` has loaded it
        name = f"{geometry.name}, mean of {self.params.predict.views} views"
        answer = self._predictor.predict(geometry, task, name=name)
        described = self._predictor.describe([answer], task)
        return GraspTypeRequest(tuple(answer.grasp_types), described)


def known_type(text: str) -> str:
    """A grasp type as spelled in tables, from any spelling with spaces or underscores.

    Raises:
        InputError: the type does not exist.
    """
    kind, allowed = text.replace("_", " ").title(), GRASP_TYPES[:-1]
    if kind not in allowed:
        raise InputError("--type", text, f"unknown; allowed: {', '.join(allowed)}")
    return kind


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
    labelled = choose(label_grasps(table, grid, settings.contacts, settings.thresholds), types)
    return labelled, ranked(labelled[labelled.chosen], types)


def choose(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled attempts with the column `chosen` set again, once per session.

    A valid grasp of a requested type takes precedence over the one chosen by the synthesis, which
    does not know the request.
    """
    wanted = labelled.valid & labelled.grasp_type.isin(types)
    keys = {"other": ~wanted, "passed": ~labelled.chosen}
    order = labelled.assign(**keys).sort_values(["session", "other", "passed", "energy"])
    return labelled.assign(chosen=labelled.index.isin(order.drop_duplicates("session").index))


def ranked(labelled: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """Labelled grasps, best first: valid ones of a requested type, other valid ones, then the rest.

    Each group is sorted by energy. `pose_index` keeps the position among the session's tries.
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
    contact_map, number, params = contacts.contact_map, contacts.numbers[index], context.params
    session_seed = seed("plan", context.word, context.task, number, params.seed)
    task = SynthesisTask(
        context.word, context.task, context.geometry, _one(contact_map, index), session_seed
    )
    _, attempts = synthesize(task, context.urdf, params.synthesis, params.physics)
    added = {"grip": str(contact_map.grip[index]), "tries": len(attempts)}
    return attempts.assign(object=context.geometry.name, session=number, **added)


def _one(contact_map: ContactMap, index: int) -> ContactMap:
    """The contact map with only one of its sessions."""
    of_session = ("sessions", "style", "grip", "part", "approach", "closing", "centre_m", "height")
    names = (*of_session, "hand_length_m")
    row = slice(index, index + 1)
    return replace(contact_map, **{name: getattr(contact_map, name)[row] for name in names})

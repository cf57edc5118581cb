"""What users hold of planning: the planner, their request, and the plan."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pandas as pd

from grasptypes.contact_maps.contact_map import ContactMap, MapTask
from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.errors import InputError
from grasptypes.first_run import compiling
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.labels.grasp import Grasp, grasps_of
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.planning.demands import given_up, given_up_line, hold_as_demanded
from grasptypes.planning.held_contacts import held_contacts
from grasptypes.planning.plan_contacts import (
    MeasuredMap,
    PlanContacts,
    grips_of,
    missing_types,
    plan_contacts,
)
from grasptypes.planning.sessions import PlanningContext, plan_sessions
from grasptypes.renders.mesh_views import MESH_WORD
from grasptypes.segmentation.known_parts import known_parts
from grasptypes.segmentation.parts import Parts, described
from grasptypes.segmentation.role_files import RoleTable
from grasptypes.settings.params import Params, checkout_params

if TYPE_CHECKING:
    from grasptypes.predictors.prediction import Predictor


class GraspTypeRequest(NamedTuple):
    """The requested grasp types, spelled as in `GRASP_TYPES`, and who chose them."""

    types: tuple[str, ...]
    chosen_by: dict[str, Any] | None = None
    """The predictor and its answer; None if the user chose them."""


class Guidance(NamedTuple):
    """Where a plan holds an object, and what that is based on."""

    contacts: PlanContacts
    parts: Parts | None = None
    """None with a measured map."""
    given_up: Sequence[str] = ()
    """Parts that the task wants untouched, and that hands may touch nevertheless."""
    tells_where: bool = True
    """False if every place is as good."""


@dataclass(frozen=True)
class Plan:
    """Planned grasps for one object and task.

    Attributes:
        hand: the hand that grasps.
        params: parameters of the plan.
        contact_map: name of the measured map, if any.
        parts: the parts that people hold; None with a measured map.
        given_up: parts that the task wants untouched, and that hands may touch nevertheless.
        points: points on the surface, to which `parts` belong.
        held_where: where the sessions' people hold the object; None if every place is as good.
        attempts: one row per grasp tried, labelled: columns of `grasps.ATTEMPT_SCHEMA` and
            `dataset.label_grasps`, `grip` and `tries`.
        ranking: the chosen attempts, one per session, best first.
        contacts: of the valid grasps of `ranking`, at the end of the physics test, see
            `contact_schema`.
    """

    geometry: ObjectGeometry
    task: str
    request: GraspTypeRequest
    hand: Hand
    params: Params
    contact_map: str | None
    parts: Parts | None
    given_up: Sequence[str]
    points: SurfacePoints
    held_where: ContactMap | None
    attempts: pd.DataFrame
    ranking: pd.DataFrame
    contacts: pd.DataFrame

    @property
    def grasps(self) -> list[Grasp]:
        """One grasp per session, best first; those that failed the physics test come last."""
        return grasps_of(self.ranking, self.geometry, self.hand)

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
        folder: checkout with the parameters and models; default: the current folder, with the
            parameters that come with the package if it has none.
        hand: a hand that comes with the package, or a folder with one; default: that of the
            parameters.
        jobs: number of processes; the result does not depend on it.
        tell: called with progress messages.

    Raises:
        InputError: the folder has no valid parameters, or the hand is unknown or wrong.
    """

    def __init__(
        self,
        folder: str | Path | None = None,
        *,
        hand: str | Path | None = None,
        jobs: int = 1,
        tell: Callable[[str], None] = lambda line: None,
    ) -> None:
        self.params = checkout_params(folder)
        self.folder = Path(folder or ".")
        self.hand = load_hand(hand) if hand else load_hand(self.params.hand, self.folder)
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
        roles: RoleTable | None = None,
        sessions: int | None = None,
        mass_known: bool = False,
    ) -> Plan:
        """Plan ranked grasps of an object for a task.

        Args:
            object: object from `load_object`.
            types: requested grasp types, which rank before all others; default: chosen by the
                predictor.
            contact_map: where to touch the object; default: where people hold its parts.
            roles: roles of parts by name or colour; default: those in the object's file, or those
                that its shape tells.
            sessions: number of ways of holding to search, one grasp each.
            mass_known: whether the predictor may use the object's mass, as it was not guessed.

        Raises:
            InputError: an unknown task or type, a mass that the hand cannot lift, an unusable
                contact map, roles beside a contact map, or an object that no hand can hold.
        """
        check_guidance(contact_map, roles)
        source = object.source or object.name
        wanted = self.check_request(task, types, object.properties.mass_kg, source)
        request = GraspTypeRequest(wanted) if wanted else self._predicted(object, task, mass_known)
        if missing := missing_types(self.hand, request.types):
            self.tell(f"{self.hand.title} cannot form {', '.join(missing)}: other grips are tried")
        settings = self.params.contact_maps.changed(sessions=sessions or self.params.plan.sessions)
        name, seed_number = (MESH_WORD, task), self.params.seed
        drawn = MapTask.of_object(object, name, seed_number, settings)
        grips = grips_of(request.types)
        if contact_map:
            guidance = Guidance(plan_contacts(drawn, contact_map, grips, source))
        else:
            guidance = self._hold_parts(drawn, object, grips, roles)
        contacts = guidance.contacts
        if left_out := settings.sessions - len(contacts.numbers):
            self.tell(
                f"skipped {left_out} of {settings.sessions} ways of holding: "
                "no place has opposing sides for them"
            )
        for line in compiling():
            self.tell(line)
        self.tell(f"searching for {', '.join(request.types)} grasps of {object.name} for {task}")
        context = PlanningContext(object, task, MESH_WORD, self.hand.folder, self.params)
        attempts, ranking = plan_sessions(context, contacts, request.types, self.jobs, self.tell)
        touching = held_contacts(ranking, self.hand, object, self.params.physics.test)
        return Plan(
            geometry=object,
            task=task,
            request=request,
            hand=self.hand,
            params=self.params,
            contact_map=contact_map.path.name if contact_map else None,
            parts=guidance.parts,
            given_up=guidance.given_up,
            points=drawn.points,
            held_where=contacts.contact_map if guidance.tells_where else None,
            attempts=attempts,
            ranking=ranking,
            contacts=touching,
        )

    def _hold_parts(
        self,
        drawn: MapTask,
        object: ObjectGeometry,
        grips: Sequence[str],
        roles: RoleTable | None,
    ) -> Guidance:
        """Where people hold an object's parts for a task, or anywhere if they hold none of them."""
        task = drawn.name[1]
        parts = known_parts(object, drawn.points, self.params.segmentation, roles)
        held = hold_as_demanded(drawn, object, parts, grips, self.params)
        touched = given_up(task, held.held_parts, parts, self.params) if held else []
        contacts = held or plan_contacts(drawn, None, grips, object.source or object.name)
        self.tell(f"parts by {parts.basis}: {described(parts)}")
        if not held:
            self.tell(f"people hold none of these for {task}: every place counts the same")
        if touched:
            self.tell(given_up_line(task, touched))
        return Guidance(contacts, parts, touched, tells_where=held is not None)

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
            ModuleNotFoundError: a physics engine is not installed.
        """
        if task not in self.params.tasks:
            allowed = ", ".join(self.params.tasks)
            raise InputError("--task", task, f"unknown; allowed: {allowed}")
        low, high = self.params.plan.min_mass_kg, self.params.plan.max_mass_kg
        if mass_kg is not None and not low <= mass_kg <= high:
            allowed = f"must be {low:g} to {high:g} kg"
            if not source:
                raise InputError("--mass-kg", f"{mass_kg:g}", allowed)
            said = f"is {mass_kg:.3g} kg (that of a solid of water by default); {allowed}"
            raise InputError(source, "--mass-kg", said)
        if not types and self._predictor is None:
            from grasptypes.predictors.prediction import Predictor

            self._predictor = Predictor.load(self.folder, params=self.params)
            self._predictor.check_task(task)
        for engine in self.params.physics.test.engines:
            import_module(engine)  # a missing library shows before work starts
        return tuple(known_type(name) for name in types)

    def _predicted(self, geometry: ObjectGeometry, task: str, mass_known: bool) -> GraspTypeRequest:
        """The types that the predictor chooses for the object; the likeliest if none."""
        assert self._predictor is not None  # `check_request` has loaded it
        name = f"{geometry.name}, from {self.params.predict.views} views"
        mass_kg = geometry.properties.mass_kg if mass_known else None
        answer = self._predictor.predict(geometry, task, name=name, mass_kg=mass_kg)
        described = self._predictor.describe([answer], task)
        types = tuple(name for name in GRASP_TYPES if name in answer.chosen)
        return GraspTypeRequest(types, described)


def check_guidance(contact_map: MeasuredMap | None, roles: RoleTable | None) -> None:
    """Reject a table of roles beside a contact map, which would leave it without effect.

    Raises:
        InputError: there are both.
    """
    if contact_map and roles:
        message = "has no effect beside --contact-map, which says where to touch: give one of them"
        raise InputError("--roles", str(roles.path), message)


def known_type(text: str) -> str:
    """A grasp type as spelled in tables, from any spelling with spaces or underscores.

    Raises:
        InputError: the type does not exist.
    """
    kind, allowed = text.replace("_", " ").title(), GRASP_TYPES[:-1]
    if kind not in allowed:
        raise InputError("--type", text, f"unknown; allowed: {', '.join(allowed)}")
    return kind

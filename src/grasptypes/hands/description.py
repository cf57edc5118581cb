"""hand.yaml and grips.yaml: how a hand moves, closes and performs the grips."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from grasptypes.settings.base import Many, MisplacedError, Pair, Settings, Triple, Unique, setting

# How people hold parts: the grips of the table of holds.
GRIPS = ("wrap", "enclose", "tripod", "pinch", "rim")
Number = Annotated[float, Field(ge=-10, le=10)]
Bound = Annotated[float, Field(ge=-1, le=1)]


class PalmDescription(Settings):
    """The hand's frame: origin on the palm, +z its normal (the approach), thumb towards -y."""

    link: str = setting("URDF link that carries the palm", min_length=1)
    xyz_m: Triple[Number] = setting("origin of the hand's frame in that link's")
    rpy_rad: Triple[Number] = setting("its orientation, roll, pitch and yaw")


class FingerDescription(Settings):
    """A chain of links that closes."""

    joints: Unique[str] = setting("joints that close, from the palm outwards", min_length=1)
    open: Many[Number] = setting("positions from which they close; rad, prismatic joints m")
    rates: Many[Many[Number]] = setting(
        "row s: relative speeds after s joints have been stopped, which stay where they are"
    )
    bend_rad: Many[Number] = setting(
        "exterior angle at each joint at position zero, the first against the palm plane"
    )
    half_thickness_m: float = setting(
        "from the finger's centre line to its gripping side", gt=0, le=0.1
    )
    tip_m: Triple[Number] = setting("end of the last link, in its URDF frame")
    thumb: bool = setting("whether it opposes the other fingers", default=False)

    @model_validator(mode="after")
    def _sizes_agree(self) -> Self:
        count = len(self.joints)
        for key in ("open", "rates", "bend_rad"):
            if len(getattr(self, key)) != count:
                raise MisplacedError(key, f"needs {count} values, one per joint")
        for row, rates in enumerate(self.rates):
            if len(rates) != count:
                raise MisplacedError(f"rates.{row}", f"needs {count} values, one per joint")
            key = f"rates.{row}"
            if any(rates[:row]):
                raise MisplacedError(
                    key, f"must begin with {'0, ' * row}since these joints have stopped"
                )
            if rates[row] <= 0:
                raise MisplacedError(key, f"must be above 0 for joint {row + 1}, which closes")
        return self


class MotorDescription(Settings):
    """How the hand holds."""

    fingertip_force_n: float = setting("force at the fingertip with which it holds", gt=0, le=100)
    rated_force_n: float | None = setting(
        "largest force with which it can press, for heavy objects; default: `fingertip_force_n`",
        gt=0,
        le=1000,
        default=None,
    )
    passive_force_n: float = setting("force there that stopped joints withstand", gt=0, le=1000)
    closing_speed_rad_s: float = setting(
        "speed of a finger's first joint; prismatic joints m/s", gt=0, le=20
    )


class ExchangeDescription(Settings):
    """How other programs call the hand."""

    gripper: str = setting("name in MultiGripperGrasp files", min_length=1)
    frame: str = setting("the hand's frame in words", min_length=1)
    graspit_robot: str | None = setting("GraspIt!'s file of the hand, if it has one", default=None)


class HandDescription(Settings):
    """A hand, next to its URDF."""

    name: str = setting("name as printed", min_length=1)
    palm: PalmDescription
    preshape: dict[str, dict[str, Number]] = setting(
        "degrees of freedom set before closing: the joints that each turns, with factors; joints "
        "with the factor 0 stay at 0"
    )
    fingers: dict[str, FingerDescription] = setting(
        "fingers by the name of their degree of freedom", min_length=2, max_length=5
    )
    self_centring: bool = setting(
        "whether the fingers move together, so that the hand gives way sideways until all touch",
        default=False,
    )
    ends_at_hand: bool = setting(
        "whether the palm and the fingers closed before stop fingers that miss the object",
        default=False,
    )
    drive: Literal["coupled", "direct"] = setting(
        "coupled: one motor a finger, whose joints move at fixed rates until one is stopped; "
        "direct: one motor a joint"
    )
    motors: MotorDescription
    solver_iterations: int = setting(
        "iterations per time step with which a physics engine keeps the couplings rigid",
        ge=1,
        le=1000,
    )
    ignored_collisions: Many[Pair[str]] = setting(
        "pairs of links whose contact does not count, besides links joined by a joint"
    )
    exchange: ExchangeDescription

    @model_validator(mode="after")
    def _preshapes_move(self) -> Self:
        for name, joints in self.preshape.items():
            if not any(joints.values()):
                raise MisplacedError(f"preshape.{name}", "moves no joint: give one a factor")
        return self

    @model_validator(mode="after")
    def _has_a_thumb(self) -> Self:
        thumbs = [finger.thumb for finger in self.fingers.values()]
        if not any(thumbs) or all(thumbs):
            raise MisplacedError("fingers", "needs fingers with `thumb: true` and others without")
        return self


class ShapeRanges(Settings):
    """Ranges of the measures of a hand's shape for a grip; minimum and maximum of each."""

    palm_gap_m: Pair[Bound] = setting("gap between palm and object")
    enclosed_diameter_m: Pair[Bound] = setting("diameter of the circle in the fingers")
    sideways_share: Pair[Bound] = setting("share of the push along the palm's x axis")


class Grip(Settings):
    """How a hand performs a grip of the table of holds."""

    preshapes: Many[Many[Number]] = setting(
        "preshapes to choose from: a number for each degree of freedom", min_length=1
    )
    palm_distances_m: Many[Annotated[float, Field(ge=0, le=0.2)]] = setting(
        "from the palm to the target point", min_length=1
    )
    shape: ShapeRanges


class Grips(Settings):
    """How a hand performs the grips of the table of holds."""

    start_m: float = setting(
        "distance in front of the object at which open hands start", ge=0.1, le=2
    )
    wrap: Grip | None = None
    enclose: Grip | None = None
    tripod: Grip | None = None
    pinch: Grip | None = None
    rim: Grip | None = None
    instead: dict[str, str] = setting(
        "grips that the hand cannot perform, each with the one that takes its place",
        default_factory=dict,
    )
    sideways_share: float | None = setting(
        "sideways share of three virtual fingers, if it is not that of the fitted rule",
        gt=0,
        le=1,
        default=None,
    )

    def named(self, name: str) -> Grip:
        """The grip of this name, or the one that takes its place."""
        grip = getattr(self, self.instead.get(name, name))
        assert isinstance(grip, Grip)  # `_all_are_known` has checked it
        return grip

    @model_validator(mode="after")
    def _all_are_known(self) -> Self:
        described = [name for name in GRIPS if getattr(self, name) is not None]
        for name in GRIPS:
            if name in described and name in self.instead:
                raise MisplacedError(f"instead.{name}", "the grip is described, too")
            if name not in described and self.instead.get(name) not in described:
                allowed = ", ".join(described) or "a described grip"
                raise MisplacedError(
                    "instead", f"'{name}' is not described: name another one for it ({allowed})"
                )
        for unknown in self.instead.keys() - set(GRIPS):
            raise MisplacedError("instead", f"'{unknown}' is not one of {', '.join(GRIPS)}")
        return self

    def check_preshapes(self, count: int) -> None:
        """Check that every preshape has `count` numbers; raises MisplacedError."""
        for name in GRIPS:
            if name in self.instead:
                continue
            for index, preshape in enumerate(self.named(name).preshapes):
                if len(preshape) != count:
                    key = f"{name}.preshapes.{index}"
                    raise MisplacedError(key, f"needs one value per preshape ({count})")

"""From the roles of points to parts, and what counts before the shape."""

from types import SimpleNamespace

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.errors import InputError
from grasptypes.segmentation import known_parts as known_parts_module
from grasptypes.segmentation.known_parts import known_parts, role_in_name
from grasptypes.segmentation.parts import Parts, described, find_parts
from grasptypes.segmentation.role_files import read_role_table
from grasptypes.settings.roles import PartRole

SETTINGS = PARAMS.segmentation


class ByHeight:
    """A network that takes what is above 10 cm for a head and the rest for a handle, with some
    noise."""

    roles = ("handle", "head")

    def __init__(self, points_m):
        noise = np.random.default_rng(1).normal(0, 0.3, len(points_m))
        self.head = np.clip(0.5 + 20 * (points_m[:, 2] - 0.1) + noise, 0.02, 0.98)

    def probabilities(self, _):
        return np.column_stack([1 - self.head, self.head])


def rod(count=1500):
    """Points on a rod of 1 cm radius and 20 cm length along z, and their normals."""
    draw = np.random.default_rng(0)
    angle, height = draw.uniform(0, 2 * np.pi, count), draw.uniform(0, 0.2, count)
    normals = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
    return 0.01 * normals + np.column_stack([np.zeros((count, 2)), height]), normals


def test_neighbours_agree_on_connected_parts():
    points_m, normals = rod()
    settings = SETTINGS.changed(smoothing_steps=20)
    parts = find_parts(points_m, normals, settings, ByHeight(points_m))
    assert list(parts.roles) in (["handle", "head"], ["head", "handle"])
    for name, inside in (("head", points_m[:, 2] > 0.12), ("handle", points_m[:, 2] < 0.08)):
        assert set(parts.part_index[inside]) == {list(parts.roles).index(name)}
        assert 0.5 < parts.confidence[name] < 1


def test_parts_apart_have_names_of_their_own():
    points_m, normals = rod()
    order = np.random.default_rng(2).permutation(2 * len(points_m))
    twice = np.concatenate([points_m, points_m + [0.3, 0, 0]])[order]
    parts = find_parts(
        twice,
        np.concatenate([normals, normals])[order],
        SETTINGS.changed(smoothing_steps=20),
        ByHeight(twice),
    )
    assert sorted(parts.roles) == ["handle", "handle_2", "head", "head_2"]
    assert [part["role"] for part in parts.summary()["parts"]].count("head") == 2


def test_a_crumb_that_touches_nothing_joins_the_nearest_part():
    points_m, normals = rod(1484)
    # As many points as have no neighbours but each other, and less than the smallest part.
    crumb = points_m[:16] * 0.01 + [0.03, 0, 0.02]
    points_m, normals = np.concatenate([points_m, crumb]), np.concatenate([normals, normals[:16]])
    settings = SETTINGS.changed(smallest_share=0.02, neighbours=12)
    parts = find_parts(points_m, normals, settings, ByHeight(points_m))
    assert sorted(parts.roles) == ["handle", "head"]
    assert set(parts.part_index[-16:]) == {list(parts.roles).index("handle")}


@pytest.mark.parametrize(
    ("name", "role"),
    [
        ("handle", "handle"),
        ("Handle.001", "handle"),
        ("blade_2", "blade"),
        ("Grip Body", "grip_body"),
    ],
)
def test_names_of_parts_state_roles(name, role):
    assert role_in_name(name).role == role


@pytest.mark.parametrize("name", ["body", "geometry_0", "handlebar", ""])
def test_other_names_state_none(name):
    assert role_in_name(name) is None


def thing(names, roles):
    """An object of which only the names of its parts and their roles matter."""
    return SimpleNamespace(
        name="thing",
        surface=SimpleNamespace(part_names=names),
        properties=SimpleNamespace(roles=roles),
    )


def points():
    points_m, normals = rod(40)
    return SurfacePoints(points_m, normals, (np.arange(40) % 2).astype(np.int16))


def table(folder, text):
    path = folder / "roles.csv"
    path.write_text(text)
    return read_role_table(path)


def test_what_a_user_says_counts_first_then_the_file_then_names(tmp_path):
    said = table(tmp_path, "part,role,attributes\nhandle,blade,hot; wet\n")
    names, roles = ["handle", "top"], {"top": {"role": "lid"}}
    by_user = known_parts(thing(names, roles), points(), SETTINGS, said)
    assert by_user.roles["handle"].role == "blade"
    assert by_user.roles["handle"].all_attributes == ("sharp", "hot", "wet")
    assert by_user.roles["top"] is None
    by_file = known_parts(thing(names, roles), points(), SETTINGS)
    assert [part and part.role for part in by_file.roles.values()] == [None, "lid"]
    by_name = known_parts(thing(names, {}), points(), SETTINGS)
    assert [part and part.role for part in by_name.roles.values()] == ["handle", None]
    assert len({by_user.basis, by_file.basis, by_name.basis}) == 3


def test_without_a_word_the_shape_counts(monkeypatch):
    found = Parts(np.zeros(40, dtype=np.int16), {"ball": PartRole(role="ball")}, {"ball": 0.7}, "x")
    monkeypatch.setattr(known_parts_module, "find_parts", lambda *_: found)
    assert known_parts(thing(["body"], {}), points(), SETTINGS) is found
    assert described(found) == "ball 0.70"


def test_a_user_may_not_speak_of_parts_that_are_not_there(tmp_path):
    said = table(tmp_path, "part,role\nlid,lid\n")
    with pytest.raises(
        InputError, match=r"roles\.csv: lid: thing has no part 'lid'; its parts: a, b"
    ):
        known_parts(thing(["a", "b"], {}), points(), SETTINGS, said)

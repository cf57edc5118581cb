"""The kinds of the package: complete, closed, in one piece, and different from shape to shape."""

import pytest
import torchvision
import trimesh

from grasptypes.kinds.library import read_kind
from grasptypes.kinds.modelling import build_shape, dimensions, draw_shape, extreme_volumes
from grasptypes.kinds.names import kind_files, kind_names, kind_texts, shape_names, shape_of
from grasptypes.objects import solids
from grasptypes.objects.preparation import face_parts, joined, scaled_parts
from grasptypes.objects.role_meshes import role_mesh
from grasptypes.settings.roles import read_roles
from grasptypes.settings.tasks import read_tasks

GROUPS = [path.stem for path in kind_files()]
# A piece below this is a bubble of rounding in a joint.
SMALLEST_M3 = 1e-7
MOST_TRIANGLES = 80_000


def of_group(group):
    return [name for name, other in kind_names().items() if other == group]


def test_there_are_enough_kinds():
    assert len(kind_names()) >= 150
    assert kind_texts().keys() == kind_names().keys()


@pytest.mark.parametrize("group", GROUPS)
def test_every_kind_is_closed_and_in_one_piece(group):
    for kind in of_group(group):
        parts = scaled_parts(build_shape(f"{kind}_s01").model, 1.0)
        whole = joined(parts)
        pieces = [piece for piece in whole.decompose() if abs(piece.volume()) > SMALLEST_M3]
        assert len(pieces) == 1, kind
        assert whole.num_tri() < MOST_TRIANGLES, kind
        assert len(set(face_parts(whole, parts))) == len(parts), f"{kind}: a part is hidden"


def test_every_kind_has_a_part_that_both_tasks_touch():
    for kind in kind_names():
        roles = {part.role for part in read_kind(kind).parts.values()}
        for task in ("use", "handoff"):
            touched = {role for role, weight in read_tasks()[task].touched.items() if weight > 0}
            assert roles & touched, f"{kind}: {task}"


def test_imagenet_has_the_classes_that_kinds_name():
    known = set(torchvision.models.MobileNet_V2_Weights.IMAGENET1K_V1.meta["categories"])
    for kind in kind_names():
        assert known.issuperset(read_kind(kind).imagenet), kind


def test_shapes_differ_and_stay_within_their_ranges():
    kind = read_kind("mug")
    drawn = [dimensions(kind, draw_shape(kind, "mug", number)) for number in (1, 2, 3)]
    for name, size in kind.sizes.items():
        values = [shape[name] for shape in drawn]
        assert len(set(values)) == 3
        assert all(size.low <= value <= size.high for value in values)


def test_a_shape_depends_on_its_name_only():
    first, again = (solids.to_mesh(build_shape("mug_s02").model.parts[0].solid) for _ in range(2))
    assert (first[0] == again[0]).all()
    assert (first[1] == again[1]).all()


def test_larger_shapes_are_heavier():
    low, high = extreme_volumes("padlock")
    shapes = [build_shape(name) for name in shape_names("padlock", 3)]
    volumes = [solids.union(*(part.solid for part in each.model.parts)).volume() for each in shapes]
    heaviest = max(range(3), key=lambda index: volumes[index])
    masses = [each.mass_kg for each in shapes]
    assert low < min(volumes)
    assert max(volumes) < high
    assert max(masses) == masses[heaviest]


def test_every_face_of_a_mesh_has_a_role():
    parts = scaled_parts(build_shape("claw_hammer_s01").model, 1.0)
    with trimesh.util.BytesIO(role_mesh(parts)) as file:
        mesh = trimesh.load(file, file_type="ply", process=False)
    data = mesh.metadata["_ply_raw"]["face"]["data"]
    order = list(read_roles().roles)
    roles = {order[int(role)] for role in data["role"].ravel()}
    assert roles == {"handle", "head", "working_end"}
    assert mesh.is_watertight


def test_names_of_shapes_lead_back_to_their_kind():
    assert shape_of(shape_names("door_key", 12)[-1]) == ("door_key", 12)
    with pytest.raises(ValueError, match="no shape"):
        shape_of("door_key")

"""What the page of the viewer contains, read back from its text."""

import base64
import gzip
import json
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh
from tests.unit.viewer_data import HAND, write_dataset

from grasptypes.__main__ import main
from grasptypes.errors import InputError
from grasptypes.objects.object_files import Surface, read_surface
from grasptypes.viewer.grasp_views import dataset_views, load_views
from grasptypes.viewer.page import page
from grasptypes.viewer.shown_object import ShownPart, surface_parts


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_dataset(tmp_path_factory.mktemp("checkout") / "data")


def parts_of(text: str) -> tuple[dict, dict[str, bytes]]:
    content = re.search(r'id="content">(.*?)</script>', text, re.S)[1]
    stores = re.findall(r'<script type="text/plain" id="([^"]+)">(.*?)</script>', text)
    return json.loads(content), {
        name: gzip.decompress(base64.b64decode(text)) for name, text in stores
    }


def test_the_page_has_every_grasp_with_its_contacts(dataset: Path) -> None:
    content, stores = parts_of(page(dataset_views(dataset, HAND)))
    assert set(stores) == {"hand", "object can", "object jar"}
    assert len(content["grasps"]) == 12
    first = content["grasps"][0]
    assert (first["object"], first["task"], first["rank"]) == ("can", "use", 3)
    assert first["forces"] == [[-12.0, 0.0, 0.0], [0.0, -3.0, 0.0]]
    assert len(first["joints"][0]) == len(HAND.joints)
    assert [g["facts"]["reason"] for g in content["grasps"][:3]] == ["valid", "valid", "dropped"]


def test_meshes_and_maps_come_back_within_a_step(dataset: Path) -> None:
    content, stores = parts_of(page(dataset_views(dataset, HAND, "can")))
    shown = content["objects"]["can"]
    offset, kind, length = shown["surface"]["vertices"]
    steps = np.frombuffer(stores["object can"], kind, length, offset).reshape(-1, 3)
    found = shown["surface"]["low"] + steps / 65535 * np.array(shown["surface"]["extent"])
    surface = read_surface(dataset.parent / "objects/can/surface.npz")
    np.testing.assert_allclose(found, surface.vertices, atol=2e-6)
    offset, kind, length = shown["maps"]["use"]
    heat = np.frombuffer(stores["object can"], kind, length, offset) / 255
    assert heat.min() < 0.05
    assert heat.max() > 0.95


def test_a_surface_is_cut_into_parts_in_the_materials_beside_them() -> None:
    box = trimesh.creation.box((0.1, 0.1, 0.1)).subdivide().subdivide()
    index = (box.vertices[:, 2] > 0).astype(np.int16)
    surface = Surface(box.vertices, box.faces, index, np.array(["base", "lid"]))
    seen = [
        ShownPart("", "", colour, 0.0, 0.5, trimesh.creation.box((0.1, 0.1, 0.05)))
        for colour in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    ]
    seen[0].mesh.apply_translation((0, 0, -0.025))
    seen[1].mesh.apply_translation((0, 0, 0.025))
    base, lid = surface_parts(surface, {"lid": "lid"}, seen)
    assert [(part.name, part.role, part.colour) for part in (base, lid)] == [
        ("base", "", (1.0, 0.0, 0.0)),
        ("lid", "lid", (0.0, 0.0, 1.0)),
    ]
    assert base.mesh.area + lid.mesh.area == pytest.approx(box.area)
    assert lid.mesh.vertices[:, 2].min() > -0.03


def test_the_page_depends_on_its_data_only(dataset: Path) -> None:
    assert page(dataset_views(dataset, HAND)) == page(dataset_views(dataset, HAND))


def test_the_command_writes_one_object_of_a_checkout(
    dataset: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    root, target = dataset.parents[1], tmp_path / "can.html"
    (root / "params.yaml").write_bytes((Path(__file__).parents[1] / "params.yaml").read_bytes())
    main(["view", "can", "--folder", str(root), "--output", str(target)])
    assert "6 grasps" in capsys.readouterr().out
    content, _ = parts_of(target.read_text())
    assert {grasp["object"] for grasp in content["grasps"]} == {"can"}
    with pytest.raises(InputError, match="there is no cup; it has can, jar"):
        load_views("cup", root, None)
    with pytest.raises(InputError, match="no such file or folder"):
        load_views("cup", None, None)

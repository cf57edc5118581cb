"""`grasptypes inspect`: what it prints and writes, and that a user's roles count."""

import json

import numpy as np
import pytest
import trimesh
import yaml
from PIL import Image
from tests.unit.settings import PARAMS, RAW

from grasptypes.__main__ import main
from grasptypes.inspection.inspection import inspect_object
from grasptypes.objects.loading import load_object


@pytest.fixture(scope="module")
def mallet(tmp_path_factory):
    """A GLB of a handle along z and a block across its end, whose names say nothing; a PLY of
    the same beside it."""
    scene = trimesh.Scene()
    handle = trimesh.creation.cylinder(0.014, 0.2, sections=32)
    head = trimesh.creation.box((0.1, 0.06, 0.06)).apply_translation((0, 0, 0.13))
    for name, mesh, colour in (("wood", handle, (200, 160, 90)), ("steel", head, (90, 90, 200))):
        mesh.visual = trimesh.visual.ColorVisuals(mesh, vertex_colors=(*colour, 255))
        scene.add_geometry(mesh, geom_name=name, node_name=name)
    path = tmp_path_factory.mktemp("mallet") / "mallet.glb"
    scene.export(path)
    trimesh.util.concatenate([handle, head]).export(path.with_suffix(".ply"))
    return path


def inspected(mallet, capsys, *words):
    main(["inspect", str(mallet), *map(str, words)])
    return capsys.readouterr().out


def roles_csv(folder, text):
    path = folder / "roles.csv"
    path.write_text(f"part,role\n{text}\n")
    return path


def test_without_a_word_the_shape_tells_the_roles(mallet, capsys):
    found = json.loads(inspected(mallet, capsys, "--json", "--task", "use"))
    assert found["basis"] == "its shape"
    assert found["extents_m"] == pytest.approx([0.1, 0.06, 0.26], abs=1e-3)
    assert not found["mass_given"]
    largest = found["parts"][0]
    assert 0 < largest["confidence"] < 1
    assert sum(part["area_share"] for part in found["parts"]) == pytest.approx(1, abs=1e-3)
    shares = [hold["probability"] for hold in found["tasks"]["use"]]
    assert sum(shares) == pytest.approx(1, abs=0.01)
    assert shares == sorted(shares, reverse=True)


@pytest.mark.parametrize(
    ("suffix", "parts", "held"),
    [
        (".glb", "wood,handle\nsteel,head", "wood"),
        (".ply", "#c8a05a,handle\n#5a5ac8,head", "#c8a05a"),
    ],
)
def test_a_user_names_parts_by_name_or_colour(mallet, capsys, tmp_path, suffix, parts, held):
    words = ("--roles", roles_csv(tmp_path, parts), "--task", "strike", "--mass-kg", 0.5)
    folder = small_folder(tmp_path)
    text = inspected(mallet.with_suffix(suffix), capsys, *words, "--folder", folder)
    assert "roles from roles.csv" in text
    assert "0.5 kg (given)" in text
    ways = text.split("strike:")[1].splitlines()
    assert {line.split()[-1] for line in ways if "%" in line} == {held}


def test_a_handle_that_is_all_there_is_to_hold_is_named(mallet, capsys, tmp_path):
    roles = roles_csv(tmp_path, "wood,handle\nsteel,blade")
    text = inspected(mallet, capsys, "--roles", roles, "--task", "handoff")
    assert text.endswith("handoff: wood cannot be left untouched, as nothing else can be held\n")


def small_folder(tmp_path):
    """A checkout whose only task is strike."""
    text = yaml.safe_dump({**RAW, "tasks": {"strike": {"colour_shift": 10}}})
    (tmp_path / "params.yaml").write_text(text)
    return tmp_path


def test_nobody_holds_what_has_no_role_for_the_task(mallet, capsys, tmp_path):
    text = inspected(mallet, capsys, "--roles", roles_csv(tmp_path, "steel,screen"))
    assert "use: people hold none of these parts" in text


def test_it_draws_parts_and_contact_maps(mallet, capsys, tmp_path):
    picture, page = tmp_path / "mallet.png", tmp_path / "mallet.html"
    roles = roles_csv(tmp_path, "wood,handle\nsteel,head")
    text = inspected(mallet, capsys, "--roles", roles, "--output", picture, "--page", page)
    assert f"written: {picture}" in text
    image = np.asarray(Image.open(picture).convert("RGB")).astype(int)
    assert image.shape[1] > image.shape[0]
    assert (np.abs(image - image[0, 0]).sum(axis=2) > 60).mean() > 0.05
    assert '"role":"handle"' in page.read_text()


def test_the_same_mesh_gets_the_same_parts(mallet):
    geometry = load_object(mallet, settings=PARAMS.objects)
    first, second = (inspect_object(geometry, ["use"], PARAMS).summary() for _ in range(2))
    assert first == second

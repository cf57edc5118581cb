"""The release of the dataset, read with the libraries of others."""

from __future__ import annotations

import ast
import io
import json
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import frictionless
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
import trimesh
import yaml
import yourdfpy
from PIL import Image
from repository import Repository

import grasptypes
from grasptypes.errors import InputError
from grasptypes.release.writing import with_parts, write_release
from grasptypes.viewer.grasp_views import load_views

OBJECTS = ["banana", "mug"]


@pytest.fixture(scope="module")
def release(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("release") / "release"
    write_release(complete.path, folder)
    return folder


def test_the_description_passes_its_own_validator(release: Path) -> None:
    report = frictionless.validate(release / "datapackage.json")
    assert report.flatten(["name", "type", "message"]) == []
    package = json.loads((release / "datapackage.json").read_text())
    described = {resource["path"] for resource in package["resources"]}
    files = {path.relative_to(release).as_posix() for path in release.rglob("*") if path.is_file()}
    assert files - described == {"datapackage.json", "SHA256SUMS"}
    tables = [resource["schema"] for resource in package["resources"] if "schema" in resource]
    fields = [field for table in tables for field in table["fields"]]
    assert [field["name"] for field in fields if not field["description"]] == []
    assert package["version"] == grasptypes.__version__


def test_the_checksums_are_those_of_sha256sum(release: Path) -> None:
    command = ["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"]
    done = subprocess.run(command, cwd=release, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_csv_and_parquet_hold_the_same_grasps(release: Path, complete: Repository) -> None:
    table = pd.read_csv(release / "grasps.csv")
    pd.testing.assert_frame_equal(pq.read_table(release / "grasps.parquet").to_pandas(), table)
    ours = pd.read_csv(complete.path / "data/grasps.csv")
    pd.testing.assert_frame_equal(table, ours, rtol=1e-12)


def test_every_valid_grasp_has_contacts(release: Path) -> None:
    table, contacts = (pd.read_csv(release / f"{name}.csv") for name in ("grasps", "contacts"))
    assert set(table.Index[table.reason == "valid"]) <= set(contacts.Index)
    normals = contacts[["normal_x", "normal_y", "normal_z"]].to_numpy()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    assert (contacts.force_n >= 0).all()


def test_pandas_alone_loads_it(release: Path) -> None:
    code = (
        "import sys; from load_dataset import load_dataset\n"
        "tables = load_dataset()\n"
        "print(len(tables['grasps']), *tables['grasps'].split.unique())\n"
        "print([name for name in ('grasptypes', 'trimesh', 'pandera') if name in sys.modules])"
    )
    words = [sys.executable, "-B", "-c", code]
    done = subprocess.run(
        words, cwd=release, capture_output=True, text=True, check=True, env={"HOME": str(release)}
    )
    assert done.stdout.splitlines() == ["16 fitted", "[]"]
    script = release / "load_dataset.py"
    listed = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert "grasps: 16 rows: Index, Object" in listed.stdout


@pytest.mark.parametrize("name", OBJECTS)
def test_a_glb_has_a_node_for_every_part(release: Path, name: str) -> None:
    parts = pd.read_csv(release / "parts.csv", keep_default_na=False).query("Object == @name")
    scene = trimesh.load_scene(release / "objects" / f"{name}.glb")
    assert set(scene.graph.nodes_geometry) == set(parts.node)
    named = dict(zip(parts.node, parts.part, strict=True))
    extras = node_extras(scene)
    assert {node: said["part"] for node, said in extras.items()} == named
    roles = dict(zip(parts.node, parts.role, strict=True))
    assert {node: said.get("role", "") for node, said in extras.items()} == roles
    assert any(roles.values())
    assert scene.extents.max() < 0.5
    assert scene.to_mesh().area == pytest.approx(parts.area_m2.sum(), rel=0.02)
    assert trimesh.load_mesh(release / "objects" / f"{name}_collision.obj").volume > 0


def test_nodes_say_the_role_of_their_part(release: Path) -> None:
    glb = with_parts((release / "objects/mug.glb").read_bytes(), {"handle": "handle"})
    scene = trimesh.load_scene(io.BytesIO(glb), file_type="glb")
    roles = {extras["part"]: extras.get("role") for extras in node_extras(scene).values()}
    assert roles == {"rim": None, "wall": None, "base": None, "handle": "handle"}


def node_extras(scene: trimesh.Scene) -> dict[str, dict[str, str]]:
    """The extras of the nodes that show something."""
    edges = scene.graph.transforms.edge_data
    shown = set(scene.graph.nodes_geometry)
    return {node: data["metadata"] for (_, node), data in edges.items() if node in shown}


def test_images_are_those_of_the_tables(release: Path) -> None:
    views, grasps = (pd.read_csv(release / f"{name}.csv") for name in ("views", "grasps"))
    for name in OBJECTS:
        with zipfile.ZipFile(release / "images/renders" / f"{name}.zip") as archive:
            assert archive.testzip() is None
            numbers = [int(Path(member).stem) for member in archive.namelist()]
            assert numbers == views[views.object == name]["view"].tolist()
            assert Image.open(archive.open(archive.namelist()[0])).size == (96, 96)
        with zipfile.ZipFile(release / "images/screenshots" / f"{name}.zip") as archive:
            images = {Path(image).name for image in grasps[grasps.Object == name].Image}
            assert set(archive.namelist()) == images


def hand_model(urdf: Path) -> yourdfpy.URDF:
    """The URDF with its meshes, which yourdfpy finds only if the path is a text."""
    return yourdfpy.URDF.load(
        str(urdf), load_collision_meshes=True, build_collision_scene_graph=True
    )


def _read_images(path: Path) -> int:
    with zipfile.ZipFile(path) as archive:
        for member in archive.namelist():
            Image.open(archive.open(member)).load()
        return len(archive.namelist())


def _read_text(path: Path) -> int:
    return len(path.read_text(encoding="utf-8"))


# A library of others for every kind of file, and what it finds.
READERS = {
    ".csv": lambda path: len(pd.read_csv(path)),
    ".parquet": lambda path: pq.read_table(path).num_rows,
    ".glb": lambda path: len(trimesh.load_scene(path).geometry),
    ".obj": lambda path: len(trimesh.load_mesh(path).faces),
    ".urdf": lambda path: len(hand_model(path).scene.geometry),
    ".yaml": lambda path: len(yaml.safe_load(path.read_text(encoding="utf-8"))),
    ".json": lambda path: len(json.loads(path.read_text(encoding="utf-8"))),
    ".zip": _read_images,
    ".py": lambda path: len(ast.parse(path.read_text(encoding="utf-8")).body),
    ".md": _read_text,
    "": _read_text,
}


def test_libraries_of_others_read_every_file(release: Path) -> None:
    files = [path for path in release.rglob("*") if path.is_file()]
    assert {path.suffix for path in files} == set(READERS)
    assert [path.name for path in files if READERS[path.suffix](path) == 0] == []


def test_the_viewer_shows_it(release: Path) -> None:
    views = load_views(str(release), None, None)
    assert len(views.grasps) == 16
    assert {part.name: part.role for part in views.objects["mug"].parts}["handle"] == "handle"
    for grasp in views.grasps:
        valid = grasp.facts["reason"] == "valid"
        assert valid <= (len(grasp.contacts.links) > 0)
        assert grasp.contacts.forces_n is not None


def test_the_hand_is_a_urdf_with_its_meshes(release: Path) -> None:
    urdf = release / "hands/barrett/hand.urdf"
    hand = hand_model(urdf)
    assert len(hand.robot.joints) >= 8
    assert all(geometry.area > 0 for geometry in hand.collision_scene.geometry.values())
    for mesh in ET.parse(urdf).iter("mesh"):
        assert (urdf.parent / mesh.attrib["filename"]).is_file()


def test_load_release_gives_typed_tables_hand_and_meshes(release: Path) -> None:
    loaded = grasptypes.load_release(release)
    assert len(loaded.grasps) == 16
    assert loaded.grasps.Session.dtype == "int64"
    assert set(loaded.tables["splits"].Object) == set(OBJECTS)
    assert not loaded.tables["parts"].isna().any().any()
    assert loaded.hand.title == "BarrettHand"
    assert loaded.mesh("mug").is_file()
    with pytest.raises(InputError, match="it has banana, mug"):
        loaded.mesh("cup")


def test_a_damaged_release_is_refused(release: Path, tmp_path: Path) -> None:
    folder = tmp_path / "release"
    shutil.copytree(release, folder)
    (folder / "splits.csv").write_text("Object,split\n")
    with pytest.raises(InputError, match=r"splits.csv: differs from its checksum"):
        grasptypes.load_release(folder)
    (folder / "splits.csv").unlink()
    with pytest.raises(InputError, match=r"splits.csv: is missing"):
        grasptypes.load_release(folder)
    with pytest.raises(InputError, match="is no release"):
        grasptypes.load_release(tmp_path)
    with pytest.raises(InputError, match="not empty"):
        write_release(tmp_path, folder)


def test_a_release_depends_on_the_data_only(
    release: Path, complete: Repository, tmp_path: Path
) -> None:
    write_release(complete.path, tmp_path / "again")
    first, second = (
        (folder / "SHA256SUMS").read_text() for folder in (release, tmp_path / "again")
    )
    assert first == second


def test_nothing_is_left_of_a_release_that_lacks_data(changed: Repository, tmp_path: Path) -> None:
    (changed.path / "data/screenshots/mug.zip").unlink()
    with pytest.raises(InputError, match=r"mug.zip: is missing"):
        write_release(changed.path, tmp_path / "release")
    assert [path.name for path in tmp_path.iterdir()] == ["repository"]

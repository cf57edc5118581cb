"""Contact maps are read as ContactDB publishes them; other files are rejected."""

import numpy as np
import pytest
import trimesh
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.objects.contact_scan import read_contact_scan


@pytest.fixture
def ball():
    return trimesh.creation.icosphere(subdivisions=2, radius=0.04)


def test_red_is_the_intensity_and_zero_unseen(ball, tmp_path):
    red = np.arange(len(ball.vertices)) % 256
    colours = np.column_stack([red, 0 * red, 0 * red, 0 * red + 255]).astype(np.uint8)
    ball.visual.vertex_colors = colours
    ball.export(tmp_path / "map.ply")
    scan = read_contact_scan(tmp_path / "map.ply")
    assert scan.points_m == pytest.approx(ball.vertices, abs=1e-6)
    assert np.array_equal(np.isnan(scan.intensity), red == 0)
    assert np.nanmax(scan.intensity) == pytest.approx(red.max() / 255)


def test_colours_count_whatever_else_the_file_has(ball, tmp_path):
    """Texture coordinates a vertex and a corner, and the name of a texture."""
    red = np.arange(len(ball.vertices)) % 200 + 20
    head = [
        "ply", "format ascii 1.0", "comment TextureFile gone.png",
        f"element vertex {len(red)}", *(f"property float {axis}" for axis in "xyzst"),
        *(f"property uchar {name}" for name in ("red", "green", "blue", "alpha")),
        f"element face {len(ball.faces)}", "property list uchar int vertex_indices",
        "property list uchar float texcoord", "end_header",
    ]  # fmt: skip
    rows = [[*v, 0.5, 0.25, r, 0, 0, 255] for v, r in zip(ball.vertices, red, strict=True)]
    rows += [[3, *face, 6, *np.arange(6) / 6] for face in ball.faces]
    (tmp_path / "a.ply").write_text("\n".join([*head, *(" ".join(map(str, r)) for r in rows)]))
    scan = read_contact_scan(tmp_path / "a.ply")
    assert scan.points_m == pytest.approx(ball.vertices)
    assert scan.intensity == pytest.approx(red / 255)


def test_a_texture_is_refused(ball, tmp_path):
    ball.visual = trimesh.visual.TextureVisuals(
        uv=np.zeros((len(ball.vertices), 2)), image=Image.new("RGB", (4, 4))
    )
    ball.export(tmp_path / "texture.ply")
    with pytest.raises(InputError, match="texture"):
        read_contact_scan(tmp_path / "texture.ply")

"""What the hand looks like lies where its collision shapes lie."""

import numpy as np
import trimesh

from grasptypes.hand import kinematics, shapes
from grasptypes.hand.visuals import MATERIALS, link_visuals


def test_every_link_shows_closed_solids_of_known_materials() -> None:
    assert len(link_visuals()) == len(kinematics.LINK_NAMES)
    for link in link_visuals():
        for visual in link:
            assert visual.material in MATERIALS
            mesh = trimesh.Trimesh(visual.vertices_m, visual.faces, process=False)
            assert mesh.is_watertight, visual.name
            assert mesh.volume > 0


def test_what_is_seen_is_as_large_as_what_collides() -> None:
    # The pins of the joints stand out by some millimetres.
    for link, collision in zip(link_visuals(), shapes.link_meshes(), strict=True):
        points = np.concatenate([visual.vertices_m for visual in link])
        seen = np.array([points.min(axis=0), points.max(axis=0)])
        np.testing.assert_allclose(seen, collision.bounds, atol=0.004)


def test_gripping_faces_are_rubber() -> None:
    for link, name in zip(link_visuals(), kinematics.LINK_NAMES, strict=True):
        rubber = any(visual.material == "rubber" for visual in link)
        assert rubber == (not name.startswith("knuckle")), name

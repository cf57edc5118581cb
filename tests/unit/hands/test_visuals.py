"""What the BarrettHand looks like lies where its collision shapes lie."""

import numpy as np
import trimesh
from tests.unit.barrett import BARRETT

from grasptypes.hands.surface import link_meshes
from grasptypes.renders.gallery import METALLIC, ROUGHNESS


def test_every_link_shows_closed_solids_of_known_materials() -> None:
    for link in BARRETT.links:
        assert link.visuals
        for visual in link.visuals:
            assert visual.material in ROUGHNESS
            mesh = trimesh.Trimesh(visual.vertices_m, visual.faces, process=False)
            assert mesh.is_watertight, visual.name
            assert mesh.volume > 0


def test_colours_are_those_of_the_materials() -> None:
    colours = {(visual.material, visual.rgba) for link in BARRETT.links for visual in link.visuals}
    assert len(colours) == len(dict(colours)) == 3
    # Aluminium is the lightest; only metal that shines is metallic.
    assert max(colours, key=lambda colour: sum(colour[1]))[0] == "aluminium"
    assert set(METALLIC) == {"aluminium"}


def test_what_is_seen_is_as_large_as_what_collides() -> None:
    # The pins of the joints stand out by some millimetres.
    for link, collision in zip(BARRETT.links, link_meshes(BARRETT), strict=True):
        points = np.concatenate([visual.vertices_m for visual in link.visuals])
        seen = np.array([points.min(axis=0), points.max(axis=0)])
        np.testing.assert_allclose(seen, collision.bounds, atol=0.004)


def test_gripping_faces_are_rubber() -> None:
    for link in BARRETT.links:
        rubber = any(visual.material == "rubber" for visual in link.visuals)
        assert rubber == (not link.name.startswith("knuckle")), link.name

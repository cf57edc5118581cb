"""Mass properties agree with closed forms and with trimesh."""

import numpy as np
import pytest
import trimesh

from grasptypes.objects import inertia


def test_solid_agrees_with_trimesh():
    mesh = trimesh.creation.capsule(0.05, 0.02)
    mesh.apply_translation([0.1, -0.2, 0.3])
    mesh.density = 700.0
    mass, centre, tensor = inertia.mass_properties(
        inertia.solid_masses(mesh.vertices, mesh.faces, 700.0)
    )
    assert mass == pytest.approx(mesh.mass)
    assert centre == pytest.approx(mesh.center_mass)
    assert tensor == pytest.approx(mesh.moment_inertia, rel=1e-6, abs=1e-12)


def test_thin_ball_has_two_thirds_m_r2():
    mesh = trimesh.creation.icosphere(subdivisions=5, radius=0.04)
    mass, _, tensor = inertia.mass_properties(inertia.shell_masses(mesh.vertices, mesh.faces, 2.0))
    assert mass == pytest.approx(2.0 * 4 * np.pi * 0.04**2, rel=1e-3)
    assert np.diag(tensor) == pytest.approx(np.full(3, 2 / 3 * mass * 0.04**2), rel=2e-3)


def test_two_bodies_balance_between_them():
    box = trimesh.creation.box((0.02, 0.02, 0.02))
    light = inertia.solid_masses(box.vertices - [0.05, 0, 0], box.faces, 1000.0)
    heavy = inertia.solid_masses(box.vertices + [0.05, 0, 0], box.faces, 3000.0)
    mass, centre, _ = inertia.mass_properties(inertia.together([light, heavy]))
    assert mass == pytest.approx(4000 * 0.02**3)
    assert centre == pytest.approx([0.025, 0.0, 0.0])

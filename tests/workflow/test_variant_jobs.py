"""Variants go through the workflow beside their objects, and leave these as they are."""

import json

import numpy as np
from repository import Repository


def test_variants_are_planned_beside_their_objects(repository: Repository) -> None:
    repository.set_param("objects.variants", 2)
    planned = repository.planned("reports/table1.csv", "reports/table1_published.csv")
    assert planned["prepare_object"] == 2
    assert planned["prepare_variant"] == 4
    assert planned["synthesize_grasps"] == planned["map_contacts"] == 6 * 2
    assert planned["extract_features"] == 6


def test_variants_are_no_reason_to_make_their_objects_anew(changed: Repository) -> None:
    changed.set_param("objects.variants", 1)
    planned = changed.planned("data/samples.csv", "features")
    assert planned["prepare_variant"] == planned["render_object"] == 2
    assert planned["prepare_object"] == 0
    assert planned["synthesize_grasps"] == 2 * 2


def test_a_variant_is_held_like_its_object(repository: Repository) -> None:
    repository.set_param("objects.variants", 1)
    repository.snakemake("data/contact_maps/mug_v01/use.npz")
    properties = json.loads((repository.path / "data/objects/mug_v01/properties.json").read_text())
    assert properties["object"] == "mug_v01"
    assert properties["density_kg_m3"] == 1900.0
    with np.load(repository.path / "data/contact_maps/mug_v01/use.npz") as contact_map:
        assert contact_map["sessions"].max() > 0.5
        assert contact_map["part_names"].tolist() == ["rim", "wall", "base", "handle"]

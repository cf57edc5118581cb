"""The small configuration from nothing to Table I: complete, the same again, and measured."""

import functools
import hashlib
import http.server
import json
import threading
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from repository import Repository
from verify import checksums

from grasptypes.labels.label_sources import FETCHED, PUBLISHED

MODELS = ["no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2"]


def test_every_session_has_one_grasp_and_every_failure_a_reason(complete: Repository) -> None:
    grasps = pd.read_csv(complete.path / "data/grasps.csv")
    assert len(grasps) == 2 * 2 * 4
    for _, group in grasps.groupby(["Object", "Intent"]):
        assert sorted(group.Session) == [1, 2, 3, 4]
    assert ((grasps.GraspType == "Invalid") == (grasps.reason != "valid")).all()
    assert not grasps.isna().any().any()
    attempts = (complete.path / "data/attempts").rglob("*.parquet")
    tried = pd.concat([pd.read_parquet(path) for path in attempts])
    assert (tried.valid == (tried.reason == "")).all()


def test_table1_has_the_models_beside_the_paper(complete: Repository) -> None:
    table = pd.read_csv(complete.path / "reports/table1.csv")
    ours = table[table.model.isin(MODELS)]
    assert ours.model.tolist() == MODELS
    for name in ("sim_mean", "acc_mean", "prec_mean", "freq_mean"):
        assert ours[name].between(0, 1).all()
    assert dict(zip(ours.model, ours.paper_sim, strict=True))["task_in_image"] == 0.92
    assert ours.weights.nunique() == 1


def test_one_job_at_a_time_makes_the_same_files(
    complete: Repository, repository: Repository
) -> None:
    results = ("data/grasps/mug/use.parquet", "data/features/mug.npz")
    repository.run("snakemake", "-j1", *results)
    made, expected = checksums(repository.path), checksums(complete.path)
    assert {name: expected.get(name) for name in made} == made
    kinds = {Path(name).parts[1] for name in made if name.startswith("data/")}
    assert {"objects", "contact_maps", "grasps", "renders", "features"} <= kinds


@pytest.mark.slow
def test_other_targets_on_the_way_lead_to_the_same_lock(
    complete: Repository, repository: Repository
) -> None:
    repository.run("snakemake", "-j1", "reports/generalisation.csv", "reports/planning.csv")
    repository.dvc("repro")
    lock = "dvc.lock"
    assert (repository.path / lock).read_text() == (complete.path / lock).read_text()
    assert checksums(complete.path).items() <= checksums(repository.path).items()


def test_benchmarks_tell_the_time_of_every_rule_or_what_they_lack(
    complete: Repository, fresh: Repository
) -> None:
    output = complete.module("benchmarks", "records")
    for name in ("wall time of train_predictor", "wall time of the main job", "peak memory of"):
        assert name in output
    output = fresh.module("benchmarks", "records", "idle", "synthesis", "renders", "features")
    assert output.count("left out") == 5
    assert "data/renders is missing; make it with: snakemake renders" in output


def test_variants_go_beside_their_objects(changed: Repository) -> None:
    changed.set_param("objects.variants", 1)
    planned = changed.planned("data/samples.csv", "features")
    assert planned["prepare_variant"] == planned["render_object"] == 2
    assert planned["prepare_object"] == 0
    assert planned["synthesize_grasps"] == 2 * 2
    changed.snakemake("data/contact_maps/mug_v01/use.npz")
    properties = json.loads((changed.path / "data/objects/mug_v01/properties.json").read_text())
    assert (properties["object"], properties["density_kg_m3"]) == ("mug_v01", 1900.0)
    with np.load(changed.path / "data/contact_maps/mug_v01/use.npz") as contact_map:
        assert contact_map["sessions"].max() > 0.5


def test_the_authors_table_is_fetched_once_and_only_with_the_right_checksum(
    repository: Repository, tmp_path: Path
) -> None:
    content = b"Index,Object\n"
    (tmp_path / "host").mkdir()
    (tmp_path / "host/table.csv").write_bytes(content)
    handler = functools.partial(
        http.server.SimpleHTTPRequestHandler, directory=str(tmp_path / "host")
    )
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        url = f"http://127.0.0.1:{server.server_port}/table.csv"
        right, wrong = hashlib.sha256(content).hexdigest(), "0" * 64
        call = ("snakemake", "-j1", FETCHED)
        said = repository.run(*call, check=False, **{PUBLISHED: f"{url}#sha256={wrong}"})
        assert f"error: fetch_published: {PUBLISHED}: {url} has the SHA-256 {right}" in said
        assert not (repository.path / FETCHED).exists()
        named = {PUBLISHED: f"{url}#sha256={right}"}
        repository.run(*call, **named)
        server.shutdown()
    assert (repository.path / FETCHED).read_bytes() == content
    assert "Nothing to be done" in repository.run(*call, **named)

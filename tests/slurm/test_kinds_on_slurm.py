"""Kinds of objects are grasped by jobs of the cluster, several kinds in each."""

import sys
from pathlib import Path

from cluster import Cluster
from repository import ROOT, Repository
from verify import checksums

GRASPS = "data/kinds/grasps.csv"
# Two kinds per job instead of four; the option replaces the whole table of the profile.
CALL = ["-m", "snakemake", "--profile", "profiles/slurm", "--latency-wait", "5", "--no-hooks"]
CALL += ["--slurm-init-seconds-before-status-checks", "3", GRASPS]
CALL += ["--group-components", "object=2", "predictor=2", "figure=3"]


def test_the_kinds_of_a_group_form_one_job(cluster: Cluster, tmp_path: Path) -> None:
    remote = Repository.create(tmp_path / "remote", ROOT / "tests" / "small_general.yaml")
    remote.set_param("kinds.names", ["apple", "soup_bowl", "table_knife"])
    remote.set_param("kinds.sessions", 2)
    local = remote.copy(tmp_path / "local")
    remote.run(sys.executable, *CALL, **cluster.environment)
    assert len(cluster.jobs("COMPLETED")) == 2
    local.snakemake(GRASPS)
    assert checksums(remote.path) == checksums(local.path)

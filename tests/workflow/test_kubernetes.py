"""The Kubernetes profile, with a `kubectl` that runs a pod's command on this machine."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from repository import ROOT, Repository

# `create` runs what the manifest says and keeps both; `get` answers from what became of it.
KUBECTL = """\
#!/usr/bin/env python3
import json, os, subprocess, sys
from pathlib import Path
folder = Path(__file__).parents[1]
if sys.argv[1] == "create":
    job = json.load(sys.stdin)
    container = job["spec"]["template"]["spec"]["containers"][0]
    given = {entry["name"]: entry["value"] for entry in container["env"]}
    environment = {"PATH": os.environ["PATH"]} | given
    done = subprocess.run(container["command"], cwd=container["workingDir"], env=environment)
    name = f"job-{len(list(folder.glob('*.json')))}"
    (folder / f"{name}.json").write_text(json.dumps(job))
    (folder / name).write_text("Complete=True " if done.returncode == 0 else "Failed=True ")
    print("job.batch/" + name)
elif sys.argv[1] == "get":
    print("found " + (folder / Path(sys.argv[2]).name).read_text())
"""


def install(folder: Path, kubectl: str) -> str:
    """A search path that finds this kubectl first."""
    program = folder / "bin" / "kubectl"
    program.parent.mkdir(parents=True)
    program.write_text(kubectl)
    program.chmod(0o755)
    return os.pathsep.join([str(program.parent), os.environ["PATH"]])


def test_the_jobs_of_an_object_run_in_one_pod_with_what_they_need(
    repository: Repository, tmp_path: Path
) -> None:
    path = install(tmp_path, KUBECTL)
    call = ["--profile", "profiles/kubernetes", "--latency-wait", "5"]
    target = "data/contact_maps/mug/use.npz"
    call += ["--seconds-between-status-checks", "1", target]
    repository.run(sys.executable, "-m", "snakemake", *call, PATH=path, GRASPTYPES_PUBLISHED_CSV="")
    assert (repository.path / target).is_file()
    (job,) = [json.loads(file.read_text()) for file in tmp_path.glob("job-*.json")]
    pod = job["spec"]["template"]["spec"]
    assert pod["securityContext"] == {"runAsUser": os.getuid(), "runAsGroup": os.getgid()}
    (container,) = pod["containers"]
    assert container["workingDir"] == str(repository.path)
    needs = {"cpu": "1", "memory": "600M"}  # prepare_object, then map_contacts
    assert container["resources"] == {"requests": needs, "limits": needs}
    assert {"name": "GRASPTYPES_PUBLISHED_CSV", "value": ""} in container["env"]
    assert pod["activeDeadlineSeconds"] == 60 * (2 + 1)
    assert "activeDeadlineSeconds" not in job["spec"]


def test_the_code_is_copied_to_a_volume_whose_root_stays_as_it_is(tmp_path: Path) -> None:
    manifests = yaml.safe_load_all((ROOT / "profiles" / "kubernetes" / "run.yaml").read_text())
    (job,) = [manifest for manifest in manifests if manifest["kind"] == "Job"]
    (container,) = job["spec"]["template"]["spec"]["containers"]
    copying, _, running = container["command"][-1].partition("&&")
    assert "snakemake" in running
    image, volume = tmp_path / "image", tmp_path / "volume"
    for folder in (image / "src", image / ".venv", volume / "data"):
        folder.mkdir(parents=True)
    for name in ("params.yaml", ".dvcignore", "src/code.py", ".venv/library.py"):
        (image / name).write_text("new")
    (volume / "params.yaml").write_text("old")
    image.chmod(0o700)
    volume.chmod(0o755)
    subprocess.run(
        ["sh", "-c", copying.replace("/opt/grasptypes", str(image))], cwd=volume, check=True
    )
    copied = {str(path.relative_to(volume)) for path in volume.rglob("*")}
    assert copied == {"data", "params.yaml", ".dvcignore", "src", "src/code.py"}
    assert (volume / "params.yaml").read_text() == "new"
    # It may belong to somebody else, who alone can change its mode and times.
    assert volume.stat().st_mode & 0o777 == 0o755


@pytest.mark.parametrize(
    ("answer", "state"),
    [
        ("echo 'found SuccessCriteriaMet=True Complete=True '", "success"),
        ("echo 'found FailureTarget=True Failed=True '", "failed"),
        ("echo 'found '", "running"),
        ("echo 'found Suspended=False '", "running"),
        ("true", "failed"),  # no such Job any more
        ("exit 1", "running"),  # no answer
    ],
)
def test_what_kubernetes_answers_is_said_in_snakemakes_words(
    answer: str, state: str, tmp_path: Path
) -> None:
    path = install(tmp_path, f"#!/bin/sh\n{answer}\n")
    script = ROOT / "profiles" / "kubernetes" / "status.sh"
    command = [script, "job.batch/grasptypes-1"]
    said = subprocess.run(
        command, env=os.environ | {"PATH": path}, capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == state

"""Run a job script of Snakemake as a Kubernetes Job, and print the Job's name."""

import argparse
import json
import os
import subprocess
from typing import Any


def manifest(options: argparse.Namespace) -> dict[str, Any]:
    """A Job of one pod that is given up when it fails or takes too long; Snakemake retries."""
    needs = {"cpu": str(options.cores), "memory": f"{options.memory_mb}M"}
    named = {key: value for key, value in os.environ.items() if key.startswith("GRASPTYPES_")}
    container = {
        "name": "snakemake",
        "image": options.image,
        "command": ["sh", options.script],
        "workingDir": os.getcwd(),
        "env": [{"name": key, "value": value} for key, value in ({"HOME": "/tmp"} | named).items()],
        "resources": {"requests": needs, "limits": needs},
        "volumeMounts": [{"name": "shared", "mountPath": options.mount}],
    }
    pod = {
        "restartPolicy": "Never",
        # Counts from the start of the pod on a node; the Job's own limit would include the wait for
        # one.
        "activeDeadlineSeconds": 60 * options.minutes,
        # Files on the volume belong to the user who runs Snakemake.
        "securityContext": {"runAsUser": os.getuid(), "runAsGroup": os.getgid()},
        "containers": [container],
        "volumes": [{"name": "shared", "persistentVolumeClaim": {"claimName": options.claim}}],
    }
    return {
        "apiVersion": "batch/v1",
        "kind": "Job",
        "metadata": {"generateName": "grasptypes-", "labels": {"app": "grasptypes"}},
        "spec": {
            "backoffLimit": 0,
            "ttlSecondsAfterFinished": 86400,
            "template": {"spec": pod},
        },
    }


def main() -> None:
    """Command line: what the job needs, where it runs, and its script."""
    parser = argparse.ArgumentParser(description="Run a job script as a Kubernetes Job.")
    parser.add_argument("--image", required=True)
    parser.add_argument("--claim", required=True, help="claim of the shared volume")
    parser.add_argument("--mount", required=True, help="where the volume is mounted, in every pod")
    parser.add_argument("--cores", type=int, required=True)
    parser.add_argument("--memory-mb", type=int, required=True)
    parser.add_argument("--minutes", type=int, required=True)
    parser.add_argument("script")
    job = json.dumps(manifest(parser.parse_args()))
    subprocess.run(
        ["kubectl", "create", "--output", "name", "--filename", "-"],
        input=job,
        text=True,
        check=True,
    )


if __name__ == "__main__":
    main()

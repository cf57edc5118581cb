"""The MLflow UI on the store that params.yaml names; ``python -m grasptypes.runs.ui``.

What is finished is published before; the UI starts all the same if that fails.
"""

from __future__ import annotations

import argparse
import logging
import os
import sys
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.runs.publishing import chosen_store, publish_folder
from grasptypes.runs.tracking import Store

HOST = "127.0.0.1"

logger = logging.getLogger(__name__)


def prepare(root: Path, store: Store, port: int) -> str:
    """Publish, and say what went wrong; returns the address of the runs."""
    page = ""
    try:
        page = store.page()
        publish_folder(root, store)
    except InputError as error:
        logger.warning("%s", error)
    return f"http://{HOST}:{port}/{page}"


def server(store: Store, port: int) -> list[str]:
    """The command that serves a store on this machine alone, with one process that answers."""
    command = [sys.executable, "-m", "mlflow", "ui", "--backend-store-uri", store.uri]
    return [*command, "--host", HOST, "--port", str(port), "--workers", "1"]


def main() -> None:
    """Publish and serve the current folder's runs."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    parser = argparse.ArgumentParser(description="The MLflow UI on this checkout's runs.")
    parser.add_argument("--port", type=int, required=True)
    port = parser.parse_args().port
    try:
        store = chosen_store(Path.cwd())
    except InputError as error:
        sys.exit(f"error: {error}")
    sys.stdout.write(f"runs: {prepare(Path.cwd(), store, port)}\n")
    sys.stdout.flush()
    os.environ["MLFLOW_SERVER_ENABLE_JOB_EXECUTION"] = "false"
    os.execv(sys.executable, server(store, port))


if __name__ == "__main__":
    main()

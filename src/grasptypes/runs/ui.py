"""The MLflow UI for the store named in params.yaml; ``python -m grasptypes.runs.ui PORT``."""

from __future__ import annotations

import os
import sys

from grasptypes.errors import InputError
from grasptypes.runs.tracking import Store
from grasptypes.settings.params import read_params

HOST = "127.0.0.1"


def serve(port: str) -> None:
    """Print the address of the runs and serve them with one process, on this machine only.

    Raises:
        InputError: the store cannot be opened.
    """
    store = Store(read_params("params.yaml").tracking)
    sys.stdout.write(f"runs: http://{HOST}:{port}/{store.page()}\n")
    sys.stdout.flush()
    os.environ["MLFLOW_SERVER_ENABLE_JOB_EXECUTION"] = "false"
    command = [sys.executable, "-m", "mlflow", "ui", "--backend-store-uri", store.uri]
    os.execv(sys.executable, [*command, "--host", HOST, "--port", port, "--workers", "1"])


if __name__ == "__main__":
    try:
        serve(sys.argv[1])
    except InputError as error:
        sys.exit(f"error: {error}")

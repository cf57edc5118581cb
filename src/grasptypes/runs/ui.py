"""The MLflow UI on the store that params.yaml names; ``python -m grasptypes.runs.ui``."""

from __future__ import annotations

import argparse
import os
import sys

from grasptypes.errors import InputError
from grasptypes.runs.tracking import Store
from grasptypes.settings.params import read_params

HOST = "127.0.0.1"


def server(store: Store, port: int) -> list[str]:
    """The command that serves a store on this machine alone, with one process that answers."""
    command = [sys.executable, "-m", "mlflow", "ui", "--backend-store-uri", store.uri]
    return [*command, "--host", HOST, "--port", str(port), "--workers", "1"]


def main() -> None:
    """Print the address of the runs and serve them; bad input ends with one line."""
    parser = argparse.ArgumentParser(description="The MLflow UI on this checkout's runs.")
    parser.add_argument("--port", type=int, required=True)
    port = parser.parse_args().port
    try:
        store = Store(read_params("params.yaml").tracking)
        page = store.page()
    except InputError as error:
        sys.exit(f"error: {error}")
    sys.stdout.write(f"runs: http://{HOST}:{port}/{page}\n")
    sys.stdout.flush()
    os.environ["MLFLOW_SERVER_ENABLE_JOB_EXECUTION"] = "false"
    os.execv(sys.executable, server(store, port))


if __name__ == "__main__":
    main()

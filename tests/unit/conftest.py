"""What all unit tests share."""

import importlib
import logging
import sys

import pytest
from hosts import serving


def pytest_collection_finish(session: pytest.Session) -> None:
    """Load torch's compiler before any test opens OpenGL, if the tests use torch at all.

    Mesa and triton each bring an LLVM; the process crashes when triton's comes second.
    """
    if "torch" in sys.modules:
        importlib.import_module("torchvision")
        importlib.import_module("torch._dynamo")


@pytest.fixture(scope="session")
def host():
    """Address of a host on this machine; see hosts.py."""
    with serving() as address:
        yield address


@pytest.fixture(autouse=True)
def logger_level():
    """Commands raise the level of the package's logger; the next test starts with the default."""
    yield
    logging.getLogger("grasptypes").setLevel(logging.NOTSET)

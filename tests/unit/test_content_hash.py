import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from grasptypes.content_hash import FileHash

SOURCE = Path(__file__).parents[2] / "src"


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A small copy of the package with a script that imports one module, which imports another."""
    package = tmp_path / "src" / "grasptypes"
    package.mkdir(parents=True)
    for name in ("__init__", "content_hash", "errors", "files"):
        shutil.copy(SOURCE / "grasptypes" / f"{name}.py", package / f"{name}.py")
    (package / "used.py").write_text('"""Doc."""\nfrom grasptypes.deeper import two\n')
    (package / "deeper.py").write_text("def two():\n    return 2\n")
    (package / "unused.py").write_text("x = 1\n")
    (tmp_path / "script.py").write_text("from grasptypes.used import two\n")
    return tmp_path


def hash_of(checkout: Path) -> str:
    code = "import sys; from grasptypes.content_hash import CodeHash"
    code += "; print(CodeHash('memory.json')(sys.argv[1]))"
    command = [sys.executable, "-c", code, str(checkout / "script.py")]
    environment = {
        **os.environ,
        "PYTHONPATH": str(checkout / "src"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    return subprocess.run(
        command, cwd=checkout, env=environment, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_code_hash_sees_statements_everywhere_below_and_nothing_else(checkout: Path) -> None:
    package = checkout / "src" / "grasptypes"
    before = hash_of(checkout)
    (package / "unused.py").write_text("x = 2\n")
    (package / "used.py").write_text('"""Another."""\nfrom grasptypes.deeper import two  # why\n')
    (package / "deeper.py").write_text("def two():\n\n    return 2  # two\n")
    assert hash_of(checkout) == before
    (package / "deeper.py").write_text("def two():\n    return 3\n")
    changed = hash_of(checkout)
    assert changed != before
    (checkout / "script.py").write_text("from grasptypes.used import two\ntwo()\n")
    assert hash_of(checkout) != changed


def test_code_hash_sees_the_packages_that_an_import_runs(checkout: Path) -> None:
    before = hash_of(checkout)
    (checkout / "src" / "grasptypes" / "__init__.py").write_text("SETTING = 1\n")
    assert hash_of(checkout) != before


def test_code_hash_is_the_same_in_every_checkout(checkout: Path, tmp_path: Path) -> None:
    shutil.copytree(checkout, tmp_path / "elsewhere")
    assert hash_of(tmp_path / "elsewhere") == hash_of(checkout)


def test_file_hash_follows_content(tmp_path: Path) -> None:
    path = tmp_path / "weights.bin"
    file_hash = FileHash(tmp_path / "memory.json")
    assert file_hash(path) == "missing"
    path.write_bytes(b"one")
    first = file_hash(path)
    os.utime(path, (0, 0))
    assert FileHash(tmp_path / "memory.json")(path) == first
    path.write_bytes(b"two")
    assert FileHash(tmp_path / "memory.json")(path) != first


def test_a_broken_memory_is_only_forgotten(tmp_path: Path) -> None:
    (tmp_path / "memory.json").write_text("{half")
    (tmp_path / "file").write_bytes(b"x")
    assert len(FileHash(tmp_path / "memory.json")(tmp_path / "file")) == 16

"""What is said before a first run takes longer."""

from grasptypes import first_run
from grasptypes.first_run import compiling, downloading


def test_compiling_is_announced_until_machine_code_is_there(tmp_path):
    environment = {"NUMBA_CACHE_DIR": str(tmp_path)}
    (line,) = compiling(environment)
    assert "compiled" in line
    code = tmp_path / "synthesis_1a2b" / "energy._contact_terms-109.py311.nbi"
    code.parent.mkdir()
    code.touch()
    assert compiling(environment) == []


def test_a_download_is_announced_if_nothing_else_has_the_weights(tmp_path, monkeypatch):
    record, cache = tmp_path / "backbone.json", tmp_path / "checkpoints"
    monkeypatch.setattr(first_run, "torch_cache", lambda: cache)
    (line,) = downloading(record, {})
    assert str(cache) in line
    assert downloading(record, {"GRASPTYPES_BACKBONE_WEIGHTS": "here.pth"}) == []
    record.touch()
    assert downloading(record, {}) == []

"""Another workflow uses this one as a module (docs/quick_start_workflow.md)."""

import re
from pathlib import Path

from repository import ROOT, TARGET, Repository

PAGE = ROOT / "docs" / "quick_start_workflow.md"
MAP = "data/contact_maps/mug/use.npz"


def test_the_documented_workflow_adds_a_rule_to_ours(
    repository: Repository, tmp_path: Path
) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.S)
    code = code.replace("/some/folder/grasptypes", str(repository.path))
    snakefile = tmp_path / "study" / "Snakefile"
    snakefile.parent.mkdir()
    snakefile.write_text(code)
    call = ["snakemake", "-j2", "--snakefile", str(snakefile)]
    planned = repository.run(*call, "--dry-run")
    assert re.search(r"^count +1$", planned, re.M)
    assert re.search(r"^train_predictor +5$", planned, re.M)
    # Something that takes less time to make.
    snakefile.write_text(code.replace(TARGET, MAP))
    repository.run(*call)
    assert int((repository.path / "rows.txt").read_text().split()[0]) > 0
    # The records are the same as of this workflow alone.
    assert repository.snakemake_is_clean(MAP)

"""Each parameter, module and asset changed once: both tools notice, and what is affected runs.

In processes that find the tools' packages imported: hundreds of questions become affordable so.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from repository import ROOT, Repository, jobs

from grasptypes.content_hash import CodeHash
from grasptypes.errors import InputError
from grasptypes.settings.params import Params

pytestmark = pytest.mark.slow
BARRETT = "src/grasptypes/hands/data/barrett"
CONTEXT = multiprocessing.get_context("forkserver")
CONTEXT.set_forkserver_preload(
    ["snakemake.cli", "dvc.cli", "dvc.commands.status", "pandera.pandas"]
)
SCRIPTS = sorted((ROOT / "workflow/scripts").glob("*.py"))
SHARED = {"tabulate_results": ["tabulate_simulated", "tabulate_published", "tabulate_unseen"]}
# Parameters of users' own objects, commands, and targets outside `all`, and whatever is below them.
OUTSIDE = (
    *("objects.names", "objects.own", "objects.import", "objects.variants", "objects.variation"),
    *("objects.variant_views", "objects.comparison", "contact_maps.measured", "hold_fit"),
    *("published", "replay", "generalisation", "demonstrations", "plan", "predict", "labels"),
    *("many_tasks", "learning_curve"),
    "kinds",
    *("grasp_types.fitted_on", "grasp_types.softness", "grasp_types.own_frames"),
)


def answer(folder: str, output: str, arguments: list[str]) -> None:
    os.chdir(folder)
    os.environ.update(Repository.environment())
    channel = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.dup2(channel, 1)
    os.dup2(channel, 2)
    sys.argv = arguments
    if arguments[0] == "snakemake":
        from snakemake.cli import main
    else:
        from dvc.cli import main
    sys.exit(main(arguments[1:]))


class Workflow:
    """A computed repository whose files are changed one at a time."""

    def __init__(self, repository: Repository) -> None:
        self.path = repository.path
        self.users: dict[str, set[str]] = {}
        code_hash = CodeHash()
        for script in SCRIPTS:
            for path in code_hash.files(script):
                names = SHARED.get(script.stem, [script.stem])
                self.users.setdefault(str(path.relative_to(ROOT)), set()).update(names)

    def ask(self, *arguments: str) -> str:
        """What a tool's own command line prints, in a process of its own."""
        output = self.path.parent / "answer.txt"
        process = CONTEXT.Process(target=answer, args=(str(self.path), str(output), arguments))
        process.start()
        process.join()
        return output.read_text()

    def after(self, name: str, text: str) -> Counter[str]:
        """The jobs that are planned after a change of a file, which DVC has to notice too."""
        path = self.path / name
        before = path.read_bytes()
        try:
            path.write_text(text)
            os.utime(path, (0, 0))  # an old file in its place, as unzip leaves it
            output = self.ask("snakemake", "-n", "all")
            status = self.ask("dvc", "status", "--json").strip().splitlines()[-1]
        finally:
            path.write_bytes(before)
        assert "Nothing to be done" in output or "Job stats" in output, output
        assert json.loads(status), f"dvc does not notice {name}"
        return jobs(output[max(output.rfind("Job stats"), 0) :])


@pytest.fixture(scope="module")
def workflow(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    return Workflow(complete.copy(tmp_path_factory.mktemp("stale") / "repository"))


def numbers(params: Any, part: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """The key of each number or switch, and the parameters as YAML with another one in its place.

    Of lists only the last entry is changed.
    """
    for name in list(part) if isinstance(part, dict) else range(len(part))[-1:]:
        old, full = part[name], f"{key}{name}"
        if isinstance(old, dict | list):
            yield from numbers(params, old, f"{full}.")
        elif isinstance(old, int | float):
            tries = [not old] if isinstance(old, bool) else [old + 1, old - 1, old // 2]
            for value in tries if isinstance(old, int) else [old * 0.99, old * 1.01, old + 0.01]:
                part[name] = value
                if is_allowed(params):
                    yield full, yaml.safe_dump(params, sort_keys=False)
                    break
            else:
                raise AssertionError(f"{full}: no other value than {old} is allowed")
            part[name] = old


def is_allowed(params: Any) -> bool:
    try:
        Params.check(params)
    except InputError:
        return False
    return True


def test_every_parameter_is_read_by_a_rule(workflow: Workflow) -> None:
    params = yaml.safe_load((workflow.path / "params.yaml").read_text())
    for name, text in numbers(params, params):
        if not any(name == outside or name.startswith(f"{outside}.") for outside in OUTSIDE):
            assert workflow.after("params.yaml", text), f"{name}: nothing is planned"


def test_every_module_reruns_the_rules_that_import_it(workflow: Workflow) -> None:
    everything = workflow.after(
        "params.yaml", "seed: 1\n" + (ROOT / "tests/small.yaml").read_text()
    )
    for path in sorted((workflow.path / "src").rglob("*.py")) + SCRIPTS:
        name = str(path.relative_to(ROOT if path in SCRIPTS else workflow.path))
        planned = workflow.after(name, path.read_text() + "\n_MUTATED = 1\n")
        direct = workflow.users.get(name, set()) & everything.keys()
        assert direct <= planned.keys(), name
        assert direct or not planned, name


@pytest.mark.parametrize(
    ("asset", "rule"),
    [
        (f"{BARRETT}/hand.urdf", "synthesize_grasps"),
        (f"{BARRETT}/hand.yaml", "synthesize_grasps"),
        (f"{BARRETT}/grips.yaml", "synthesize_grasps"),
        (f"{BARRETT}/collision/distal_fingertip.obj", "synthesize_grasps"),
        ("assets/published_labels.csv", "label_published"),
        ("src/grasptypes/objects/catalogue.yaml", "prepare_object"),
        ("src/grasptypes/settings/roles.yaml", "map_contacts"),
        ("src/grasptypes/settings/tasks.yaml", "map_contacts"),
        ("src/grasptypes/settings/holds.yaml", "map_contacts"),
    ],
)
def test_an_asset_reruns_its_readers(workflow: Workflow, asset: str, rule: str) -> None:
    lines = (workflow.path / asset).read_text().splitlines()
    text = "\n".join([*lines[:-2], lines[-1], lines[-2]] if asset.endswith("csv") else [*lines, ""])
    planned = workflow.after(asset, text + "\n")
    assert planned[rule] > 0
    assert (planned["prepare_object"] > 0) == (rule == "prepare_object")


def test_what_python_imports_is_hashed() -> None:
    code = "import runpy, sys; runpy.run_path(sys.argv[1], run_name='loaded'); print(*(m.__file__"
    code += " for n, m in list(sys.modules.items()) if n.split('.')[0] == 'grasptypes'), sep='\\n')"
    for script in SCRIPTS:
        run = Repository(ROOT).run("python", "-c", code, str(script), PYTHONPATH=str(ROOT / "src"))
        loaded = {Path(line) for line in run.splitlines() if line.startswith(str(ROOT / "src"))}
        assert len(loaded) > 2
        assert loaded <= CodeHash().files(script), script.name

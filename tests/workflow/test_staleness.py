"""Each parameter, module and asset changed once: both tools notice, and what is affected runs.

In processes that find the tools' packages imported: hundreds of questions become affordable so.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import re
import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml
from repository import ROOT, Repository, jobs

from grasptypes.content_hash import CodeHash
from grasptypes.errors import InputError
from grasptypes.settings.params import Params

pytestmark = pytest.mark.slow
CONTEXT = multiprocessing.get_context("forkserver")
CONTEXT.set_forkserver_preload(
    ["snakemake.cli", "dvc.cli", "dvc.commands.status", "dvc.repo.status"]
    + ["pydantic", "numpy", "pandas", "pandera.pandas", "scipy.spatial", "trimesh"]
)
# Not part of `all`: they need data of the user's own.
MEASURED = ("evaluate_labels", "replay_grasps", "compare_shapes")
LEARNING = ("train_predictor", "leave_out_objects", "publish_runs")
GALLERIES = ("plot_grasps", "plot_rejected_grasps")
PICTURES = ("picture_grasps", "plot_contact_maps", *GALLERIES)
# The rules that read a parameter; the longest key that its own begins with counts.
READERS: dict[str, tuple[str, ...]] = {
    "seed": ("map_contacts", "synthesize_grasps", "render_object", "split_folds", *LEARNING[:2]),
    "tasks": ("extract_features", *LEARNING[:2]),
    "objects.scale": ("prepare_object",),
    "objects.resolution": ("prepare_object",),
    "objects.comparison": ("compare_shapes",),
    "contact_maps": ("map_contacts",),
    "replay": ("replay_grasps",),
    "replay.object_scale": ("replay_grasps", "evaluate_labels"),
    "contact_pictures": ("plot_contact_maps",),
    "synthesis": ("synthesize_grasps",),
    "physics": ("synthesize_grasps",),
    "gallery": GALLERIES,
    "gallery.screenshot_px": ("picture_grasps",),
    "gallery.elevation_rad": ("picture_grasps", *GALLERIES),
    "gallery.columns": ("plot_grasps",),
    "gallery.rejected": ("plot_rejected_grasps",),
    "gallery.sessions": ("plot_sessions",),
    "grasp_types": ("evaluate_labels",),
    "grasp_types.contacts": ("label_grasps", "evaluate_labels"),
    "grasp_types.thresholds": ("label_grasps", "plot_label_tree", "evaluate_labels"),
    "renders": ("render_object", *PICTURES),
    "renders.views": ("render_object",),
    "renders.png_compression": ("render_object", "plot_sessions", *PICTURES),
    "renders.sheet": ("plot_renders",),
    "backbone": ("prepare_backbone",),
    "features": ("extract_features",),
    "folds": ("split_folds",),
    "predictors": LEARNING,
    "tracking": ("publish_runs",),
}
# What concerns users' own objects, commands, or targets of their own.
NO_RESULT = (
    *("objects.names", "objects.own", "objects.import", "objects.variants", "objects.variation"),
    *("objects.variant_views", "contact_maps.measured", "contact_evidence", "published"),
    *("generalisation", "plan", "predict", "labels"),
)
# Values that cannot be found by changing the old one a little.
SPECIAL: dict[str, object] = {
    "contact_maps.affinities": "./assets/affinities.csv",
    "grasp_types.fitted_on": ["apple", "banana"],
    "features.precision": "fp32",
    "predictors.finetune": "last_blocks",
    "tracking.database": "other.db",
    "tracking.experiment": "other",
}
SHARED_SCRIPT = {
    "tabulate_results": ["tabulate_simulated", "tabulate_published", "tabulate_unseen"]
}


def answer(folder: str, output: str, arguments: list[str]) -> None:
    os.chdir(folder)
    os.environ.update(Repository.environment())
    channel = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.dup2(channel, 1)
    os.dup2(channel, 2)
    sys.argv = arguments
    if arguments[0] == "snakemake":
        from snakemake.cli import main

        main(arguments[1:])
    else:
        from dvc.cli import main

        sys.exit(main(arguments[1:]))


def ask(folder: Path, *arguments: str) -> str:
    """What a tool's own command line prints, in a process of its own."""
    output = folder.parent / "answer.txt"
    process = CONTEXT.Process(target=answer, args=(str(folder), str(output), list(arguments)))
    process.start()
    process.join()
    return output.read_text()


class Workflow:
    """A computed repository whose files are changed one at a time, and its jobs."""

    def __init__(self, repository: Repository) -> None:
        self.path = repository.path
        graph = repository.run("snakemake", "all", *MEASURED, "--dag")
        self.rules: dict[str, str] = dict(re.findall(r'(\d+)\[label = "(\w+)', graph))
        self.readers: dict[str, set[str]] = {}
        for above, below in re.findall(r"(\d+) -> (\d+)", graph):
            self.readers.setdefault(above, set()).add(below)
        self.at_rest = self.planned()

    def planned(self) -> Counter[str]:
        output = ask(self.path, "snakemake", "-n", "all", *MEASURED)
        assert "Nothing to be done" in output or "Job stats" in output, output
        return jobs(output[max(output.rfind("Job stats"), 0) :])

    def complaint(self, name: str, text: str, rules: set[str], why: str = "") -> str:
        """What is wrong with the tools' answers to a changed file that these rules read."""
        path = self.path / name
        before = path.read_bytes()
        try:
            path.write_text(text)
            os.utime(path, (0, 0))  # an old file in its place, as unzip leaves it
            planned = self.planned()
            status = json.loads(ask(self.path, "dvc", "status", "--json").strip().splitlines()[-1])
        finally:
            path.write_bytes(before)
        todo = {job for job, rule in self.rules.items() if rule in rules}
        affected: set[str] = set()
        while todo:
            affected |= todo
            todo = {below for job in todo for below in self.readers.get(job, ())} - affected
        expected = Counter(self.rules[job] for job in affected) | self.at_rest
        if planned != expected:
            return f"{why or name}: plans {planned - expected}, not {expected - planned}"
        return "" if status else f"{why or name}: dvc does not notice"


@pytest.fixture(scope="module")
def workflow(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    """A copy of the computed repository, with what is measured too where there are data for it."""
    return Workflow(complete.copy(tmp_path_factory.mktemp("stale") / "repository"))


def leaves(value: Any, key: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Keys of all values that are neither a mapping nor a list of mappings."""
    if isinstance(value, Mapping) and value:
        parts: Any = value.items()
    elif isinstance(value, list) and value and isinstance(value[0], Mapping):
        parts = enumerate(value)
    else:
        yield key
        return
    for name, part in parts:
        yield from leaves(part, (*key, name))


def others(old: Any) -> list[Any]:
    """Values near the old one; for a list, the list with such a value in one place."""
    if isinstance(old, bool):
        return [not old]
    if isinstance(old, int):
        return [old + 1, old - 1, old // 2]
    if isinstance(old, float):
        return [old * 0.99, old * 1.01, old + 0.01]
    if isinstance(old, list):
        places = range(len(old) - 1, -1, -1)
        return [[*old[:i], new, *old[i + 1 :]] for i in places for new in others(old[i])]
    return []


def changed(params: dict[str, Any], key: tuple[str | int, ...]) -> str:
    """The parameters as YAML with another allowed value in one place."""
    *parents, last = key
    section: Any = params
    for parent in parents:
        section = section[parent]
    old, name = section[last], ".".join(map(str, key))
    for value in [SPECIAL[name]] if name in SPECIAL else others(old):
        section[last] = value
        try:
            Params.check(params)
            return yaml.safe_dump(params, sort_keys=False)
        except InputError:
            continue
        finally:
            section[last] = old
    raise AssertionError(f"{name}: no other value than {old!r} is allowed; name one")


def longest(name: str, keys: Any) -> str | None:
    found = (key for key in keys if name == key or name.startswith(f"{key}."))
    return max(found, key=len, default=None)


def test_parameters(workflow: Workflow) -> None:
    params = yaml.safe_load((workflow.path / "params.yaml").read_text())
    found = []
    for key in leaves(params):
        name = ".".join(map(str, key))
        if longest(name, NO_RESULT) is None:
            reader = longest(name, READERS)
            assert reader is not None, f"{name}: no reader of it is known"
            text, rules = changed(params, key), set(READERS[reader])
            found.append(workflow.complaint("params.yaml", text, rules, name))
    assert not list(filter(None, found)), "\n".join(filter(None, found))
    assert len(found) > 100


def test_modules_and_scripts(workflow: Workflow, tmp_path: Path) -> None:
    code_hash = CodeHash(tmp_path / "memory.json")
    users: dict[str, set[str]] = {}
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        for path in code_hash.files(script):
            names = SHARED_SCRIPT.get(script.stem, [script.stem])
            users.setdefault(str(path.relative_to(ROOT)), set()).update(names)
    found = []
    for folder in ("src/grasptypes", "workflow/scripts"):
        for path in sorted((workflow.path / folder).rglob("*.py")):
            name = str(path.relative_to(workflow.path))
            text = path.read_text() + "\n_MUTATED = 1\n"
            found.append(workflow.complaint(name, text, users.get(name, set())))
    assert not list(filter(None, found)), "\n".join(filter(None, found))


def test_assets(workflow: Workflow) -> None:
    hand = workflow.path / "assets/barrett_hand"
    found = [
        workflow.complaint(
            str(path.relative_to(workflow.path)), path.read_text() + "\n", {"synthesize_grasps"}
        )
        for path in sorted(hand.rglob("*"))
        if path.suffix in (".obj", ".urdf")
    ]
    lines = (workflow.path / "assets/published_labels.csv").read_text().splitlines()
    other = "\n".join([*lines[:-2], lines[-1], lines[-2]]) + "\n"
    rules = {"label_published", "compare_distribution"}
    found.append(workflow.complaint("assets/published_labels.csv", other, rules))
    assert not list(filter(None, found)), "\n".join(filter(None, found))


def test_what_python_imports_is_hashed(tmp_path: Path) -> None:
    code_hash = CodeHash(tmp_path / "memory.json")
    code = "import runpy, sys; runpy.run_path(sys.argv[1], run_name='loaded'); print(*(m.__file__"
    code += " for n, m in list(sys.modules.items()) if n.split('.')[0] == 'grasptypes'), sep='\\n')"
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        run = Repository(ROOT).run("python", "-c", code, str(script), PYTHONPATH=str(ROOT / "src"))
        loaded = {Path(line) for line in run.splitlines() if line.startswith(str(ROOT / "src"))}
        assert len(loaded) > 2
        assert loaded <= code_hash.files(script), script.name

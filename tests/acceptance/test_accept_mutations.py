"""(d) for every parameter, module, script and asset: both tools notice; what is affected runs."""

from __future__ import annotations

import json
import os
import queue
import re
from collections import Counter
from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import pytest
from asking import ask, modules_of
from expected import (
    ELSEWHERE,
    KEPT,
    NO_RESULT,
    NO_RESULT_CODE,
    READERS,
    SHARED_SCRIPTS,
    SPECIAL,
    STAGES,
    longest,
)
from mutations import Mutation, of_code, of_parameters
from repository import ROOT, Repository, jobs

from grasptypes.content_hash import CodeHash

TARGETS = ("all", *(name for name in KEPT if name.endswith(".csv")))
WORKERS = 2


class Answers(NamedTuple):
    """What both tools say of a changed repository: jobs planned by rule, and changed stages."""

    planned: Counter[str]
    stages: set[str]


class Workflow(NamedTuple):
    """The rule of every job by the job's number, and the jobs that read each job's results."""

    rules: dict[str, str]
    readers: dict[str, set[str]]

    def affected(self, rules: Collection[str]) -> Counter[str]:
        """The jobs of the rules, and of all that read their results, directly or not."""
        todo, seen = {job for job, rule in self.rules.items() if rule in rules}, set()
        while todo:
            job = todo.pop()
            seen.add(job)
            todo |= self.readers.get(job, set()) - seen
        return Counter(self.rules[job] for job in seen)


def both(repository: Repository) -> Answers:
    environment = repository.environment()
    output = ask(repository.path, environment, "snakemake", "-n", *TARGETS)
    assert "Nothing to be done" in output or "Job stats" in output, output
    planned = jobs(output[max(output.rfind("Job stats"), 0) :])
    status = ask(repository.path, environment, "dvc", "status", "--json")
    return Answers(planned, set(json.loads(status.strip().splitlines()[-1])))


@pytest.fixture(scope="module")
def workflow(complete: Repository) -> Workflow:
    graph = complete.run("snakemake", *TARGETS, "--dag")
    readers: dict[str, set[str]] = {}
    for above, below in re.findall(r"(\d+) -> (\d+)", graph):
        readers.setdefault(above, set()).add(below)
    return Workflow(dict(re.findall(r'(\d+)\[label = "(\w+)', graph)), readers)


@pytest.fixture(scope="module")
def copies(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> queue.Queue:
    """Copies of the computed repository, one for each thread at work."""
    free: queue.Queue = queue.Queue()
    for number in range(WORKERS):
        free.put(complete.copy(tmp_path_factory.mktemp("copy") / str(number)))
    return free


def sweep(copies: queue.Queue, mutations: Collection[Mutation]) -> dict[str, Answers]:
    """What both tools say of each mutation, by its name."""
    assert mutations

    def answer(mutation: Mutation) -> Answers:
        repository = copies.get()
        path = repository.path / mutation.file
        before = path.read_bytes()
        try:
            path.write_text(mutation.content)
            os.utime(path, (0, 0))  # an old file in its place, as unzip leaves it
            return both(repository)
        finally:
            path.write_bytes(before)
            copies.put(repository)

    with ThreadPoolExecutor(WORKERS) as pool:
        answers = list(pool.map(answer, mutations))
    return dict(zip([mutation.name for mutation in mutations], answers, strict=True))


def complaints(
    name: str, answers: Answers, workflow: Workflow, rules: Collection[str]
) -> list[str]:
    """What is wrong with the answers to a change that the rules can see."""
    wanted = workflow.affected(rules)
    found = []
    if answers.planned != wanted:
        found.append(f"{name}: snakemake plans {answers.planned}, not {wanted}")
    stages = {STAGES.get(rule, "reports") for rule in rules}
    if not stages <= answers.stages:
        found.append(f"{name}: dvc visits {sorted(answers.stages)}, not all of {sorted(stages)}")
    return found


def test_parameters(
    complete: Repository, copies: queue.Queue, workflow: Workflow, record_property
) -> None:
    """(d) every parameter changed once: both tools notice, exactly its readers run"""
    mutations = list(of_parameters(complete.path, SPECIAL, ELSEWHERE))
    found = []
    for name, answers in sweep(copies, mutations).items():
        if longest(name, NO_RESULT) is not None:
            if answers.planned:
                found.append(f"{name}: concerns {answers.planned} after all")
            continue
        entry = longest(name, READERS)
        if entry is None:
            found.append(f"{name}: no reader of it is known")
        else:
            found += complaints(name, answers, workflow, READERS[entry])
    assert not found, "\n".join(found)
    record_property("count", f"{len(mutations)} parameters")


def rules_of(script: Path) -> tuple[str, ...]:
    return SHARED_SCRIPTS.get(script.stem, (script.stem,))


@pytest.fixture
def code_hash(tmp_path: Path) -> CodeHash:
    return CodeHash(tmp_path / "memory.json")


def test_modules(
    complete: Repository,
    copies: queue.Queue,
    workflow: Workflow,
    code_hash: CodeHash,
    record_property,
) -> None:
    """(d) every module changed once: both tools notice, exactly the rules that import it run"""
    users: dict[str, set[str]] = {}
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        for path in code_hash.files(script):
            users.setdefault(str(path.relative_to(ROOT)), set()).update(rules_of(script))
    found = []
    mutations = list(of_code(complete.path, "src/grasptypes"))
    for name, answers in sweep(copies, mutations).items():
        rules = users.get(name, set()) & set(workflow.rules.values())
        entry = longest(name, NO_RESULT_CODE)
        if name not in users and not entry and not name.endswith("__init__.py"):
            found.append(f"{name}: no rule uses it, and no reason is given")
        if rules and entry:
            found.append(f"{name}: is used by {sorted(rules)}, whatever is said of {entry}")
        found += complaints(name, answers, workflow, rules)
        if not answers.stages:
            found.append(f"{name}: dvc does not notice")
    assert not found, "\n".join(found)
    record_property("count", f"{len(mutations)} modules")


def test_what_python_imports_is_hashed(complete: Repository, code_hash: CodeHash) -> None:
    """(d) every module that Python loads for a script is among those that its rule hashes"""
    scripts = sorted((complete.path / "workflow/scripts").glob("*.py"))
    with ThreadPoolExecutor(WORKERS) as pool:
        loaded = pool.map(
            lambda script: modules_of(complete.path, complete.environment(), str(script)), scripts
        )
    for script, modules in zip(scripts, loaded, strict=True):
        hashed = {
            str(path.relative_to(ROOT))
            for path in code_hash.files(ROOT / "workflow/scripts" / script.name)
        }
        assert len(modules) > 2, f"{script.name}: {modules}"
        assert modules <= hashed, f"{script.name}: {sorted(modules - hashed)}"


def test_scripts(
    complete: Repository, copies: queue.Queue, workflow: Workflow, record_property
) -> None:
    """(d) every script changed once: both tools notice, exactly its rule runs"""
    mutations = list(of_code(complete.path, "workflow/scripts"))
    found = []
    for name, answers in sweep(copies, mutations).items():
        rules = set(rules_of(Path(name))) & set(workflow.rules.values())
        found += complaints(name, answers, workflow, rules)
        if not answers.stages:
            found.append(f"{name}: dvc does not notice")
    assert not found, "\n".join(found)
    record_property("count", f"{len(mutations)} scripts")


def test_assets(complete: Repository, copies: queue.Queue, workflow: Workflow) -> None:
    """(d) every asset replaced by an older file: both tools notice, exactly its readers run"""
    hand = sorted((complete.path / "assets/barrett_hand").rglob("*"))
    files = [path for path in hand if path.suffix in (".obj", ".urdf")]
    mutations = [
        Mutation(name, name, (complete.path / name).read_text() + "\n")
        for name in (str(path.relative_to(complete.path)) for path in files)
    ]
    labels = complete.path / "assets/published_labels.csv"
    lines = labels.read_text().splitlines()
    other = "\n".join([*lines[:-2], lines[-1], lines[-2]]) + "\n"
    mutations.append(Mutation("labels", "assets/published_labels.csv", other))
    found = []
    for name, answers in sweep(copies, mutations).items():
        readers = ("label_published", "compare_distribution")
        rules = readers if name == "labels" else ("synthesize_grasps",)
        found += complaints(name, answers, workflow, rules)
    assert not found, "\n".join(found)


def test_a_row_of_the_affinity_table(complete: Repository, copies: queue.Queue) -> None:
    """(d) one row of the affinity table changed: that object's and task's jobs and their readers"""
    table = (complete.path / "assets/affinities.csv").read_text()
    lines = table.splitlines()
    row = next(number for number, line in enumerate(lines) if line.startswith("banana,use,"))
    cells = lines[row].split(",")
    cells[8] = f"{float(cells[8]) + 1:g}"
    lines[row] = ",".join(cells)
    mutation = Mutation("row", "assets/affinities.csv", "\n".join(lines) + "\n")
    planned = sweep(copies, [mutation])["row"].planned
    assert planned["map_contacts"] == planned["synthesize_grasps"] == planned["picture_grasps"] == 1
    assert planned["render_object"] == planned["prepare_object"] == 0
    assert planned["label_grasps"] == 1

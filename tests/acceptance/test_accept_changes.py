"""(d), (e), (g): a change reruns what it affects, whichever tool is asked, and nothing else."""

from __future__ import annotations

import pytest
import yaml
from repository import Repository, jobs

TABLES = {"tabulate_simulated": 1, "tabulate_published": 1, "tabulate_unseen": 1}
TABLES |= {"summarise_scores": 1}
DETAILS = {"tabulate_types": 1, "tabulate_objects": 1, "plot_folds": 1, "plot_losses": 1}
LEARNING = {"train_predictor": 8, "leave_out_objects": 8, **TABLES, **DETAILS}


# Rules that only name what is wanted.
TARGETS = {"all", "objects", "contact_maps", "grasps", "screenshots"}
TARGETS |= {"renders", "features", "predictors"}


def made(repository: Repository, tool: str) -> dict[str, int]:
    """The jobs that a tool runs to bring everything up to date."""
    return work(repository.snakemake("all") if tool == "snakemake" else repository.dvc("repro"))


def work(output: str) -> dict[str, int]:
    """The jobs that a tool's output announces, but for those that make nothing."""
    return {rule: count for rule, count in jobs(output).items() if rule not in TARGETS}


def change_setting(repository: Repository) -> None:
    repository.set_param("predictors.epochs", 7)


def change_module(repository: Repository) -> None:
    path = repository.path / "src/grasptypes/reports/result_text.py"
    path.write_text(path.read_text() + "\n_MUTATED = 1\n")


def change_script(repository: Repository) -> None:
    path = repository.path / "workflow/scripts/plot_renders.py"
    path.write_text(path.read_text() + "\n_MUTATED = 1\n")


@pytest.mark.parametrize("first", ["snakemake", "dvc"])
@pytest.mark.parametrize(
    ("change", "expected"),
    [(change_module, TABLES), (change_script, {"plot_renders": 1})],
    ids=["module", "script"],
)
def test_d_either_tool(changed: Repository, change, expected: dict[str, int], first: str) -> None:
    """(d) one change, one tool: exactly the affected jobs; then the other tool: none"""
    change(changed)
    second = "dvc" if first == "snakemake" else "snakemake"
    assert made(changed, first) == expected
    assert made(changed, second) == {}
    if second == "snakemake":
        assert changed.is_clean()


def test_d_parameter(changed: Repository) -> None:
    """(d) one parameter, dvc repro: exactly the affected jobs; then snakemake: none"""
    change_setting(changed)
    assert made(changed, "dvc") == LEARNING
    assert made(changed, "snakemake") == {}
    assert changed.is_clean()


def test_d_comments_and_touches(changed: Repository) -> None:
    """(d) comments in params.yaml, a script and a module, and a touch of every file: no job"""
    for name in ("params.yaml", "workflow/scripts/train_predictor.py", "src/grasptypes/seeds.py"):
        path = changed.path / name
        path.write_text(path.read_text() + "\n# A remark.\n")
    changed.run("bash", "-c", "find . -type f -not -path './.*' | shuf | xargs touch")
    assert changed.snakemake_is_clean("all")
    assert made(changed, "dvc") == {}
    assert changed.is_clean()


def test_e_objects(changed: Repository, complete: Repository) -> None:
    """(e) an object added, then removed: its jobs and what aggregates; nothing is left behind"""
    aggregates = {"label_grasps": 1, "label_published": 1, "split_folds": 1} | LEARNING
    sheets = {"compare_distribution": 1, "plot_label_tree": 1, "plot_sessions": 1}
    sheets |= {"plot_grasps": 1, "plot_rejected_grasps": 1}
    sheets |= {"plot_contact_maps": 1, "plot_renders": 1}
    changed.set_param("objects.names", ["apple", "banana", "mug"])
    assert made(changed, "snakemake") == aggregates | sheets | {
        "prepare_object": 1,
        "map_contacts": 2,
        "synthesize_grasps": 2,
        "picture_grasps": 1,
        "render_object": 1,
        "extract_features": 1,
    }
    assert made(changed, "dvc") == {}
    assert changed.is_clean()
    changed.commit("An apple")
    changed.set_param("objects.names", ["banana", "mug"])
    assert made(changed, "dvc") == aggregates | sheets
    assert made(changed, "snakemake") == {}
    assert changed.is_clean()
    versioned = ("data", "models", "reports", ".snakemake/metadata")
    assert files(changed, *versioned) == files(complete, *versioned)


def files(repository: Repository, *folders: str) -> set[str]:
    paths = (path for folder in folders for path in (repository.path / folder).rglob("*"))
    return {str(path.relative_to(repository.path)) for path in paths}


def test_g_experiment(changed: Repository) -> None:
    """(g) dvc exp run -S in the workspace: only the affected jobs, then nothing to do"""
    output = changed.dvc("exp", "run", "-n", "wide", "-S", "renders.sheet.views=2")
    assert work(output) == {"plot_renders": 1}
    assert changed.is_clean()


def test_g_temporary_experiment(changed: Repository) -> None:
    """(g) dvc exp run --temp -S: only the affected jobs, and the workspace stays as it is"""
    before = (changed.path / "dvc.lock").read_bytes()
    output = changed.dvc("exp", "run", "--temp", "-n", "tall", "-S", "renders.sheet.views=3")
    assert work(output) == {"plot_renders": 1}
    assert (changed.path / "dvc.lock").read_bytes() == before
    assert changed.is_clean()
    changed.dvc("exp", "apply", "tall")
    assert (
        yaml.safe_load((changed.path / "params.yaml").read_text())["renders"]["sheet"]["views"] == 3
    )
    assert changed.is_clean()

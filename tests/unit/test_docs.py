"""README, docs and forms: links lead somewhere, commands exist, notebooks run."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

from grasptypes.commands.command_line import parser
from grasptypes.settings.params import Params

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "docs").rglob("*.ipynb"))
PAGES = [
    *sorted(ROOT.glob("*.md")),
    ROOT / "config/README.md",
    *sorted((ROOT / "docs").rglob("*.md")),
    *NOTEBOOKS,
]
FORMS = [*sorted((ROOT / ".github").rglob("*.yml")), ROOT / ".snakemake-workflow-catalog.yml"]
BLOCK = re.compile(r"^( *)```(\w*)\n(.*?)^\1```$", re.M | re.S)
SHELL = ("", "bash", "console", "sh")


def cells(notebook: Path, kind: str) -> list[str]:
    """The text of a notebook's cells of one kind."""
    found = json.loads(notebook.read_text())["cells"]
    return ["".join(cell["source"]) for cell in found if cell["cell_type"] == kind]


def text_of(page: Path) -> str:
    if page.suffix == ".ipynb":
        return "\n\n".join(cells(page, "markdown"))
    return page.read_text()


def anchors(page: Path) -> set[str]:
    """Names of a page's headings, which the repository page and the site form alike."""
    headings = re.findall(r"^#+ (.+)$", BLOCK.sub("", text_of(page)), re.M)
    return {re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-") for heading in headings}


def examples(page: Path) -> list[list[str]]:
    """The words of each `grasptypes` command line in a page's blocks; brackets of options go."""
    blocks = [code for _, language, code in BLOCK.findall(text_of(page)) if language in SHELL]
    lines = re.findall(r"^ *(?:\$ )?(grasptypes .+)$", "\n".join(blocks), re.M)
    return [shlex.split(re.sub(r"[][]", "", line), comments=True) for line in lines]


def mentions(page: Path) -> list[str]:
    """The commands in a page's text, such as `grasptypes plan --hand`: not always complete."""
    return re.findall(r"`(grasptypes [^`]+)`", BLOCK.sub("", text_of(page)))


def status(words: list[str]) -> int:
    """Exit status of parsing a command line: 2 if there is no such command or option."""
    try:
        parser().parse_args(words[1:])
    except SystemExit as ended:
        return int(ended.code or 0)
    return 0


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_and_anchor_leads_somewhere(page: Path) -> None:
    for link in re.findall(r"\]\(\s*([^)\s]+)\s*\)", BLOCK.sub("", text_of(page))):
        if "://" in link:
            continue
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_every_page_is_in_the_table_of_contents() -> None:
    docs, contents = ROOT / "docs", (ROOT / "mkdocs.yml").read_text()
    pages = {str(page.relative_to(docs)) for page in PAGES if page.is_relative_to(docs)}
    assert pages == set(re.findall(r": (\S+\.(?:md|ipynb))$", contents, re.M))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_command_is_one(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words in examples(page):
        assert status(words) == 0, shlex.join(words)
    for mention in mentions(page):
        words = mention.split()
        names = [name for name in words[1 : 3 if words[1] == "hand" else 2] if name[0] != "-"]
        capsys.readouterr()
        assert status(["grasptypes", *names, "--help"]) == 0, mention
        options = {word.split("=")[0] for word in words if word.startswith("--")}
        assert options <= set(re.findall(r"--[\w-]+", capsys.readouterr().out)), mention


def test_the_checks_see_commands_and_mistakes() -> None:
    """Without this, a changed pattern would make the tests above pass on anything."""
    assert sum(len(examples(page)) for page in PAGES) > 15
    assert sum(len(mentions(page)) for page in PAGES) > 15
    for wrong in ("grasptypes fly", "grasptypes plan --object a.stl --task use --colour red"):
        assert status(wrong.split()) == 2


def test_every_make_target_is_one() -> None:
    targets = set(re.findall(r"^([a-z][\w-]+):", (ROOT / "Makefile").read_text(), re.M))
    texts = [text_of(page) for page in PAGES]
    texts += [path.read_text() for path in (ROOT / ".github").rglob("*.*")]
    named = set(re.findall(r"(?:^ *|`|run: )make ([a-z][\w-]+)", "\n".join(texts), re.M))
    assert len(named) > 10
    assert named <= targets


def test_the_sections_of_the_configuration_are_described() -> None:
    described = re.findall(r"`(\w+)`", (ROOT / "config/README.md").read_text())
    assert set(Params.model_fields) <= set(described)


def test_the_citation_has_the_version_of_the_package() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert (citation["version"], citation["license"]) == (project["version"], project["license"])


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.name)
def test_a_form_of_the_repository_is_yaml(path: Path) -> None:
    assert isinstance(yaml.safe_load(path.read_text()), dict)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.name)
def test_a_notebook_runs_and_has_no_outputs(notebook: Path, tmp_path: Path) -> None:
    code = "\n".join(cells(notebook, "code"))
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    stored = json.loads(notebook.read_text())["cells"]
    assert not any(cell.get("outputs") for cell in stored)

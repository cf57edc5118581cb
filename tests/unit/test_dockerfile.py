"""The image is the environment of `make setup`: what the Dockerfile names must exist here."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
# A step that goes on in the next line is one line here.
STEPS = (ROOT / "Dockerfile").read_text().replace("\\\n", " ").splitlines()
IGNORED = (ROOT / ".dockerignore").read_text().splitlines()
ALLOWED = {line[1:] for line in IGNORED if line.startswith("!")}


def arguments(instruction: str) -> list[str]:
    steps = [step for step in STEPS if step.startswith(instruction)]
    return [step.removeprefix(instruction).strip() for step in steps]


def test_the_environment_is_that_of_make_setup() -> None:
    assert "make setup" in arguments("RUN ")
    assert re.search(r"^setup:", (ROOT / "Makefile").read_text(), re.MULTILINE)


def test_every_copied_file_exists_and_gets_into_the_build() -> None:
    for copied in arguments("COPY "):
        *sources, _ = [word for word in copied.split() if not word.startswith("--")]
        for source in sources:
            assert (ROOT / source).exists(), source
            assert source == "." or Path(source).parts[0] in ALLOWED, source

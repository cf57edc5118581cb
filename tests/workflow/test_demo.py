"""The demo page in a real browser, without a network; screenshots are in the temporary folder."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("selenium", reason="no selenium: pip install -e .[dev]")
from browser import browser, foreign_hosts, missing_programs, wait_for
from PIL import Image
from selenium.webdriver import Chrome

from grasptypes.predictors.general_predictor import TRAINED
from grasptypes.predictors.known_kinds import LOOKS, read_looks

pytestmark = pytest.mark.skipif(bool(missing_programs()), reason=missing_programs())

ANSWERED = "!document.getElementById('answer').hidden && document.querySelectorAll('.type').length"


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    command = [sys.executable, "-m", "grasptypes", "demo", "--no-browser"]
    process = subprocess.Popen(
        command,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        text=True,
        # Shells start what they put in the background with SIGINT ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert process.stdout is not None
    yield process.stdout.readline().split()[0]
    process.send_signal(signal.SIGINT)
    assert process.wait(30) == 130


def test_an_image_is_answered_explained_and_compared(address: str, tmp_path: Path) -> None:
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/", address)
    (cup,) = read_looks(["mug"], TRAINED / LOOKS)
    Image.fromarray(cup).resize((300, 300)).save(tmp_path / "mug.png")
    (tmp_path / "note.png").write_text("no image")
    with browser(tmp_path / "profile") as driver:
        driver.get(address)
        driver.find_element("id", "file").send_keys(str(tmp_path / "mug.png"))
        assert wait_for(driver, ANSWERED) == 6
        check_answer(driver, tmp_path)
        driver.find_element("id", "file").send_keys(str(tmp_path / "note.png"))
        said = wait_for(driver, "document.getElementById('error').textContent")
        assert said.startswith("the image: not an image")
        assert not driver.find_element("id", "answer").is_displayed()
        assert foreign_hosts(driver) == set()
    assert sorted(path.name for path in tmp_path.glob("*.png")) == [
        "answer.png",
        "heat.png",
        "mug.png",
        "note.png",
    ]


def check_answer(driver: Chrome, folder: Path) -> None:
    """Look at the answer as a user does."""
    assert driver.execute_script("return document.querySelectorAll('#looks img').length") == 3
    shown = driver.find_element("id", "shown")
    plain = shown.get_attribute("src")
    driver.save_screenshot(str(folder / "answer.png"))
    driver.find_element("class name", "type").click()
    assert shown.get_attribute("src") != plain
    assert "blue against it" in driver.find_element("id", "legend").text
    driver.save_screenshot(str(folder / "heat.png"))
    driver.find_element("id", "size").send_keys("9cm")
    before = driver.find_element("id", "types").text
    driver.find_element("css selector", "button:not(.type)").click()
    assert wait_for(driver, "document.getElementById('types').innerText !== arguments[0]", before)

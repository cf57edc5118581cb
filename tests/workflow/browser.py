"""Headless Chromium for tests, the servers it visits, and what it asked of the network."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from repository import Repository
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

PROGRAMS = ("chromium", "chromedriver")
OPTIONS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--disable-dev-shm-usage", "--window-size=1600,1000"),
    # Nothing but this machine is there: a page that needs more fails in front of the test.
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
)
PATIENCE_S = 60


def missing_programs() -> str:
    """What a test in a browser lacks, with the command that gets it; empty if nothing."""
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    return f"no {missing[0]}: apt-get install chromium chromium-driver" if missing else ""


@contextlib.contextmanager
def browser(profile: Path) -> Iterator[webdriver.Chrome]:
    """Chromium with a new profile, and a log of all it asks for."""
    options = webdriver.ChromeOptions()
    options.binary_location = str(shutil.which("chromium"))
    for option in (*OPTIONS, f"--user-data-dir={profile}"):
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    driver = webdriver.Chrome(options, Service(str(shutil.which("chromedriver"))))
    try:
        yield driver
    finally:
        driver.quit()


def wait_for(driver: webdriver.Chrome, script: str, *arguments: Any) -> Any:
    """What a JavaScript expression gives, once that is something."""

    def value(_: object) -> Any:
        return driver.execute_script(f"return {script}", *arguments)

    return WebDriverWait(driver, PATIENCE_S).until(value, f"never true: {script} {arguments}")


def foreign_hosts(driver: webdriver.Chrome) -> set[str]:
    """Every host but this machine that pages asked something of since the last call."""
    events = (json.loads(entry["message"])["message"] for entry in driver.get_log("performance"))
    urls = [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]
    return {urlsplit(url).netloc for url in urls if url.startswith(("http", "ws"))} - {
        urlsplit(url).netloc for url in urls if urlsplit(url).hostname == "127.0.0.1"
    }


def make(*arguments: str) -> tuple[str, ...]:
    """A call of the project's own Makefile in this environment, which needs no set-up."""
    return ("make", "-o", "setup", f"VENV={sys.prefix}", *arguments)


@contextlib.contextmanager
def served_runs(repository: Repository) -> Iterator[str]:
    """`make ui` in a repository; the link that it prints."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    process = subprocess.Popen(
        make("ui", f"UI_PORT={port}"),
        cwd=repository.path,
        env={**repository.environment(), "PYTHONPATH": str(repository.path / "src")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        assert process.stdout is not None
        # Before it stands what was published.
        link = next(line for line in process.stdout if line.startswith("runs:")).split()[-1]
        threading.Thread(target=process.stdout.read, daemon=True).start()
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{port}/health", timeout=5).close()
                break
            except OSError:
                assert time.monotonic() < deadline
                time.sleep(0.2)
        yield link
    finally:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait(PATIENCE_S)

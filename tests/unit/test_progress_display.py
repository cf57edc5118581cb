"""The display of a run's progress has the time left."""

import logging
import os
import pty
import subprocess
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from grasptypes.progress_display import show_time_left


class Display(logging.NullHandler):
    """Like the handler of `--logger rich`."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 0.0
        self.progress = Progress("{task.description}", console=Console(), get_time=lambda: self.now)


def test_the_time_left_follows_the_pace_of_the_jobs() -> None:
    display = Display()
    show_time_left([logging.NullHandler(), display])
    task = display.progress.add_task("Total", total=10)
    for jobs in range(1, 5):
        display.now = 60.0 * jobs
        display.progress.update(task, completed=jobs)
    console = Console(width=80)
    with console.capture() as printed:
        console.print(display.progress)
    assert printed.get().split() == ["Total", "left", "0:06:00"]


def test_make_asks_for_the_display_on_a_terminal_only() -> None:
    command = ["make", "--eval", "shown: ; @echo $(SNAKEMAKE)", "shown"]
    root = Path(__file__).parents[2]
    terminal, end = pty.openpty()
    for stderr, expected in ((end, True), (subprocess.DEVNULL, False)):
        said = subprocess.run(
            command, cwd=root, stdout=subprocess.PIPE, stderr=stderr, text=True, check=True
        )
        assert ("--logger rich" in said.stdout) == expected
    os.close(terminal)
    os.close(end)

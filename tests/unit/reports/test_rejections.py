"""Examples of rejected grasps."""

import pandas as pd

from grasptypes.reports.rejections import IN_WORDS, caption, examples, heading
from grasptypes.synthesis.grasps import REASONS


def attempts() -> pd.DataFrame:
    rows = [
        ("mug", 0.1, "dropped"),
        ("mug", 0.2, "dropped"),
        ("pan", 0.9, "dropped"),
        ("mug", 0.3, "penetrates"),
        ("pan", 0.0, ""),
    ]
    table = pd.DataFrame(rows, columns=["object", "energy", "reason"])
    lengths = {"penetration_m": 0.0031, "moved_m": 0.051, "turned_rad": 0.5}
    numbers = range(len(rows))
    table = table.assign(task="use", session=numbers, rank=numbers, **lengths)
    return table.assign(valid=table.reason == "")


def test_every_object_has_its_turn_before_the_next_best_comes() -> None:
    chosen = examples(attempts(), 2)
    assert chosen.reason.tolist() == ["penetrates", "dropped", "dropped"]
    assert chosen[chosen.reason == "dropped"].object.tolist() == ["mug", "pan"]
    assert len(examples(attempts(), 3)) == 4


def test_reasons_are_told_with_what_was_measured() -> None:
    table = attempts()
    assert heading(table, "dropped").endswith("(dropped): 3 of 5 attempts")
    assert [caption(row) for row in table.iloc[[0, 3]].itertuples()] == [
        "mug, use: moved 51 mm, 29°",
        "mug, use: 3.1 mm deep",
    ]


def test_every_reason_has_its_words() -> None:
    assert set(IN_WORDS) == set(REASONS)

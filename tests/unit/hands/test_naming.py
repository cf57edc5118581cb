"""Hands are data: no line of code or of the workflow is about one of them."""

from pathlib import Path

import pytest

import grasptypes
from grasptypes.hands.folders import HANDS, hand_names

SOURCE = Path(grasptypes.__file__).parent
WORKFLOW = Path(__file__).parents[3] / "workflow"
TEXT = {".py", ".smk", ".yaml", ".json", ".rst", ".html", ".js", ".css"}


@pytest.mark.parametrize("word", sorted({name.split("_")[0] for name in hand_names()}))
def test_only_the_folders_of_hands_name_a_hand(word: str) -> None:
    files = [path for folder in (SOURCE, WORKFLOW) for path in folder.rglob("*")]
    texts = [path for path in files if path.suffix in TEXT and HANDS not in path.parents]
    assert len(texts) > 300
    assert [path for path in texts if word in path.read_text(encoding="utf-8").lower()] == []

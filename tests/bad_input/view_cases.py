"""Mistakes in what is asked of `grasptypes view`."""

from __future__ import annotations

from case import Case, Content
from command_cases import CONFIGURATIONS
from picture_cases import command

TABLE = CONFIGURATIONS.replace("Hand", "Object,Intent,Session,GraspType,Error,Hand", 1).replace(
    '\n"', '\ncup,use,1,Precision,0.5,"', 1
)


def viewed(what: str, shown: str, *names: str, **files: Content) -> Case:
    """A call that would write a page; files by their names without the dot."""
    contents = {name.replace("_", "."): content for name, content in files.items()}
    return Case("view", what, contents, command("view", shown, "--output", "page.html"), names)


CASES = [
    viewed("neither file nor object", "cup", "cup: no such file or folder", "--folder"),
    viewed("a missing table", "no.csv", "no.csv: no such file"),
    viewed("a table without objects", "a.csv", "a.csv: Object: this column", a_csv=CONFIGURATIONS),
    viewed(
        "a session that is no number",
        "a.csv",
        "a.csv: line 2, Session: not a number in 'one'",
        a_csv=TABLE.replace("use,1", "use,one"),
    ),
    viewed(
        "an energy that is no number",
        "a.csv",
        "a.csv: line 2, Error: not a number in 'low'",
        a_csv=TABLE.replace("0.5", "low"),
    ),
    viewed(
        "a table without its objects", "a.csv", "objects/cup/visual.glb: is missing", a_csv=TABLE
    ),
    viewed("a damaged plan", "a.csv", "plan.json: is not the summary", a_csv=TABLE, plan_json="{"),
    Case(
        "view",
        "a page that is not HTML",
        {},
        command("view", "cup", "--output", "page.txt"),
        ("page.txt: must end in .html",),
    ),
    Case(
        "view",
        "a port that does not exist",
        {},
        command("view", "cup", "--port", "99999"),
        ("--port", "99999 is not a port"),
    ),
]

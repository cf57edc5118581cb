"""All grasps of an object, by task and session."""

from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.renders.archives import read_named_pictures
from grasptypes.renders.renderer import png_bytes
from grasptypes.reports.session_pictures import session_groups
from grasptypes.reports.sheets import INK, WARNING


def test_each_session_has_its_picture_with_type_or_reason(tmp_path: Path) -> None:
    names = [f"mug_{session}_use.png" for session in (1, 2)]
    greys = {name: np.full((4, 4, 3), 10 * n, np.uint8) for n, name in enumerate(names, start=1)}
    archive = tmp_path / "mug.zip"
    write_bytes(archive, zip_bytes({name: png_bytes(greys[name], 1) for name in names}))
    rows = pd.DataFrame(
        {
            "Object": "mug",
            "Intent": "use",
            "Session": [2, 1],
            "GraspType": ["Invalid", "Precision"],
            "reason": ["dropped", "valid"],
            "Image": [f"screenshots/{name}" for name in reversed(names)],
        }
    )
    (group,) = session_groups(rows, read_named_pictures(archive), ["use"])
    assert group.heading == "mug, use: 1 of 2 valid"
    told = [(tile.caption, tile.colour, tile.picture[0, 0, 0]) for tile in group.tiles]
    assert told == [("1 Precision", INK, 10), ("2 dropped", WARNING, 20)]

"""What limits the predictor for unseen objects: label noise, confusions, and its answers."""

import io
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd
from PIL import Image

from grasptypes.files import write_bytes
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema
from grasptypes.labels.samples import LABELS, TYPES, read_samples
from grasptypes.objects.object_files import read_properties
from grasptypes.predictors.general_protocol import (
    ANSWER_SCHEMA,
    KINDS,
    OBJECTS,
    OCCURS,
    SIMULATED,
    VIEWS_WITH_SIZE,
)
from grasptypes.predictors.metrics import SIGMOID_THRESHOLD
from grasptypes.predictors.prediction import spelled
from grasptypes.renders.archives import read_pictures
from grasptypes.reports.general_analysis import (
    CONFUSION_SCHEMA,
    HALVES,
    LIMIT_SCHEMA,
    SIMULATED_LABELS,
    confusion_rows,
    halves,
    limit_row,
    looked_at,
    touched_role,
)
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.reports.table3 import score
from grasptypes.settings.tasks import read_tasks
from grasptypes.tables import read_table, write_table

# Of each tile and in each row.
TILE_PX, COLUMNS = 240, 5
# Noise in images takes much room.
QUALITY = 85


def label_limits(
    datasets: Mapping[str, str], samples: Mapping[str, str], hand: str
) -> pd.DataFrame:
    """How far labels agree with themselves, and simulated with published ones: `LIMIT_SCHEMA`."""
    schema, rows = dataset_schema(load_hand(hand)), []
    for shown, path in datasets.items():
        odd, even = halves(read_table(path, schema))
        told, true = pd.concat([odd, even]), pd.concat([even, odd])
        where = {"shown": shown, "labels": SIMULATED, "answer": HALVES}
        rows.append(limit_row(told, true, where, sets=False))
    simulated = read_samples(samples[SIMULATED])
    for source, path in samples.items():
        if source != SIMULATED:
            true = read_samples(path)
            told = true[["object", "task"]].merge(simulated)
            where = {"shown": OBJECTS, "labels": source, "answer": SIMULATED_LABELS}
            rows.append(limit_row(told, true, where, sets=True))
    return pd.DataFrame(rows)


def caption(row: pd.Series) -> str:
    """What an object is held with, and what is predicted, in five lines."""
    true = [spelled(name) for name, label in zip(TYPES, LABELS, strict=True) if row[label]]
    told = [
        f"{spelled(name)} {row[chance]:.2f}"
        for name, chance in sorted(zip(TYPES, OCCURS, strict=True), key=lambda pair: -row[pair[1]])
        if row[chance] > SIGMOID_THRESHOLD
    ]
    name = f"{row['object'].rsplit('_', 1)[0].replace('_', ' ')}, {row['task']}"
    title = f"{name}: {row['similarity']:.2f}"
    return "\n".join([title, *_two_lines("held: ", true), *_two_lines("told: ", told)])


def _two_lines(start: str, words: Sequence[str]) -> tuple[str, str]:
    half = -(-len(words) // 2)
    return start + ", ".join(words[:half]), ", ".join(words[half:]) or " "


def picture_rows(scored: pd.DataFrame, archives: Mapping[str, str], count: int) -> bytes:
    """JPEG of the worst answers, and of others from the worst to the best."""
    groups = [
        Group(
            heading,
            [
                Tile(read_pictures(archives[row["object"]])[0], caption(row))
                for _, row in rows.iterrows()
            ],
        )
        for heading, rows in zip(
            ("The objects answered worst", "Others, from bad to good"),
            looked_at(scored, count),
            strict=True,
        )
    ]
    buffer = io.BytesIO()
    Image.fromarray(sheet(groups, COLUMNS, TILE_PX)).save(buffer, "JPEG", quality=QUALITY)
    return buffer.getvalue()


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, outputs, params = snakemake.input, snakemake.output, snakemake.params
        limits = label_limits(
            {KINDS: inputs.kind_dataset, OBJECTS: inputs.dataset},
            dict(zip(params.labels, inputs.samples, strict=True)),
            params.hand["name"],
        )
        write_table(limits, outputs.limits, LIMIT_SCHEMA)
        answers = read_table(inputs.answers, ANSWER_SCHEMA)
        mine = answers[(answers["shown"] == KINDS) & (answers["model"] == VIEWS_WITH_SIZE)]
        scored = score(mine, read_samples(inputs.kind_samples))
        known = [read_properties(path) for path in inputs.properties]
        roles = {one.object: [part["role"] for part in one.roles.values()] for one in known}
        touched = [
            touched_role(roles[name], read_tasks()[task])
            for name, task in zip(scored["object"], scored["task"], strict=True)
        ]
        table = pd.DataFrame(confusion_rows(scored, touched))
        write_table(table, outputs.confusions, CONFUSION_SCHEMA)
        archives = {Path(path).stem: path for path in inputs.pictures}
        write_bytes(outputs.pictures, picture_rows(scored, archives, params.shown))

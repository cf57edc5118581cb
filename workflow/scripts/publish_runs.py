"""Show finished results in MLflow; reads files only, so the store can be rebuilt at any time."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

import grasptypes.files
from grasptypes.features import read_pictures
from grasptypes.jobs import job
from grasptypes.learning_inputs import read_backbone_record, recorded_weights
from grasptypes.predictor_files import read_card
from grasptypes.run_records import Finished, file_digest, run_record, serving_requirements
from grasptypes.tracking import LoggedModel, RunRecord, Store, publish


def publish_runs(
    finished: Sequence[Finished],
    pictures: str,
    backbone: str,
    target: str,
    tags: Mapping[str, str],
    params: Mapping[str, Any],
    tracking: Mapping[str, Any],
) -> int:
    """Upsert a parent run for each finished model and write the list of keys to `target`."""
    weights = recorded_weights(read_backbone_record(backbone))
    example = read_pictures(pictures)[:1]
    records: list[RunRecord] = []
    models: dict[str, tuple[str, LoggedModel]] = {}
    for files in finished:
        record = run_record(files, params, tags)
        card = read_card(files.card)
        records.append(record)
        artifacts = {"tensors": files.tensors, "card": files.card, "weights": weights.path}
        package = Path(grasptypes.files.__file__).parent
        models[record.key] = (
            file_digest(files.tensors),
            LoggedModel(
                f"{card.labels}_{card.model}",
                artifacts,
                package,
                serving_requirements(),
                example,
                card.tasks[0],
                len(card.types),
            ),
        )
    new = publish(Store(tracking["database"], tracking["experiment"]), records, models)
    rows = [
        (run.key, r.key if run is not r else "", run.name)
        for r in records
        for run in (r, *r.children)
    ]
    table = pd.DataFrame(rows, columns=["key", "parent", "name"])
    grasptypes.files.write_text(target, table.to_csv(index=False, lineterminator="\n"))
    return new


if __name__ == "__main__":
    with job(snakemake.log) as logger:
        columns = (snakemake.input[k] for k in ("metrics", "curves", "tensors", "cards"))
        finished = [Finished(*map(Path, paths)) for paths in zip(*columns, strict=True)]
        count = publish_runs(
            finished,
            snakemake.input.pictures,
            snakemake.input.backbone,
            snakemake.output.runs,
            snakemake.params.tags(),
            snakemake.params.settings,
            snakemake.params.tracking,
        )
        logger.info("%d new runs", count)

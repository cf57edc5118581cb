"""Find the backbone's weights and record which they are; the only job that may download them."""

from pathlib import Path

from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.learning_inputs import write_backbone_record
from grasptypes.predictors.weights import find_weights


def prepare_backbone(record: str | Path, timeout_s: float, input_px: int) -> str:
    """Write the record of the weights, after loading them once; returns a line about them."""
    weights = find_weights(timeout_s)
    load_backbone(weights, input_px)
    write_backbone_record(weights, input_px, record)
    return f"backbone {weights.backbone}, weights {weights.name} from {weights.source}"


if __name__ == "__main__":
    with job(snakemake.log) as logger:
        logger.info(
            prepare_backbone(
                snakemake.output.record, snakemake.params.timeout_s, snakemake.params.input_px
            )
        )

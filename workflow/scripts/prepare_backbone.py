"""Find and record the backbone's weights; the only job that may download them."""

from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, BackboneRecord, find_weights


def prepare_backbone(record: str | Path, chosen: str, timeout_s: float, input_px: int) -> str:
    """Load the weights once and write their record; returns a line for the log.

    Args:
        chosen: `default`, or a prefix of the required checksum.
    """
    weights = find_weights(timeout_s)
    if chosen != "default" and not weights.sha256.startswith(chosen):
        message = (
            f"is not set: the results here were made with weights {chosen}, but "
            f"{weights.name} was found; name that file, or start again to use what was found"
        )
        raise InputError(WEIGHTS_VARIABLE, "", message)
    load_backbone(weights, input_px)
    BackboneRecord.of(weights, input_px).write(record)
    return f"backbone {weights.backbone}, weights {weights.name} from {weights.source}"


if __name__ == "__main__":
    with job(snakemake.log) as logger:
        logger.info(
            prepare_backbone(
                snakemake.output.record,
                snakemake.params.weights,
                snakemake.params.timeout_s,
                snakemake.params.input_px,
            )
        )

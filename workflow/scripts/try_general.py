"""Trials of the predictor for unseen objects on held-out kinds, and the curve over their number."""

from pathlib import Path

import torch

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.predictors.general_files import read_known_kinds, read_pictures_of
from grasptypes.reports.general_trials import TRIAL_SCHEMA, draw_curve, try_settings
from grasptypes.settings.general import GeneralSettings
from grasptypes.tables import write_table

if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        inputs, params = snakemake.input, snakemake.params
        kinds = read_known_kinds(inputs.kinds, inputs.samples, inputs.properties, params.tasks)
        others = {Path(path).stem: read_pictures_of(path) for path in inputs.backbones}
        table = try_settings(kinds, others, GeneralSettings.check(params.settings), params.seed)
        write_table(table, snakemake.output.table, TRIAL_SCHEMA)
        save_figure(draw_curve(table), snakemake.output.figure)

# The paper's pipeline, in its order: objects, contact maps, grasps, labels, renders, predictors,
# tables. `snakemake -j2 reports/table1.csv` is the main job; `snakemake -n` says what is to be done.
import atexit
import json
import os
import sys
from pathlib import Path

from snakemake.persistence import PersistenceBase
from snakemake.utils import min_version

min_version("9.17")
# The code of this checkout, whatever is installed: a copy of the repository must run its own.
sys.path.insert(0, str(Path(workflow.basedir) / "src"))

from grasptypes.errors import InputError
from grasptypes.settings.params import Params, read_params
from grasptypes.runs.due import note_due, publish_what_is_due, publishing_is_due
from grasptypes.runtime import pin_runtime, use_this_checkout
from grasptypes.versions.guard import FolderLock, remove_leftovers
from grasptypes.versions.job_records import distrust_unrecorded

pin_runtime()
use_this_checkout(workflow.basedir)
try:
    if workflow.is_main_process:
        folder_lock = FolderLock()
        if folder_lock.take():
            remove_leftovers(".")
            was_due = publishing_is_due(Path.cwd())
        distrust_unrecorded(PersistenceBase)
    # Before Snakemake reads them: it lets a duplicate key pass, and runs code if `__use_yte__` is set.
    read_params("params.yaml")
except InputError as error:
    sys.exit(f"error: {error}")


configfile: "params.yaml"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/objects.smk"
include: "workflow/rules/grasps.smk"
include: "workflow/rules/replay.smk"
include: "workflow/rules/galleries.smk"
include: "workflow/rules/labels.smk"
include: "workflow/rules/renders.smk"
include: "workflow/rules/learning.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/details.smk"
include: "workflow/rules/generalisation.smk"
include: "workflow/rules/planning.smk"


wildcard_constraints:
    object="|".join(OBJECTS),
    task="|".join(TASKS),


# A few seconds each, or in need of a network: on a cluster these run beside Snakemake.
localrules:
    fetch_published,
    prepare_backbone,
    label_published,
    split_folds,
    label_grasps,
    compare_distribution,
    tabulate_simulated,
    tabulate_published,
    tabulate_unseen,
    tabulate_types,
    tabulate_objects,
    tabulate_generalisation,
    summarise_scores,
    plot_folds,
    plot_losses,


# A dry run may read along while another run computes; jobs start only for who holds the folder.
# MLflow shows what the files hold: results never depend on its store being there.
onstart:
    if not folder_lock.take():
        sys.exit(1)
    note_due(Path.cwd())


onsuccess:
    if any(Path("models").glob("*/*/predictor.json")):
        shell("python -m grasptypes.runs.publishing || true")


# Without a job to do there is no `onsuccess`, yet an earlier run may have been killed before it.
if workflow.is_main_process and folder_lock.file and was_due:
    atexit.register(lambda: workflow.dryrun or publish_what_is_due(Path.cwd()))


rule all:
    default_target: True
    input:
        [TABLES[labels] for labels in LABELS],
        [rules.tabulate_unseen.output, rules.tabulate_objects.output] if UNSEEN else [],
        DISTRIBUTION,
        rules.summarise_scores.output,
        expand(rules.picture_grasps.output, object=OBJECTS),
        rules.plot_grasps.output,
        rules.plot_rejected_grasps.output,
        rules.plot_sessions.output,
        rules.plot_label_tree.output,
        rules.plot_contact_maps.output,
        rules.plot_renders.output,
        rules.tabulate_types.output,
        rules.plot_folds.output,
        rules.plot_losses.output,

# The pipeline of the paper: objects, contact maps, grasps, labels, renders, predictors, tables.
# `snakemake -j2 reports/table1.csv` is the main job; `snakemake -n` shows what would run.
import json
import os
import sys
from pathlib import Path

from snakemake.utils import min_version

min_version("9.17")
# The folder of this file, also where another workflow uses it as a module, and that workflow's rules.
ROOT = workflow.current_basedir.get_path_or_uri(secret_free=True)
NOT_OURS = {each.name for each in workflow.rules}
# Use the code of this checkout, whatever is installed: a copy of the repository must run its own code.
sys.path.insert(0, str(Path(ROOT) / "src"))

from grasptypes.errors import InputError
from grasptypes.failed_jobs import FailedJobs
from grasptypes.first_run import compiling, downloading
from grasptypes.jobs import reason
from grasptypes.progress_display import show_time_left
from grasptypes.settings.params import Params, read_params
from grasptypes.runtime import pin_runtime, use_this_checkout
from grasptypes.versions.guard import FolderLock, remove_leftovers
from grasptypes.versions.provenance import FILE_HASHES, adopt_provenance

pin_runtime()
use_this_checkout(ROOT)
try:
    if workflow.is_main_process:
        folder_lock, failed_jobs = FolderLock(), FailedJobs()
        if display := workflow.logger_manager.queue_listener:
            show_time_left(display.handlers)
        if folder_lock.take():
            remove_leftovers(".")
            adopt_provenance(Path.cwd())
    # Before Snakemake reads the file: it accepts duplicate keys, and runs code if `__use_yte__` is set.
    read_params("params.yaml")
except (InputError, OSError) as error:
    sys.exit(f"error: {reason(error) or error}")


configfile: "params.yaml"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/objects.smk"
include: "workflow/rules/grasps.smk"
include: "workflow/rules/replay.smk"
include: "workflow/rules/galleries.smk"
include: "workflow/rules/labels.smk"
include: "workflow/rules/robustness.smk"
include: "workflow/rules/renders.smk"
include: "workflow/rules/learning.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/details.smk"
include: "workflow/rules/generalisation.smk"
include: "workflow/rules/demonstrations.smk"
include: "workflow/rules/many_tasks_common.smk"
include: "workflow/rules/many_tasks.smk"
include: "workflow/rules/learning_curve.smk"
include: "workflow/rules/planning.smk"
include: "workflow/rules/tracking.smk"
include: "workflow/rules/kinds_common.smk"
include: "workflow/rules/kinds.smk"
include: "workflow/rules/segmentation.smk"
include: "workflow/rules/general.smk"
include: "workflow/rules/known_kinds.smk"


wildcard_constraints:
    object="|".join(OBJECTS),
    task="|".join(TASKS),


# Quick rules, and those that need a network: on a cluster they run next to Snakemake.
localrules:
    publish_runs,
    fetch_published,
    prepare_backbone,
    label_published,
    split_folds,
    label_grasps,
    label_kind_grasps,
    tabulate_kinds,
    compare_distribution,
    tabulate_simulated,
    tabulate_published,
    tabulate_unseen,
    analyse_labels,
    tabulate_types,
    tabulate_objects,
    tabulate_generalisation,
    tabulate_demonstrations,
    tabulate_grasps_alone,
    label_many_grasps,
    tabulate_many_tasks,
    plot_learning_curve,
    tabulate_robustness,
    tabulate_scan_plans,
    summarise_scores,
    compare_kind_sizes,
    tabulate_general,
    publish_general,
    publish_demonstrations,
    publish_many_tasks,
    plot_folds,
    plot_losses,


# Every job has its own log and benchmark file, and the same environment.
for each in workflow.rules:
    if not each.norun and each.name not in NOT_OURS:
        each.log_modifier = each.benchmark_modifier = workflow.modifier.path_modifier
        each.set_log(f"logs/{job_name(each)}.log")
        each.benchmark = f"logs/benchmarks/{job_name(each)}.tsv"
        each.conda_env = "../envs/grasptypes.yaml"


# A dry run is allowed while another run computes; jobs only start with the folder's lock.
onstart:
    if not folder_lock.take():
        sys.exit(1)
    for line in compiling() + downloading(rules.prepare_backbone.output.record):
        sys.stderr.write(f"{line}\n")


onerror:
    sys.stderr.write(failed_jobs.summary())


# All results that every user can compute; those that need the user's own data have their own targets.
rule results:
    input:
        [TABLES[labels] for labels in LABELS],
        [rules.tabulate_unseen.output, rules.tabulate_objects.output] if UNSEEN else [],
        DISTRIBUTION,
        rules.summarise_scores.output,
        expand(rules.picture_grasps.output, object=OBJECTS),
        rules.plot_grasps.output,
        rules.show_grasps.output,
        rules.plot_rejected_grasps.output,
        rules.plot_sessions.output,
        rules.plot_label_tree.output,
        rules.plot_contact_maps.output,
        rules.plot_renders.output,
        rules.analyse_labels.output if COMPARED else [],
        rules.tabulate_types.output,
        rules.plot_misclassified.output,
        rules.plot_folds.output,
        rules.plot_losses.output,


# The results, and MLflow's view of them.
rule all:
    default_target: True
    input:
        rules.results.input,
        rules.publish_runs.output,


# What `make report` shows: all results, and those of the other targets if they are complete.
EXTRAS = [rules.evaluate_labels, rules.replay_grasps, rules.compare_shapes]
EXTRAS += [rules.tabulate_generalisation, rules.compare_plans, rules.tabulate_robustness]
EXTRAS += [rules.film_grasps, rules.plot_demonstrations, rules.tabulate_demonstrations]
EXTRAS += [rules.tabulate_many_tasks, rules.plot_learning_curve]


rule shown:
    input:
        rules.results.input,
        [each.output for each in EXTRAS if all(Path(path).is_file() for path in each.output)],
        rules.timing.input if Path(rules.timing.input.figure).is_file() else [],

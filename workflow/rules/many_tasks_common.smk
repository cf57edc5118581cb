# Shared by the rules of many tasks: which tasks objects afford, and the files of their grasps.
import functools

from grasptypes.objects.affordances import afforded
from grasptypes.predictors.told import MODELS as TOLD
from grasptypes.predictors.told import corner_shifts

MANY = list(PARAMS.many_tasks.tasks)
FURTHER = "|".join(task for task in MANY if task not in TASKS) or "none"


@functools.cache
def many_pairs():
    """Objects and the tasks that they afford."""
    return afforded(config["objects"]["names"], MANY)


def many_grasps(wildcards):
    """The grasps of all pairs; those of the workflow's own tasks are those of the dataset."""
    files = {True: "data/grasps", False: "data/many_tasks/grasps"}
    return [f"{files[task in TASKS]}/{name}/{task}.parquet" for name, task in many_pairs()]


def further_tasks(name):
    """The tasks of an object that no other result has, in alphabetical order."""
    return sorted(task for own, task in many_pairs() if own == name and task not in TASKS)


def further_objects(wildcards=None):
    """The objects that afford such tasks."""
    return [name for name in config["objects"]["names"] if further_tasks(name)]


def many_shifts():
    """The colour shift of every task."""
    size = max(map(abs, PARAMS.colour_shifts.values()))
    return corner_shifts(MANY, size)


def further(path):
    """An input function: a file for each of these objects."""
    return lambda wildcards: expand(path, object=further_objects())

# More tasks than the paper's two: does telling the task in one way or another still work? No other result
# needs it, so it has a target of its own: `snakemake many_tasks`. Only the catalogue's objects, whose parts have roles.
import functools

from grasptypes.objects.affordances import afforded

MANY = list(PARAMS.many_tasks.tasks)
FURTHER = "|".join(task for task in MANY if task not in TASKS) or "none"


@functools.cache
def many_pairs():
    """Objects and the tasks that they afford, except where people have none of it in mind."""
    return afforded(config["objects"]["names"], MANY)


def many_grasps(wildcards):
    """The grasps of all pairs; those of the workflow's own tasks are those of the dataset."""
    files = {True: "data/grasps", False: "data/many_tasks/grasps"}
    return [f"{files[task in TASKS]}/{name}/{task}.parquet" for name, task in many_pairs()]


use rule map_contacts as map_further_contacts with:
    output:
        contact_map="data/many_tasks/contact_maps/{object}/{task}.npz",
    wildcard_constraints:
        task=FURTHER,


use rule synthesize_grasps as synthesize_further_grasps with:
    input:
        distance_grid=rules.prepare_object.output.distance_grid,
        collision=rules.prepare_object.output.collision,
        properties=rules.prepare_object.output.properties,
        surface=rules.prepare_object.output.surface,
        contact_map=rules.map_further_contacts.output.contact_map,
    output:
        grasps="data/many_tasks/grasps/{object}/{task}.parquet",
        attempts="data/many_tasks/attempts/{object}/{task}.parquet",
    wildcard_constraints:
        task=FURTHER,


use rule label_grasps as label_many_grasps with:
    input:
        grasps=many_grasps,
        grids=expand(
            rules.prepare_object.output.distance_grid, object=config["objects"]["names"]
        ),
    output:
        grasps="data/many_tasks/grasps.csv",
        samples="data/many_tasks/samples.csv",
    params:
        least=config["many_tasks"]["least_grasps"],

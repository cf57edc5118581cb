# Shared by all rules: the checked parameters, the names to loop over, and content hashes.
import re

from grasptypes.settings.holds import HOLDS
from grasptypes.hands.folders import hand_files, hand_folder
from grasptypes.labels.label_sources import (
    FETCHED,
    label_sources,
    published_address,
    published_path,
)
from grasptypes.objects.mesh_companions import companions
from grasptypes.objects.own_objects import measured_map
from grasptypes.objects.reference_meshes import reference_meshes
from grasptypes.objects.variants import all_objects, all_variants, base_of
from grasptypes.predictors.photograph_folder import photograph_files
from grasptypes.predictors.weights import DOWNLOAD_SHA256_START, WEIGHTS_VARIABLE, chosen_weights
from grasptypes.segmentation import NETWORK
from grasptypes.settings.roles import ROLES
from grasptypes.settings.tasks import TASKS as TASKS_FILE
from grasptypes.start_up import check_start
from grasptypes.viewer import PAGE_FILES
from grasptypes.content_hash import CodeHash, FileHash

PUBLISHED_COUNTS = "assets/published_labels.csv"
CATALOGUE = f"{ROOT}/src/grasptypes/objects/catalogue.yaml"
# How people hold parts by role, size and task.
KNOWLEDGE = [str(path) for path in (ROLES, TASKS_FILE, HOLDS)]

try:
    PARAMS = Params.check(config)
    check_start(PARAMS, ROOT, os.environ)
    PUBLISHED_CSV = published_path(os.environ) or []
    REFERENCE_MESHES = [str(path) for path in reference_meshes(os.environ)]
    OBJECTS, VARIANTS = all_objects(PARAMS.objects), all_variants(PARAMS.objects)
    PHOTOGRAPHS = [str(path) for path in photograph_files(os.environ, OBJECTS)]
    TASKS = list(config["tasks"])
    FITTED_ON = [name for name in config["grasp_types"]["fitted_on"] if name in OBJECTS]
    KNOWN = label_sources(config["labels"], PUBLISHED_COUNTS, OBJECTS, TASKS)
    for name in (config["hand"], config["published"]["hand"]):
        hand_folder(name)
except InputError as error:
    sys.exit(f"error: {error}")

file_hash = FileHash(FILE_HASHES)
code_hash = CodeHash(".snakemake/code_hashes.json")


def job_name(rule):
    """A rule's name, and the wildcards of its jobs in the order in which its outputs have them."""
    wildcards = re.findall(r"{(\w+)", rule.output[0])
    names = "_".join(f"{{{word}}}" for word in wildcards)
    return f"{rule.name}/{names}" if names else rule.name


def settings(section, *left_out):
    """A section of the parameters, without the keys that matter to other jobs only."""
    return {key: value for key, value in config[section].items() if key not in left_out}


def script_hash(name):
    """Hash of a script and all it imports from this project: a rule's `code` parameter."""
    return code_hash(Path(ROOT) / "workflow" / "scripts" / f"{name}.py")


def hashes(paths):
    """Hashes of files that no job makes: Snakemake would see changes of newer ones only."""
    paths = [paths] if isinstance(paths, str) else paths
    return {Path(path).name: file_hash(path) for path in paths}


def hand_parameter(name):
    """A hand by name, and the hashes of all files that describe it."""
    folder = hand_folder(name)
    files = {str(path.relative_to(folder)): file_hash(path) for path in hand_files(name)}
    return {"name": name, "files": files}


def labelled_hand(labels):
    """The name of the hand whose grasps a label source counts."""
    return Path(config["hand"] if labels == "simulated" else config["published"]["hand"]).name


def object_settings(wildcards):
    """What a catalogue object or an own one is prepared with; its contact maps are not."""
    objects = config["objects"]
    own = dict(objects["own"].get(wildcards.object, {}))
    own.pop("contact_maps", None)
    if own:
        return {"resolution": objects["resolution"], "own": own, "import": objects["import"]}
    how = {key: objects[key] for key in ("resolution", "scale")}
    return how | {"catalogue": file_hash(CATALOGUE)}


def variant_settings():
    """What a variant is made with."""
    kept = ("scale", "variation", "resolution")
    how = {key: config["objects"][key] for key in kept}
    return how | {"catalogue": file_hash(CATALOGUE)}


def variant_views():
    """How many pictures the trials need of each variant of an object, the first variant's first."""
    trials = config["generalisation"]["trials"]
    most = max(trial["shapes"] for trial in trials)
    return [
        max(trial["views"] for trial in trials if trial["shapes"] > number)
        for number in range(1, most)
    ]


def varied_objects(labels):
    """The catalogue objects with labels in a label source."""
    return [name for name in KNOWN[labels].objects if name in config["objects"]["names"]]


def view_count(wildcards):
    """How many images are taken of an object; variants and shapes of kinds have fewer of them."""
    variant = wildcards.object in VARIANTS
    if wildcards.object not in OBJECTS:
        return PARAMS.kinds.views
    return PARAMS.objects.variant_views if variant else PARAMS.renders.views


def own_files(wildcards):
    """The mesh of an own object and its materials; a catalogue object has none."""
    if wildcards.object not in PARAMS.objects.own:
        return []
    mesh = PARAMS.objects.own[wildcards.object].file
    return [mesh, *companions(mesh)]


def measured_input(wildcards):
    """The contact map measured for an own object and task; most have none."""
    return measured_map(PARAMS.objects, wildcards.object, wildcards.task) or []


def map_unit(name):
    """The unit of the contact maps measured on an own object."""
    return PARAMS.objects.own[name].unit if name in PARAMS.objects.own else "m"


def measuring_hashes():
    """Hashes of the published poses and of the scans, for those who have them."""
    published = [] if PUBLISHED_CSV == FETCHED else PUBLISHED_CSV
    return hashes(published) | hashes(REFERENCE_MESHES)


def without_scan():
    """Catalogue objects that the folder of reference meshes lacks; none if there is no folder."""
    scans = {Path(path).stem for path in REFERENCE_MESHES}
    return [name for name in config["objects"]["names"] if name not in scans] if scans else []


def learning_inputs(wildcards):
    """What a model learns from: features, or pictures if its backbone is trained too."""
    frozen = config["predictors"]["finetune"] == "none"
    made_by = (
        rules.extract_features.output.features if frozen else rules.render_object.output.pictures
    )
    return expand(made_by, object=KNOWN[wildcards.labels].objects)


def learning_tasks(wildcards):
    """The tasks that the label source knows, each with its colour shift."""
    return {task: PARAMS.colour_shifts[task] for task in KNOWN[wildcards.labels].tasks}


def weights_choice(record="data/backbone.json"):
    """The user's choice of weights; without one, that of the results at hand.

    So results that were pulled are not computed again for want of the weights they were made with.
    """
    if WEIGHTS_VARIABLE in os.environ or not Path(record).is_file():
        return chosen_weights()
    try:
        found = json.loads(Path(record).read_text())
        backbone, sha256 = found["backbone"], found["sha256"]
    except (ValueError, KeyError, TypeError):  # damaged: it is recomputed
        return chosen_weights()
    by_default = sha256.startswith(DOWNLOAD_SHA256_START) or backbone != "mobilenet_v2"
    return "default" if by_default else sha256[:16]

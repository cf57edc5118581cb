# What all rules share: the checked parameters, the names to loop over, and content hashes.
from grasptypes.affinities import read_affinities
from grasptypes.errors import InputError
from grasptypes.guard import check_cache_links
from grasptypes.own_objects import check_every_hold, check_own_objects, measured_map
from grasptypes.params import read_yaml, validate_params
from grasptypes.provenance import FileHash, code_hash

SCHEMA = read_yaml(Path(workflow.basedir) / "workflow" / "schemas" / "params.schema.yaml")

try:
    check_cache_links(workflow.basedir)
    read_yaml("params.yaml")  # Snakemake itself would let a duplicate key pass
    validate_params(config, SCHEMA)
    OBJECTS = [*config["objects"]["names"], *config["objects"]["own"]]
    TASKS = list(config["tasks"])
    CATALOGUE = SCHEMA["properties"]["objects"]["properties"]["names"]["items"]["enum"]
    check_own_objects(config["objects"], TASKS)
    AFFINITIES = config["contact_maps"]["affinities"]
    HOLDS = read_affinities(AFFINITIES, {*CATALOGUE, *OBJECTS}, TASKS)
    check_every_hold(config["objects"], TASKS, HOLDS, AFFINITIES)
except InputError as error:
    sys.exit(f"error: {error}")

file_hash = FileHash(".snakemake/file_hashes.json")


def settings(section, *left_out):
    """A section of the parameters, without the keys that matter to other jobs only."""
    return {key: value for key, value in config[section].items() if key not in left_out}


def script_hash(name):
    """Hash of a script and all it imports from this project: a rule's `code` parameter."""
    return code_hash(Path(workflow.basedir) / "workflow" / "scripts" / f"{name}.py")


def folder_hash(folder):
    """Hashes of all files below a folder, which Snakemake cannot compare by content itself."""
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): file_hash(path) for path in files}

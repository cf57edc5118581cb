# What all rules share: the checked parameters, the names to loop over, and content hashes.
from grasptypes.errors import InputError
from grasptypes.guard import check_cache_links
from grasptypes.params import read_yaml, validate_params
from grasptypes.provenance import FileHash, code_hash

try:
    check_cache_links(workflow.basedir)
    read_yaml("params.yaml")  # Snakemake itself would let a duplicate key pass
    validate_params(config, read_yaml(workflow.source_path("../schemas/params.schema.yaml")))
except InputError as error:
    sys.exit(f"error: {error}")

OBJECTS = [*config["objects"]["names"], *config["objects"]["own"]]
TASKS = list(config["tasks"])

file_hash = FileHash(".snakemake/file_hashes.json")


def settings(section, *left_out):
    """A section of the parameters, without the keys that matter to other jobs only."""
    return {key: value for key, value in config[section].items() if key not in left_out}


def script_hash(name):
    """Hash of a script and all it imports from this project: a rule's `code` parameter."""
    return code_hash(Path(workflow.basedir) / "workflow" / "scripts" / f"{name}.py")

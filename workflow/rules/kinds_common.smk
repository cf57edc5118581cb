# Shared by the rules of kinds: which shapes there are, and hashes of what they are made of.
import functools
import hashlib

from grasptypes.kinds.names import DATA as KINDS
from grasptypes.kinds.names import (
    MATERIALS,
    SHAPE_PATTERN,
    kind_names,
    kind_texts,
    shape_names,
    shape_of,
)


def kinds_of(group=None):
    """The kinds of the parameters, or those of a group."""
    chosen = PARAMS.kinds.names
    return [
        kind
        for kind, file in kind_names().items()
        if group in (None, file) and (not chosen or kind in chosen)
    ]


def real_objects(environment):
    """The folders of real objects; those that are missing make the rule fail with their variable."""
    names = {"ycb": "GRASPTYPES_YCB", "furniture": "GRASPTYPES_FURNITURE"}
    return {name: environment.get(variable, variable) for name, variable in names.items()}


def every_shape(*paths):
    """An input function: the files of all shapes and tasks; nothing is read before it is needed."""

    def files(wildcards):
        names = [name for kind in kinds_of() for name in shape_names(kind, PARAMS.kinds.shapes)]
        return expand(paths, object=names, task=TASKS)

    return files


written_kinds = functools.cache(kind_texts)


def kind_hash(*kinds):
    """Hashes of what kinds are made of."""
    texts = written_kinds()
    blocks = {kind: hashlib.sha256(texts[kind].encode()).hexdigest() for kind in kinds}
    return blocks | hashes(str(KINDS / MATERIALS))


def kind_sheets(wildcards):
    """The contact sheets of all groups with chosen kinds."""
    groups = {kind_names()[kind]: None for kind in kinds_of()}
    return expand(rules.plot_kinds.output.sheet, group=groups)


def kind_samples(wildcards):
    """The samples of all groups with chosen kinds."""
    groups = {kind_names()[kind]: None for kind in kinds_of()}
    return expand(rules.sample_kinds.output.samples, group=groups)


def random_pictures(*names):
    """Archives of randomised images."""
    return expand("data/general/pictures/{object}.zip", object=names)


def shapes():
    """All shapes of the kinds of the parameters."""
    return [name for kind in kinds_of() for name in shape_names(kind, PARAMS.kinds.shapes)]


def scanned():
    """The scans of objects, if the user has any: name to file."""
    return {Path(path).stem: path for path in REFERENCE_MESHES if Path(path).stem in OBJECTS}


def pictures_of(wildcards):
    """The archives of images of a group."""
    return {
        "kinds": lambda: random_pictures(*shapes()),
        "objects": lambda: random_pictures(*OBJECTS),
        "renders": lambda: expand(rules.render_object.output.pictures, object=OBJECTS),
        "scans": lambda: expand(rules.picture_scan.output.pictures, object=scanned()),
    }[wildcards.shown]()


def surfaces_of(wildcards):
    """The surfaces of a group of prepared objects."""
    names = {"kinds": shapes(), "objects": OBJECTS, "scans": []}[wildcards.shown]
    kind_or_object = rules.prepare_kind.output.surface, rules.prepare_object.output.surface
    return expand(kind_or_object[wildcards.shown == "objects"], object=names)


# Scans to plan for, with their scale and mass: of ContactDB, whose true roles our models tell, and of YCB objects with a
# table of true roles. A mass of None is that of a solid of water.
YCB, YCB_ROLES = "ycb_", "assets/ycb_roles.csv"


def planned_scans():
    """File, scale and mass of each scan that the user has, by name."""
    scans = {Path(path).stem: (path, config["objects"]["scale"], None) for path in REFERENCE_MESHES}
    folder = Path(real_objects(os.environ)["ycb"])
    if folder.is_dir():
        masses = folder / "scripts/ycb_mass.json"
        if not masses.is_file():
            sys.exit(f"error: GRASPTYPES_YCB: names '{folder}', which has no {masses}")
        masses_kg = json.loads(masses.read_text(encoding="utf-8"))
        lines = Path(YCB_ROLES).read_text(encoding="utf-8").splitlines()
        for name in {line.split(",")[0]: None for line in lines if line.startswith(YCB)}:
            known = name.removeprefix(YCB)
            scans[name] = str(folder / "ycb" / known / "textured.obj"), 1.0, masses_kg[known]
    return scans

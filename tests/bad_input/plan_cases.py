"""Mistakes in what is asked of `grasptypes plan`."""

from __future__ import annotations

import trimesh
import yaml
from case import PARAMS, Case, Content
from command_cases import FOLDER
from map_cases import ply, spread
from mesh_cases import STL, TEXT_PLY
from picture_cases import command

from grasptypes.yaml_files import merge

# A cube that no hand spans, and parameters that make little work of it.
HALL = trimesh.creation.box((0.9, 0.9, 0.9)).export(file_type="stl")
RESOLUTION = {"grid_spacing_m": 0.01, "surface_edge_m": 0.02}
LARGE = {"objects": {"resolution": RESOLUTION, "import": {"max_box_m3": 1.0}}}
COARSE = yaml.safe_dump(merge(PARAMS, LARGE))


def planned(what: str, changes: dict[str, str], *names: str, **more: Content) -> Case:
    """A call with a good mesh, and other files by their names without the dot."""
    files = FOLDER | {"cup.stl": STL, "note.txt": "no mesh", "full/old.csv": ""}
    files |= {name.replace("_", "."): content for name, content in more.items()}
    asked = {"--object": "cup.stl", "--task": "use", "--type": "Precision", "--output": "out"}
    words = [word for pair in (asked | changes).items() for word in pair]
    return Case("plan", what, files, command("plan", *words), names)


CASES = [
    planned("an unknown task", {"--task": "fly"}, "--task: fly", "use, handoff"),
    planned("an unknown type", {"--type": "Hug"}, "--type: Hug", "Large Wrap, Medium Wrap"),
    planned("Invalid for a type", {"--type": "Invalid"}, "--type: Invalid", "Precision"),
    planned("no session", {"--sessions": "0"}, "--sessions", "positive integer"),
    planned("a mass of zero", {"--mass-kg": "0"}, "--mass-kg: 0: ", "0.001 to 6 kg"),
    planned("a mass in grams", {"--mass-kg": "350"}, "--mass-kg: 350: ", "0.001 to 6 kg"),
    planned("a mass of NaN", {"--mass-kg": "nan"}, "--mass-kg: nan: ", "0.001 to 6 kg"),
    planned("a mass without a number", {"--mass-kg": "abc"}, "--mass-kg", "abc is not a number"),
    planned("a missing mesh", {"--object": "no.stl"}, "no.stl: no such file"),
    planned("not a mesh", {"--object": "note.txt"}, "note.txt", ".stl, .obj"),
    planned("a wrong unit", {"--unit": "mm"}, "cup.stl: unit", "unit: m"),
    planned("a solid that is too heavy", {"--object": "hall.stl"},
            "hall.stl: --mass-kg: is 729 kg", "0.001 to 6 kg",
            hall_stl=HALL, params_yaml=COARSE),
    planned("an object that no hand can hold",
            {"--object": "hall.stl", "--sessions": "1", "--mass-kg": "6", "--roles": "roles.csv"},
            "hall.stl: no hand can hold it anywhere with the grips pinch", "--type", "0.9 m long",
            hall_stl=HALL, params_yaml=COARSE, roles_csv="part,role\nbody,screen\n"),
    planned("a missing map", {"--contact-map": "no.ply"}, "no.ply: no such file"),
    planned("roles beside a map", {"--contact-map": "warm.ply", "--roles": "roles.csv"},
            "--roles: roles.csv: has no effect beside --contact-map",
            warm_ply=ply(spread(20, 200)), roles_csv="part,role\nbody,ball\n"),
    planned("a map that is not a PLY", {"--contact-map": "note.txt"}, "note.txt: is not a contact"),
    planned("a map without colours", {"--contact-map": "grey.ply"}, "grey.ply: has no vertex",
            grey_ply=TEXT_PLY),
    planned("a map of another place", {"--contact-map": "far.ply"}, "far.ply: covers 0%",
            far_ply=ply(spread(20, 200), scale=9.0)),
    planned("the current folder", {"--output": "."}, ".: is the current folder"),
    planned("a folder that is not empty", {"--output": "full"}, "full: already exists"),
    planned("a name that is too long", {"--output": "x" * 250}, "the name is too long"),
    planned("a file instead of a folder", {"--output": "note.txt/out"}, "created: note.txt is"),
]  # fmt: skip

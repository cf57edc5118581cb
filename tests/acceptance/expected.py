"""What each parameter concerns: the rules that read it, and why some concern no result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

LEARNING = ("train_predictor", "leave_out_objects")
GALLERIES = ("plot_grasps", "plot_rejected_grasps")
PICTURES = ("picture_grasps", "plot_contact_maps", *GALLERIES)

# The longest key that a parameter's own begins with counts.
READERS: dict[str, tuple[str, ...]] = {
    "seed": ("map_contacts", "synthesize_grasps", "render_object", "split_folds", *LEARNING),
    "tasks": ("extract_features", *LEARNING),
    "objects.scale": ("prepare_object",),
    "objects.resolution": ("prepare_object",),
    "objects.comparison": ("compare_shapes",),
    "contact_maps": ("map_contacts",),
    "replay": ("replay_grasps",),
    "replay.object_scale": ("replay_grasps", "evaluate_labels"),
    "contact_pictures": ("plot_contact_maps",),
    "synthesis": ("synthesize_grasps",),
    "physics": ("synthesize_grasps",),
    "gallery": GALLERIES,
    "gallery.screenshot_px": ("picture_grasps",),
    "gallery.elevation_rad": ("picture_grasps", *GALLERIES),
    "gallery.columns": ("plot_grasps",),
    "gallery.rejected": ("plot_rejected_grasps",),
    "gallery.sessions": ("plot_sessions",),
    "grasp_types": ("evaluate_labels",),
    "grasp_types.contacts": ("label_grasps", "evaluate_labels"),
    "grasp_types.thresholds": ("label_grasps", "plot_label_tree", "evaluate_labels"),
    "renders": ("render_object", *PICTURES),
    "renders.views": ("render_object",),
    "renders.png_compression": ("render_object", "plot_sessions", *PICTURES),
    "renders.sheet": ("plot_renders",),
    "backbone": ("prepare_backbone",),
    "features": ("extract_features",),
    "folds": ("split_folds",),
    "labels": (
        "tabulate_unseen",
        "tabulate_types",
        "tabulate_objects",
        "plot_folds",
        "plot_losses",
    ),
    "predictors": LEARNING,
}

# Not changed here.
ELSEWHERE: dict[str, str] = {
    "objects.names": "adding and removing objects has a test of its own",
    "objects.own": "params.yaml names no own object",
    "objects.variants": "params.yaml asks for none; they are objects like others",
}

NO_RESULT: dict[str, str] = {
    "objects.import": "is read for own objects only",
    "contact_maps.measured": "is read for own objects with a measured map only",
    "contact_evidence": "concerns a rule that no target asks for: its finding is in the table",
    "published.timeout_s": "concerns a download that only some users need",
    "objects.variation": "concerns variants, and reports/generalisation.csv, a target of its own",
    "objects.variant_views": "concerns variants only",
    "generalisation": "concerns reports/generalisation.csv, a target of its own",
    "plan": "concerns the command line, and reports/planning.csv, a target of its own",
    "predict": "concerns the command line, which makes no result",
    "tracking": "concerns MLflow's view of results",
}

# Values that cannot be found by changing the old one a little.
SPECIAL: dict[str, object] = {
    "contact_maps.affinities": "./assets/affinities.csv",
    "grasp_types.fitted_on": ["apple", "banana"],
    "features.precision": "fp32",
    "labels": ["simulated"],
    "predictors.finetune": "last_blocks",
    "predict.model": "no_task",
    "predict.labels": "published",
    "tracking.database": "other.db",
    "tracking.experiment": "other",
}

# Modules that make no result, by path or folder.
NO_RESULT_CODE: dict[str, str] = {
    "src/grasptypes/__main__.py": "the command line",
    "src/grasptypes/commands": "the command line, which reads results and makes none",
    "src/grasptypes/exchange/dexgraspbench.py": "reads and writes other people's files",
    "src/grasptypes/exchange/graspit_world.py": "reads and writes other people's files",
    "src/grasptypes/exchange/multigrippergrasp.py": "reads and writes other people's files",
    "src/grasptypes/runs": "MLflow's view of results",
    "src/grasptypes/versions": "keeps results and tools in step",
    "src/grasptypes/planning": "plans for the user's own meshes; what rules use of it is hashed",
    "src/grasptypes/params.py": "refuses bad input; what it lets pass is a parameter of rules",
    "src/grasptypes/reports/timing.py": "draws what jobs cost on this machine; no result",
    "src/grasptypes/labels/label_sources.py": "decides which jobs there are; their inputs count",
    "src/grasptypes/predictors/own_tasks.py": "refuses bad input, like start_up",
    "src/grasptypes/start_up.py": "refuses bad input; what it lets pass is a parameter of rules",
    "src/grasptypes/hand/__main__.py": "writes assets/barrett_hand, whose files are hashed",
    "src/grasptypes/hand/urdf.py": "writes assets/barrett_hand, whose files are hashed",
    "src/grasptypes/predictors/prediction_pictures.py": "pictures of predictions for users",
    "src/grasptypes/renders/photos.py": "pictures of the user's own for the command line",
    "src/grasptypes/renders/mesh_views.py": "views of the user's own meshes for the command line",
    "src/grasptypes/objects/own_objects.py": "decides which files are inputs, which are hashed",
}


# What is measured with data of the user's own, and the tables that who has none keeps from git.
KEEPERS = ("evaluate_labels", "replay_grasps", "compare_shapes")
KEPT = (
    "reports/label_agreement.csv",
    "reports/label_cross_validation.csv",
    "reports/figures/label_confusion.png",
    "reports/replay.csv",
    "reports/object_shapes.csv",
)

# The DVC stage that a rule's results belong to; all others are reports.
STAGES: dict[str, str] = {
    **dict.fromkeys(("prepare_object", "map_contacts"), "objects"),
    **dict.fromkeys(("synthesize_grasps", "label_grasps", "label_published"), "grasps"),
    "picture_grasps": "grasps",
    **dict.fromkeys(("render_object", "extract_features", "prepare_backbone"), "renders"),
    **dict.fromkeys(("split_folds", *LEARNING), "predictors"),
}

# Scripts that several rules run; all others have one rule of their name.
SHARED_SCRIPTS: dict[str, tuple[str, ...]] = {
    "tabulate_results": ("tabulate_simulated", "tabulate_published", "tabulate_unseen"),
}


def longest(name: str, table: Mapping[str, Any]) -> str | None:
    """The longest entry that a parameter's dotted key or a file's path begins with."""
    entries = (
        entry for entry in table if name == entry or name.startswith((f"{entry}.", f"{entry}/"))
    )
    return max(entries, key=len, default=None)

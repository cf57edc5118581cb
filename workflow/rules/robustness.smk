# Tests of the recorded grasps, read back from their file: both engines, all directions, perturbations.


rule test_grasps:
    input:
        grasps=rules.label_grasps.output.grasps,
        surface=rules.prepare_object.output.surface,
        distance_grid=rules.prepare_object.output.distance_grid,
        collision=rules.prepare_object.output.collision,
        properties=rules.prepare_object.output.properties,
    output:
        tests="data/robustness/{object}.csv",
    params:
        hand=hand_parameter(config["hand"]),
        physics=config["physics"]["test"],
        robustness=config["robustness"],
        tasks=hashes([TASKS_FILE]),
        synthesis=settings("synthesis"),
        seed=config["seed"],
        code=script_hash("test_grasps"),
    message:
        "Testing the recorded grasps of {wildcards.object}"
    script:
        "../scripts/test_grasps.py"


rule tabulate_robustness:
    input:
        tests=expand(rules.test_grasps.output.tests, object=OBJECTS),
    output:
        table=report(
            "reports/robustness.csv",
            caption="../report/robustness.rst",
            category="Robustness",
            labels={"subject": "robustness", "kind": "table"},
        ),
        confusion=report(
            "reports/engine_confusion.csv",
            caption="../report/robustness.rst",
            category="Robustness",
            labels={"subject": "two engines", "kind": "table"},
        ),
        correlations="reports/grasp_quality.csv",
        grasps="data/robustness.csv",
        figure=report(
            "reports/figures/robustness.png",
            caption="../report/robustness.rst",
            category="Robustness",
            labels={"subject": "robustness", "kind": "figure"},
        ),
    params:
        code=script_hash("tabulate_robustness"),
    message:
        "Tabulating how robust the grasps are"
    script:
        "../scripts/tabulate_robustness.py"


rule film_grasps:
    input:
        grasps=rules.label_grasps.output.grasps,
        tests=rules.tabulate_robustness.output.grasps,
        visuals=expand(rules.prepare_object.output.visual, object=OBJECTS),
    output:
        held=report(
            "reports/figures/grasp_held.gif",
            caption="../report/robustness_films.rst",
            category="Robustness",
            labels={"subject": "a grasp that holds", "kind": "animation"},
        ),
        lost=report(
            "reports/figures/grasp_lost.gif",
            caption="../report/robustness_films.rst",
            category="Robustness",
            labels={"subject": "a grasp that is lost", "kind": "animation"},
        ),
        worst=report(
            "reports/figures/worst_grasps.png",
            caption="../report/worst_grasps.rst",
            category="Robustness",
            labels={"subject": "worst grasps", "kind": "figure"},
        ),
    params:
        hand=hand_parameter(config["hand"]),
        physics=config["physics"]["test"],
        film=config["robustness"]["film"],
        gallery=config["gallery"],
        renders=settings("renders", "views", "sheet"),
        code=script_hash("film_grasps"),
    message:
        "Showing a grasp that holds, one that is lost, and the worst ones"
    script:
        "../scripts/film_grasps.py"

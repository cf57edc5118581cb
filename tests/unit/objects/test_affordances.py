"""Objects afford a task if they have what it needs and something that people touch for it."""

from grasptypes.objects.affordances import afforded, affords
from grasptypes.settings.tasks import read_tasks


def test_a_task_needs_one_role_and_a_place_to_hold():
    tasks = read_tasks()
    assert affords(["blade", "handle"], tasks["cut"])
    assert not affords(["blade"], tasks["cut"])
    assert not affords(["handle"], tasks["cut"])
    assert affords(["ball"], tasks["use"])


def test_every_object_is_put_away_and_few_are_poured_from():
    objects = ["apple", "knife", "mug"]
    assert afforded(objects, ["stow", "pour", "cut"]) == [
        ("apple", "stow"),
        ("knife", "stow"),
        ("knife", "cut"),
        ("mug", "stow"),
        ("mug", "pour"),
    ]

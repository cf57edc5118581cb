"""Benchmarks where there are results, and where there are none."""

from repository import Repository


def benchmark(repository: Repository, *parts: str) -> str:
    source = str(repository.path / "src")
    return repository.run("python", "-m", "benchmarks", *parts, PYTHONPATH=source)


def test_parts_without_results_say_what_makes_them(fresh: Repository) -> None:
    output = benchmark(fresh, "records", "idle", "synthesis", "renders", "features", "training")
    assert output.count("left out") == 6
    assert "data/renders is missing; snakemake renders makes it" in output
    assert not (fresh.path / "reports").exists()


def test_records_tell_the_time_of_every_rule_and_the_whole(complete: Repository) -> None:
    output = benchmark(complete, "records")
    for name in ("wall time of train_predictor", "wall time of the main job", "peak memory of"):
        assert name in output
    assert "left out" not in output

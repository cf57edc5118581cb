"""What jobs cost, read from Snakemake's benchmarks."""

from pathlib import Path

from grasptypes.reports.timing import TIMING_SCHEMA, draw_timing, read_timing

HEAD = "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"


def write(path: Path, wall_s: str, memory_mb: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{HEAD}{wall_s}\t0:00:01\t{memory_mb}\t-\t-\t-\t0\t0\t90\t-\n")


def test_jobs_are_summed_by_rule_and_the_dearest_comes_first(tmp_path: Path) -> None:
    write(tmp_path / "split.tsv", "2.5", "-")
    write(tmp_path / "grasp/mug_use.tsv", "70", "300.5")
    write(tmp_path / "grasp/pan_use.tsv", "10", "410.0")
    table = TIMING_SCHEMA.validate(read_timing(tmp_path))
    assert table["rule"].tolist() == ["grasp", "split"]
    assert table.iloc[0].tolist() == ["grasp", 2, 80.0, 70.0, 410.0]
    labels = [text.get_text() for text in draw_timing(table).axes[0].texts]
    assert labels == ["1 min 20 s", "2.5 s"]


def test_without_benchmarks_there_is_nothing_to_show(tmp_path: Path) -> None:
    assert read_timing(tmp_path / "none").empty

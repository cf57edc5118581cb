"""Figures from the records of finished jobs."""

import base64
import json

import pytest
from benchmarks.records import Record, ancestors, busy_s, peaks_mb, read_records


def record(rule="a", inputs=(), begun_s=0.0, ended_s=1.0):
    return Record(rule, 1, list(inputs), begun_s, ended_s)


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ([], 0),
        ([(0, 4)], 4),
        ([(0, 4), (1, 2)], 4),  # beside each other, one within the other
        ([(3, 6), (0, 4)], 6),
        ([(0, 1), (100, 102)], 3),  # what lies between two runs is not counted
    ],
)
def test_time_counts_once_however_many_jobs_ran(times, expected):
    assert busy_s([record(begun_s=b, ended_s=e) for b, e in times]) == expected


def test_ancestors_are_what_a_file_was_made_from():
    records = {
        "table": record("tabulate", ["metrics", "samples"]),
        "metrics": record("train", ["samples"]),
        "samples": record("label", ["params.yaml"]),
        "other": record("plot", ["samples"]),
    }
    assert sorted(one.rule for one in ancestors(records, "table")) == ["label", "tabulate", "train"]


def test_records_are_read_by_the_file_they_are_about(tmp_path):
    name = base64.b64encode(b"data/a.csv").decode()
    content = {"rule": "a", "job_hash": 1, "input": ["b"], "starttime": 1.0, "endtime": 2.5}
    (tmp_path / name).write_text(json.dumps(content))
    assert read_records(tmp_path) == {"data/a.csv": record("a", ["b"], 1.0, 2.5)}


def test_the_peak_of_a_rule_is_that_of_its_largest_job(tmp_path):
    for path, memory in (("map/a.tsv", "12.5"), ("map/b.tsv", "NA"), ("plot.tsv", "NA")):
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_text(f"s\tmax_rss\n0.5\t{memory}\n")
    assert peaks_mb(tmp_path) == {"map": 12.5}

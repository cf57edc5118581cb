"""Where labels come from: our simulation, or the authors' table by path or by URL and checksum."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from grasptypes.downloads import DownloadError, download
from grasptypes.errors import InputError

SOURCES = ("simulated", "published")
PUBLISHED = "GRASPTYPES_PUBLISHED_CSV"
# Target of the rule `fetch_published` for a table given by URL.
FETCHED = "data/published/GraspTypesWithTasks.csv"


@dataclass(frozen=True)
class Known:
    """Objects and tasks that have labels, in the order of the parameters."""

    objects: list[str]
    tasks: list[str]


def label_sources(
    used: Collection[str],
    counts: str | Path,
    objects: Collection[str],
    tasks: Collection[str],
    path: str | Path = "params.yaml",
) -> dict[str, Known]:
    """The labelled objects and tasks of each label source.

    Simulated labels cover every object and task. Published labels cover those of the authors: own
    objects, variants and further tasks are not included.

    Args:
        used: label sources to make tables for.
        counts: CSV of the published counts, one row per object and task.
        objects, tasks: of the parameters.
        path: of the parameters.

    Raises:
        InputError: published labels are used, but none of the objects and tasks have them.
    """
    with open(counts, encoding="utf-8", newline="") as file:
        rows = {(row["object"], row["task"]) for row in csv.DictReader(file)}
    known_tasks = [task for task in tasks if any((name, task) in rows for name in objects)]
    known = [name for name in objects if any((name, task) in rows for task in tasks)]
    if "published" in used and not known:
        message = "'published' has none of these objects and tasks; leave it out"
        raise InputError(path, "labels", message)
    return dict(zip(SOURCES, (Known([*objects], [*tasks]), Known(known, known_tasks)), strict=True))


class Address(NamedTuple):
    """A URL and the checksum of its content."""

    url: str
    sha256: str


def published_address(environment: Mapping[str, str]) -> Address | None:
    """The URL named by the environment as ``<URL>#sha256=<64 hex digits>``; None for a path.

    Raises:
        InputError: a URL without checksum.
    """
    named = environment.get(PUBLISHED, "")
    if not re.match(r"https?://", named):
        return None
    url, _, fragment = named.partition("#")
    digits = re.fullmatch(r"sha256=([0-9a-fA-F]{64})", fragment)
    if digits is None:
        message = f"'{named}' must end in #sha256=<64 hex digits>, the file's checksum"
        raise InputError(PUBLISHED, "", message)
    return Address(url, digits[1].lower())


def published_path(environment: Mapping[str, str]) -> str:
    """Path of the table, which may still have to be downloaded; empty if none is named.

    Raises:
        InputError: a URL without checksum.
    """
    return FETCHED if published_address(environment) else environment.get(PUBLISHED, "")


def check_published(environment: Mapping[str, str]) -> None:
    """Reject an unusable name before anything runs; without network access.

    Raises:
        InputError: a URL without checksum, or a missing file.
    """
    named = environment.get(PUBLISHED, "")
    if named and published_address(environment) is None and not Path(named).is_file():
        raise InputError(PUBLISHED, "", f"names '{named}', which is not a file")


def fetch_published(environment: Mapping[str, str], path: str | Path, timeout_s: float) -> Address:
    """Download the table named by URL in the environment; returns its source.

    Raises:
        InputError: there is no URL, it cannot be reached, or its content has another checksum.
    """
    address = published_address(environment)
    if address is None:
        raise InputError(PUBLISHED, "", "is not a URL to download the published table from")
    try:
        download(address.url, path, address.sha256, timeout_s)
    except DownloadError as error:
        message = f"{error}; download the file by other means and set its path instead"
        raise InputError(PUBLISHED, "", message) from error
    return address

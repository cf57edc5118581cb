"""Where the authors' table comes from: a file on this machine, or a URL with its checksum."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from grasptypes.downloads import DownloadError, download
from grasptypes.errors import InputError

PUBLISHED = "GRASPTYPES_PUBLISHED_CSV"
# Where the rule `fetch_published` keeps what a URL gave.
FETCHED = "data/published/GraspTypesWithTasks.csv"


class Address(NamedTuple):
    """A URL and what must be found there."""

    url: str
    sha256: str


def published_address(environment: Mapping[str, str]) -> Address | None:
    """The URL that the environment names, as ``<URL>#sha256=<64 hex digits>``; None for a path.

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
    """Path of the table, be it there or still to be fetched; empty if none is named.

    Raises:
        InputError: a URL without checksum.
    """
    return FETCHED if published_address(environment) else environment.get(PUBLISHED, "")


def check_published(environment: Mapping[str, str]) -> None:
    """Refuse a name that leads nowhere, before anything runs; no host is asked.

    Raises:
        InputError: a URL without checksum, or a path to nothing.
    """
    named = environment.get(PUBLISHED, "")
    if named and published_address(environment) is None and not Path(named).is_file():
        raise InputError(PUBLISHED, "", f"names '{named}', which is not a file")


def fetch_published(environment: Mapping[str, str], path: str | Path, timeout_s: float) -> Address:
    """Fetch the table that the environment names by URL; returns where it came from.

    Raises:
        InputError: no URL is named, it cannot be reached, or what lies there is another file.
    """
    address = published_address(environment)
    if address is None:
        raise InputError(PUBLISHED, "", "names no URL to fetch the published table from")
    try:
        download(address.url, path, address.sha256, timeout_s)
    except DownloadError as error:
        message = f"{error}; get the file another way and name its path instead"
        raise InputError(PUBLISHED, "", message) from error
    return address

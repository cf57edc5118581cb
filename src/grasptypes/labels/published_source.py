"""Source of the authors' table: a local file, or a URL with a checksum."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from grasptypes.downloads import DownloadError, download
from grasptypes.errors import InputError

PUBLISHED = "GRASPTYPES_PUBLISHED_CSV"
# Target of the rule `fetch_published` for a table given by URL.
FETCHED = "data/published/GraspTypesWithTasks.csv"


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

"""Downloads with a timeout and a checksum: a file appears complete and correct, or not at all."""

from __future__ import annotations

import http.client
import os
import queue
import shutil
import tempfile
import threading
import urllib.request
from pathlib import Path
from typing import IO

from grasptypes.files import TEMPORARY, file_sha256

_FAILURES = (OSError, http.client.HTTPException, ValueError)


class DownloadError(Exception):
    """The download failed; the message says why in one line."""


def download(url: str, path: str | Path, sha256: str, timeout_s: float) -> None:
    """Download ``url`` to ``path``, which appears only when it is complete.

    Args:
        sha256: expected SHA-256 in hex digits, or a prefix of it.
        timeout_s: longest time without a response.

    Raises:
        DownloadError: the host does not answer in time, the transfer is interrupted, or the
            checksum is wrong.
    """
    path = Path(path)
    with _opened(url, timeout_s) as response:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, part = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=TEMPORARY)
        try:
            with open(handle, "wb") as file:
                _copy(url, response, file)
            found = file_sha256(part)
            if not found.startswith(sha256.lower()):
                raise DownloadError(f"{url} has the SHA-256 {found} instead of {sha256}")
            os.chmod(part, 0o644)
            os.replace(part, path)
        finally:
            Path(part).unlink(missing_ok=True)


def _opened(url: str, timeout_s: float) -> IO[bytes]:
    """Open ``url``.

    Name resolution has no timeout of its own, so the request runs in a thread that is abandoned
    when it takes too long.
    """
    if not url.startswith(("http://", "https://")):
        raise DownloadError(f"{url} is not an http or https URL")
    answers: queue.SimpleQueue[IO[bytes] | Exception] = queue.SimpleQueue()
    threading.Thread(target=_ask, args=(url, timeout_s, answers), daemon=True).start()
    try:
        answer = answers.get(timeout=timeout_s)
    except queue.Empty:
        raise DownloadError(f"{url} did not answer within {timeout_s:g} s") from None
    if isinstance(answer, Exception):
        raise DownloadError(f"{url} cannot be reached: {' '.join(str(answer).split())}")
    return answer


def _ask(url: str, timeout_s: float, answers: queue.SimpleQueue[IO[bytes] | Exception]) -> None:
    try:
        answers.put(urllib.request.urlopen(url, timeout=timeout_s))
    except _FAILURES as error:
        answers.put(error)


def _copy(url: str, response: IO[bytes], file: IO[bytes]) -> None:
    try:
        shutil.copyfileobj(response, file)
    except _FAILURES as error:
        raise DownloadError(f"{url} was interrupted: {' '.join(str(error).split())}") from error

"""What is fetched is whole and right, and nothing hangs."""

import hashlib
import time

import pytest
from hosts import CONTENT

from grasptypes.downloads import DownloadError, download
from grasptypes.files import file_sha256

SHA256 = hashlib.sha256(CONTENT).hexdigest()


def test_what_has_the_right_checksum_is_kept(host, tmp_path):
    path = tmp_path / "new" / "file"
    download(f"{host}/content", path, SHA256.upper(), timeout_s=2)
    assert path.read_bytes() == CONTENT
    assert file_sha256(path) == SHA256
    assert list(path.parent.iterdir()) == [path]


def test_what_has_another_checksum_leaves_the_old_file_alone(host, tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    with pytest.raises(DownloadError, match=f"has the SHA-256 {SHA256} instead of 0123"):
        download(f"{host}/content", path, "0123", timeout_s=2)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("url", "said"),
    [
        # Whichever of two clocks set to the same time rings first.
        ("{host}/silent", "did not answer within 0.5 s|timed out"),
        ("{host}/gone", "404"),
        ("{host}/broken", "SHA-256"),
        ("http://127.0.0.1:9/file", "cannot be reached"),
        ("http://host.invalid/file", "host.invalid"),
        ("http://a b/file", "cannot be reached"),
        ("file:///etc/hostname", "not an http or https URL"),
    ],
)
def test_what_cannot_be_fetched_is_said_soon_and_leaves_nothing(host, tmp_path, url, said):
    begun = time.monotonic()
    with pytest.raises(DownloadError, match=said) as raised:
        download(url.format(host=host), tmp_path / "file", SHA256 + "0", timeout_s=0.5)
    assert time.monotonic() - begun < 1.5
    assert "\n" not in str(raised.value)
    assert list(tmp_path.iterdir()) == []

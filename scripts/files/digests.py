"""Contents of the project's files and their digests, each read once in a process."""

import hashlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path


@cache
def content_of(path: Path) -> bytes:
    """What is in a file."""
    return path.read_bytes()


@cache
def digest_of(path: Path) -> bytes:
    """The digest of a file."""
    return hashlib.sha256(content_of(path)).digest()


def digest_of_files(paths: Iterable[str | Path]) -> str:
    """A digest of contents: a parameter by which results of older contents are stale.

    Snakemake judges inputs by their times, which an upgrade may keep.
    """
    digests = [digest_of(Path(path).absolute()) for path in paths]
    return hashlib.sha256(b"".join(digests)).hexdigest()

"""Disks that are full or read-only, made for one command in a namespace of its own."""

import subprocess
from pathlib import Path

import pytest

NAMESPACE = ["unshare", "--map-root-user", "--mount"]
FULL = "mount -t tmpfs -o size=4k none {0}"
"""A disk of one page, on which no NetCDF file has room."""
READ_ONLY = "mount --bind {0} {0} && mount -o remount,ro,bind {0}"


def need_namespaces() -> None:
    """Skip the test where namespaces are not allowed, as in some containers."""
    tried = subprocess.run(
        [*NAMESPACE, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, text=True
    )
    if tried.returncode != 0:
        pytest.skip(f"no disk can be mounted here: {tried.stderr.strip()}")


def on_disk(
    kind: str, place: str, folder: Path, *command: str | Path
) -> subprocess.CompletedProcess[str]:
    """Run a command in `folder`, with a disk of this kind at `place` below it.

    What the command says is in stderr; stdout lists the files on the disk afterwards.
    """
    need_namespaces()
    (folder / place).mkdir(exist_ok=True)
    mounted = f'{kind.format(place)} && {{ "$@" >&2; status=$?; ls -A {place}; exit $status; }}'
    return subprocess.run(
        [*NAMESPACE, "sh", "-c", mounted, "sh", *command],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=120,
    )

"""Before a run: what one that was killed left behind, and whether there is room to write."""

import contextlib
import fcntl
import os
import shutil
from pathlib import Path


class FolderError(ValueError):
    """Folders in which a run cannot write."""


def refuse_unwritable(folder: Path) -> None:
    """Raise FolderError where a run could not write."""
    places = [folder, folder / "build", folder / ".snakemake"]
    places += [Path(path) for path, *_ in os.walk(folder / "results")]
    closed = {place for place in places if place.exists() and not os.access(place, os.W_OK)}
    if closed:
        named = ", ".join(sorted(str(place) for place in closed if place.parent not in closed))
        raise FolderError(
            f"nothing can be written in {named}; see that it is on no read-only disk and belongs to"
            " you, then run again"
        )


def free_folder(folder: Path) -> int | None:
    """Remove Snakemake's lock where no run is alive, and mark this run as alive.

    The mark is a lock of the operating system on the folder, shared by all runs in it, which ends
    with the process however that ends. Return its file descriptor, or None where the file system
    has no such locks: there nothing is removed.
    """
    mark = os.open(folder, os.O_RDONLY)
    try:
        with contextlib.suppress(BlockingIOError):
            fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(folder / ".snakemake" / "locks", ignore_errors=True)
        fcntl.flock(mark, fcntl.LOCK_SH)
    except OSError:
        os.close(mark)
        return None
    return mark

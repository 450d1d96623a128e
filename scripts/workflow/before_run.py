"""Before a run: what one that was killed left behind, and whether there is room to write."""

import fcntl
import os
import re
import shlex
import struct
import sys
import time
from pathlib import Path


class FolderError(ValueError):
    """Folders in which a run cannot write."""


def refuse_path(project: Path, folder: Path) -> None:
    """Raise FolderError where Snakemake would not take paths of the project as they are.

    In the project itself they are relative to it.
    """
    if folder != project and re.search("[{}<>]", str(project)):
        raise FolderError(
            f"the project is in '{project}'; run it there, or move it to a path without {{ }} < >:"
            " in other folders Snakemake gives them a meaning of their own"
        )


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


def free_folder(folder: Path) -> str | None:
    """Remove Snakemake's locks where no other run is alive, and mark this run as alive.

    The mark is a lock of the operating system, shared by all runs in the folder. It ends with the
    process however that ends, and no child inherits it. Return which other run is alive, or None.
    Where the file system has no such locks nothing is removed.
    """
    started = time.strftime("%Y-%m-%d %H:%M:%S")
    words = f"process {os.getpid()}, started {started}: {shlex.join(sys.orig_argv)}"
    other = None
    try:
        # left open: to close it would end the lock
        mark = os.open(folder / ".snakemake" / "runs", os.O_RDWR | os.O_CREAT | os.O_APPEND)
        try:
            fcntl.lockf(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.ftruncate(mark, 0)
            for lock in folder.glob(".snakemake/locks/*.lock"):
                lock.unlink()
        except BlockingIOError:
            other = words_of_run(mark)
        fcntl.lockf(mark, fcntl.LOCK_SH)
        os.write(mark, f"{words}\n".encode())
    except OSError:
        return None
    return other


def words_of_run(mark: int) -> str:
    """What a run that holds a lock on the file of runs wrote into it."""
    # the structure `flock` of fcntl(2): kind, whence, start, length, process
    layout = struct.Struct("hhqqi")
    asked = layout.pack(fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0)
    *_, process = layout.unpack(fcntl.fcntl(mark, fcntl.F_GETLK, asked))
    lines = os.pread(mark, os.fstat(mark).st_size, 0).decode(errors="replace").splitlines()
    named = [line for line in lines if line.startswith(f"process {process}, ")]
    return named[-1] if named else f"process {process}"

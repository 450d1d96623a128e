"""What scripts write is whole or absent; what goes wrong is said in one line with what to do."""

import contextlib
import os
import re
import time
import traceback
from collections.abc import Iterator
from pathlib import Path

REMEDY = "check that its folder exists, is writable and has free space, then run again"


class FileError(Exception):
    """A file that cannot be read or written: which, why, and what to do."""


def send_to_disk(path: Path) -> None:
    """Return when a file or folder is on the disk, where it outlasts a loss of power."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextlib.contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """The path to write to: what is there at the end becomes `path`, of a failure nothing stays.

    Each run has another one, and removes those of earlier runs, as the Fortran programs do: the
    last of several runs to begin writes the file.
    """
    path = Path(path)
    unfinished = path.with_name(f"{path.name}.{os.getpid()}-{time.monotonic_ns()}.part")
    try:
        for name in os.listdir(path.parent):
            if re.fullmatch(rf"{re.escape(path.name)}\.[0-9-]+\.part", name):
                path.with_name(name).unlink(missing_ok=True)
        yield unfinished
        if not unfinished.exists():
            raise FileError(
                f"{path}: another run has started to write this file; only the last one keeps it"
            )
        send_to_disk(unfinished)
        os.replace(unfinished, path)
        # not all file systems can send a folder to the disk
        with contextlib.suppress(OSError):
            send_to_disk(path.parent)
    except OSError as problem:
        raise FileError(f"{path}: cannot write: {problem.strerror}; {REMEDY}") from problem
    finally:
        with contextlib.suppress(OSError):
            unfinished.unlink(missing_ok=True)


@contextlib.contextmanager
def logged(path: str | Path) -> Iterator[None]:
    """Write warnings and the reason of a failure to a log file.

    Problems with files end the script in one line on standard error; their details are in the log.
    """
    try:
        with open(path, "w") as log, contextlib.redirect_stderr(log):
            try:
                yield
            except Exception:
                traceback.print_exc()
                raise
    except FileError as problem:
        raise SystemExit(f"error: {problem}") from None
    except OSError as problem:
        place = problem.filename or path
        raise SystemExit(f"error: {place}: {problem.strerror}; {REMEDY}") from None

"""Files that scripts write appear only when complete; failures are reported in one line."""

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
    """A path to write to: the file there becomes `path` at the end; a failure leaves nothing.

    Each run has a path of its own and removes those of earlier runs, as the Fortran programs do: of
    several runs the one that began last writes the file. Raises FileError.
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
    """Write warnings and tracebacks to a log file.

    A FileError ends the script with one line on standard error.
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

"""Files that scripts write appear only when complete; failures are reported in one line."""

import contextlib
import glob
import os
import traceback
import uuid
from collections.abc import Iterator
from pathlib import Path

REMEDY = "check that its folder exists, is writable and has free space, then run again"


class FileError(Exception):
    """A file that cannot be read or written: which, why, and what to do."""


@contextlib.contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """A path to write to: the file there becomes `path` when it is on the disk; a failure leaves
    nothing.

    Each run has a path of its own and removes those of earlier runs, so that of several runs the
    one that began last writes the file. Raises FileError.
    """
    path = Path(path)
    unfinished = path.with_name(f"{path.name}.{uuid.uuid4().hex}.part")
    try:
        for left in path.parent.glob(f"{glob.escape(path.name)}.*.part"):
            left.unlink(missing_ok=True)
        yield unfinished
        if not unfinished.exists():
            raise FileError(
                f"{path}: cannot write: another run has started to write this file; only the last"
                " one keeps it"
            )
        with open(unfinished, "rb") as file:
            os.fsync(file.fileno())
        os.replace(unfinished, path)
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

"""Which commit of the project is at work."""

import subprocess
from pathlib import Path

UNKNOWN = "unknown"


def commit_of(folder: Path) -> str:
    """The commit, and whether files differ from it; `unknown` where there is no repository.

    A repository that merely lies around the folder is not the project's.
    """
    top = said_by_git(folder, "rev-parse", "--show-toplevel")
    commit = said_by_git(folder, "rev-parse", "--verify", "--quiet", "HEAD")
    if not commit or not top or not Path(top).samefile(folder):
        return UNKNOWN
    changed = said_by_git(folder, "status", "--porcelain")
    return f"{commit} with changes" if changed else commit


def said_by_git(folder: Path, *arguments: str) -> str:
    """What git answers; nothing where it cannot."""
    command = ["git", "-C", str(folder), *arguments]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""

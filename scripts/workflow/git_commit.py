"""The commit of the project."""

import subprocess
from pathlib import Path

UNKNOWN = "unknown"


def commit_of(folder: Path) -> str:
    """The commit, and whether files differ from it; `unknown` where there is no repository.

    A repository that merely lies around the folder is not the project's.
    """
    top = run_git(folder, "rev-parse", "--show-toplevel")
    commit = run_git(folder, "rev-parse", "--verify", "--quiet", "HEAD")
    if not commit or not top or not Path(top).samefile(folder):
        return UNKNOWN
    changed = run_git(folder, "status", "--porcelain")
    return f"{commit} with changes" if changed else commit


def run_git(folder: Path, *arguments: str) -> str:
    """Output of a git command; empty if it fails."""
    command = ["git", "-C", str(folder), *arguments]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""

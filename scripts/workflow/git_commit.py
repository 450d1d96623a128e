"""The commit of the project."""

import subprocess
from pathlib import Path

UNKNOWN = "unknown"


def commit_of(folder: Path) -> str:
    """The commit, and whether files differ from it; `unknown` where there is no repository.

    A repository that merely lies around the folder is not the project's.
    """
    git = ["git", f"--git-dir={folder / '.git'}", f"--work-tree={folder}"]
    try:
        commit, changed = (
            subprocess.run([*git, *words], capture_output=True, text=True, check=True).stdout
            for words in (["rev-parse", "--verify", "HEAD"], ["status", "--porcelain"])
        )
    except (OSError, subprocess.CalledProcessError):
        return UNKNOWN
    return f"{commit.strip()} with changes" if changed else commit.strip()

"""Which commit the page names."""

import shutil
import subprocess

import pytest

from scripts.workflow.git_commit import UNKNOWN, commit_of


@pytest.mark.skipif(not shutil.which("git"), reason="no git")
def test_commit_is_named(tmp_path, monkeypatch):
    """By its full hash, with a word on changes; a repository around a copy is not its own."""

    def git(*words: str) -> str:
        me = ("-c", "user.name=me", "-c", "user.email=me@here")
        run = subprocess.run(["git", *me, *words], cwd=tmp_path, capture_output=True, text=True)
        return run.stdout.strip()

    assert commit_of(tmp_path) == UNKNOWN
    git("init")
    assert commit_of(tmp_path) == UNKNOWN
    (tmp_path / "file").write_text("one")
    git("add", "file")
    git("commit", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert commit_of(tmp_path) == commit
    (tmp_path / "copy").mkdir()
    assert commit_of(tmp_path / "copy") == UNKNOWN
    (tmp_path / "other").write_text("two")
    assert commit_of(tmp_path) == f"{commit} with changes"
    # a machine without git
    monkeypatch.setenv("PATH", "")
    assert commit_of(tmp_path) == UNKNOWN

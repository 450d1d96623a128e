"""Which commit the page names."""

import shutil
import subprocess

import pytest

from scripts.workflow.git_commit import UNKNOWN, commit_of

pytestmark = pytest.mark.skipif(not shutil.which("git"), reason="no git")


@pytest.fixture
def repository(tmp_path, monkeypatch):
    for name, value in (("NAME", "me"), ("EMAIL", "me@here")):
        monkeypatch.setenv(f"GIT_AUTHOR_{name}", value)
        monkeypatch.setenv(f"GIT_COMMITTER_{name}", value)
    (tmp_path / "file").write_text("one")
    for command in (["init"], ["add", "file"], ["commit", "-m", "first"]):
        subprocess.run(["git", *command], cwd=tmp_path, check=True, capture_output=True)
    return tmp_path


def test_commit_is_named(repository, monkeypatch):
    """By its full hash, with a word on changes; a repository around a copy is not its own."""
    head = (repository / ".git" / "HEAD").read_text().removeprefix("ref: ").strip()
    commit = (repository / ".git" / head).read_text().strip()
    assert commit_of(repository) == commit
    (repository / "copy").mkdir()
    assert commit_of(repository / "copy") == UNKNOWN
    (repository / "other").write_text("two")
    assert commit_of(repository) == f"{commit} with changes"
    # a machine without git
    monkeypatch.setenv("PATH", "")
    assert commit_of(repository) == UNKNOWN


def test_no_repository_and_no_commit_yet(tmp_path):
    assert commit_of(tmp_path) == UNKNOWN
    subprocess.run(["git", "init", tmp_path], check=True, capture_output=True)
    assert commit_of(tmp_path) == UNKNOWN

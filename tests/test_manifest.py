"""Lists of digests: damage is noticed, and results of two people can be compared."""

import os
import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from conftest import ROOT, SMOKE
from scripts.workflow import manifest

LISTS = ("results/manifest.sha256", "results/measured.sha256")
KEPT = ["results/tables/a.tsv", "results/figures/a.svg", "results/index.html"]
MEASURED = [
    "results/measurements/stability/a.nc",
    "results/figures/work_precision.svg",
]
OTHERS = ["logs/a.log", "benchmarks/a.tsv", "README.md", "mine/index.html"]


def write(path: str, text: str, age: float = 0.0) -> None:
    """A file that was last changed some seconds ago."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(text)
    changed = time.time() - age
    os.utime(path, (changed, changed))


@pytest.fixture(autouse=True)
def run_done(tmp_path, monkeypatch) -> None:
    """A folder of results of one run."""
    monkeypatch.chdir(tmp_path)
    for path in [*KEPT, *MEASURED, *(f"results/{name}" for name in OTHERS)]:
        write(path, path, age=100.0)
    manifest.record_run("results")


def verify(folder: Path, *lists: str) -> tuple[int, list[str]]:
    """Exit status and lines of ./reproduce --verify, called from another folder."""
    command = [folder / "reproduce", "--verify", *lists]
    run = subprocess.run(command, cwd=folder.parent, capture_output=True, text=True)
    return run.returncode, (run.stdout + run.stderr).splitlines()


def test_lists_hold_all_results():
    """Each once, and nothing else."""
    for path, names in zip(LISTS, (KEPT, MEASURED), strict=True):
        assert re.findall("  (.*)", Path(path).read_text()) == sorted(names)
    shutil.copy(ROOT / "reproduce", "reproduce")
    assert verify(Path.cwd()) == (0, ["all 5 results agree"])
    Path(KEPT[0]).unlink()
    status, lines = verify(Path.cwd())
    assert status == 1
    assert f"{KEPT[0]}: FAILED open or read" in lines
    Path(LISTS[0]).unlink()
    status, (line,) = verify(Path.cwd())
    assert status == 1
    assert "cannot be read; a run of ./reproduce writes" in line


@pytest.mark.parametrize("is_killed", [False, True])
def test_what_a_run_made_is_kept_and_what_was_damaged_is_removed(is_killed):
    """Of a run that was killed, too. Damaged with its old time, or edited: no run records it before
    it is made again. What is gone leaves the list, what is new is added."""
    flipped, made, edited, gone = KEPT[0], KEPT[1], KEPT[2], MEASURED[0]
    write(flipped, "flipped", age=100.0)
    write(edited, "edited", age=50.0)
    manifest.begin_run("results")
    write("results/.run-began", "", age=20.0)
    write(made, "made by the run", age=10.0)
    write("results/tables/b.tsv", "new", age=10.0)
    Path(gone).unlink()
    if is_killed:
        assert set(manifest.remove_damaged("results")) == {flipped, edited}
        manifest.begin_run("results")
    manifest.record_run("results")
    assert set(manifest.remove_damaged("results")) == (set() if is_killed else {flipped, edited})
    assert manifest.remove_damaged("results") == []
    assert not Path(flipped).exists()
    assert Path(made).read_text() == "made by the run"
    listed = manifest.read_digests("results")
    assert gone not in listed
    assert {made, "results/tables/b.tsv"} <= set(listed)
    write(made, "edited after the run", age=5.0)
    assert manifest.remove_damaged("results") == [made]


def test_run_makes_damaged_and_removed_results_again(smoke, scratch):
    """To the bytes that they had, and the lists agree with those of another copy; of the atlas
    the removed part alone is computed."""
    results = scratch.folder / "results"
    before = scratch.outputs()
    os.truncate(results / "hopf" / "xi_of_epsilon.nc", 1000)
    with open(results / "tables" / "claims.tsv", "a") as table:
        table.write("edited\n")
    assert verify(scratch.folder)[0] == 1
    part, other = (results / "attractors" / "atlas" / "xi_08" / f"000{i}.nc" for i in (2, 1))
    for path in (part, results / "tables" / "atlas.tsv", results / "page" / "style.css"):
        path.unlink()
    # the same bytes with a new time
    os.utime(scratch.folder / "build" / "release" / "bin" / "spring_block")
    written = other.stat().st_mtime_ns
    run = scratch.reproduce(*SMOKE)
    assert run.returncode == 0, run.stdout
    for name in ("hopf/xi_of_epsilon.nc", "tables/claims.tsv"):
        assert f"results/{name}: was changed or damaged since a run made it" in run.stdout
    assert scratch.outputs() == before
    assert other.stat().st_mtime_ns == written
    assert verify(scratch.folder)[0] == 0
    assert verify(scratch.folder, str(smoke.folder / LISTS[0]))[0] == 0

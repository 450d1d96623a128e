"""Lists of digests: damage is noticed, and results of two people can be compared."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from conftest import ROOT, Project
from scripts.workflow import manifest

LISTS = ("results/manifest.sha256", "results/measured.sha256")


def write(path: str, text: str, age: float = 0.0) -> None:
    """A file that was last changed some seconds ago."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(text)
    changed = time.time() - age
    os.utime(path, (changed, changed))


@pytest.fixture
def results(tmp_path, monkeypatch) -> list[str]:
    """A folder of results of one run, and those of them that a list holds."""
    monkeypatch.chdir(tmp_path)
    begins = ("tables/b", "figures/work_precision", "times.html")
    monkeypatch.setattr(manifest, "is_measured", lambda path: path.startswith(begins))
    kept = ["tables/a.tsv", "figures/a.svg", "index.html"]
    measured = ["tables/b.tsv", "figures/work_precision.svg", "times.html"]
    others = ["logs/a.log", "benchmarks/a.tsv", "README.md", "mine/index.html"]
    for name in [*kept, *measured, *others]:
        write(f"results/{name}", name, age=100.0)
    manifest.record_run("results")
    return [f"results/{name}" for name in kept + measured]


def verify(folder: Path, *lists: str) -> tuple[int, list[str]]:
    """Exit status and lines of ./reproduce --verify, called from another folder."""
    run = subprocess.run(
        [folder / "reproduce", "--verify", *lists],
        cwd=folder.parent,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return run.returncode, run.stdout.splitlines()


def test_lists_hold_all_results(results):
    listed = [Path(path).read_text().splitlines() for path in LISTS]
    kept, measured = ({line.split("  ")[1] for line in lines} for lines in listed)
    assert (kept, measured) == (set(results[:3]), set(results[3:]))
    shutil.copy(ROOT / "reproduce", "reproduce")
    assert verify(Path.cwd()) == (0, ["all 6 results agree"])
    Path(results[0]).unlink()
    status, lines = verify(Path.cwd())
    assert status == 1
    assert f"{results[0]}: FAILED open or read" in lines


def test_result_that_changed_between_runs_is_removed(results):
    """Damaged with its old time, or edited; no run records it before it is made again."""
    flipped, edited, *_ = results
    write(flipped, "flipped", age=100.0)
    write(edited, "edited", age=50.0)
    manifest.begin_run("results")
    manifest.record_run("results")
    assert set(manifest.remove_damaged("results")) == {flipped, edited}
    assert not Path(flipped).exists()
    assert manifest.remove_damaged("results") == []


def test_results_of_a_run_are_recorded(results):
    """What it made anew has a new digest, what is gone leaves the list, what is new is added."""
    changed, gone, *_ = results
    manifest.begin_run("results")
    write(changed, "made by the run", age=-1.0)
    write("results/tables/b.tsv", "new")
    Path(gone).unlink()
    manifest.record_run("results")
    assert manifest.remove_damaged("results") == []
    assert gone not in manifest.read_digests("results")
    assert "results/tables/b.tsv" in manifest.read_digests("results")


def test_results_of_a_killed_run_stay(results):
    """The next run records them; what was damaged before it began is removed."""
    made, damaged, *_ = results
    write(damaged, "damaged", age=50.0)
    manifest.begin_run("results")
    write(made, "made by the killed run", age=-1.0)
    assert manifest.remove_damaged("results") == [damaged]
    manifest.begin_run("results")
    manifest.record_run("results")
    assert manifest.remove_damaged("results") == []
    assert Path(made).exists()


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
    (scratch.folder / "build" / "release" / "bin" / "spring_block_quad").unlink()
    written = other.stat().st_mtime_ns
    run = scratch.reproduce("--configfile", "config/smoke.yaml")
    assert run.returncode == 0, run.stdout
    for name in ("hopf/xi_of_epsilon.nc", "tables/claims.tsv"):
        assert f"results/{name}: was changed or damaged since a run made it" in run.stdout
    assert scratch.outputs() == before
    assert other.stat().st_mtime_ns == written
    assert verify(scratch.folder)[0] == 0
    assert verify(scratch.folder, str(smoke.folder / LISTS[0]))[0] == 0


def test_results_without_lists_cannot_be_compared(fresh: Project):
    status, lines = verify(fresh.folder)
    assert (status, len(lines)) == (1, 1)
    assert "cannot be read; a run of ./reproduce writes" in lines[0]

"""Lists of digests: damage is noticed, and results of two people can be compared."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import ROOT, SMOKE, Project, rules_in

from scripts.workflow import manifest

LISTS = ("results/manifest.sha256", "results/measured.sha256")


@pytest.fixture
def results(tmp_path, monkeypatch) -> list[str]:
    """A folder of results of one run, and those of them that a list holds."""
    kept = ["tables/a.tsv", "figures/a.svg", "index.html"]
    measured = ["measurements/stability/a.nc", "figures/work_precision.svg", "times.html"]
    others = ["logs/a.log", "benchmarks/a.tsv", "README.md", "mine/index.html"]
    for name in [*kept, *measured, *others]:
        path = tmp_path / "results" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
    monkeypatch.chdir(tmp_path)
    manifest.record(["results"], [])
    return [f"results/{name}" for name in kept + measured]


def sha256sum(*lists: str) -> list[str]:
    """Results that differ from lists."""
    command = ["sha256sum", "--check", "--strict", "--quiet", *(lists or LISTS)]
    run = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    return [line.partition(":")[0] for line in run.stdout.splitlines()]


def test_lists_hold_all_results(results):
    """In the format of sha256sum; what was measured is apart."""
    listed = [Path(path).read_text().splitlines() for path in LISTS]
    kept, measured = ({line.split("  ")[1] for line in lines} for lines in listed)
    assert (kept, measured) == (set(results[:3]), set(results[3:]))
    assert sha256sum() == []


def test_no_run_blesses_a_result_that_was_edited(results):
    """It stays different until a run has made it; what is new is added, what is gone leaves."""
    edited, gone, *_ = results
    Path(edited).write_text("edited")
    Path(gone).unlink()
    Path("results/tables/b.tsv").write_text("new")
    manifest.record(["results"], [])
    assert manifest.damaged([*results, "results/tables/b.tsv"]) == [edited]
    assert sha256sum() == [edited]
    assert gone not in manifest.read("results")
    assert "results/tables/b.tsv" in manifest.read("results")
    manifest.record(["results"], [edited])
    assert manifest.damaged(results) == []
    assert sha256sum() == []


def test_run_that_is_killed(results):
    """It has made one of two results; what it was to make anew because of damage is gone."""
    made, damaged, waiting, *_ = results
    Path(damaged).write_text("damaged")
    manifest.forget([made, damaged, waiting])
    Path(made).write_text("made by the killed run")
    assert manifest.damaged(results) == []
    assert not Path(damaged).exists()
    manifest.record(["results"], [])
    assert sha256sum() == []


def test_results_of_which_none_is_measured_can_be_compared(results):
    """One list is empty."""
    for path in results[3:]:
        Path(path).unlink()
    manifest.record(["results"], [])
    shutil.copy(ROOT / "reproduce", "reproduce")
    assert verify(Project(Path.cwd())) == (0, ["all 3 results agree"])
    Path(results[0]).unlink()
    status, lines = verify(Project(Path.cwd()))
    assert status == 1
    assert f"{results[0]}: FAILED open or read" in lines


def verify(project: Project, *lists: str) -> tuple[int, list[str]]:
    """Exit status and lines of ./reproduce --verify, called from another folder."""
    run = subprocess.run(
        [project.folder / "reproduce", "--verify", *lists],
        cwd=project.folder.parent,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return run.returncode, run.stdout.splitlines()


def test_damaged_results_are_made_again(smoke, scratch):
    """With their old time or a new one, by the same command; a dry run lists them."""
    results = scratch.folder / "results"
    before = scratch.outputs()
    lists = {path: (scratch.folder / path).read_text() for path in LISTS}
    names = ("exponents/torus.nc", "trajectories/torus.nc", "tables/claims.tsv")
    flipped, cut, edited = names
    times = os.stat(results / flipped)
    content = bytearray(before[flipped])
    content[len(content) // 2] ^= 1
    (results / flipped).write_bytes(content)
    os.utime(results / flipped, ns=(times.st_atime_ns, times.st_mtime_ns))
    os.truncate(results / cut, 1000)
    with open(results / edited, "a") as table:
        table.write("edited\n")
    status, lines = verify(scratch)
    assert status == 1
    differing = [line.partition(": FAILED")[0] for line in lines if ": FAILED" in line]
    assert sorted(differing) == sorted(f"results/{name}" for name in names)
    assert "the next run makes" in lines[-1]
    planned = scratch.snakemake("--dry-run", *SMOKE)
    assert {path: (scratch.folder / path).read_text() for path in LISTS} == lists
    assert (results / cut).stat().st_size == 1000
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    for said in (planned.stdout, run.stdout):
        for name in names:
            assert f"results/{name}: was changed or damaged since a run made it" in said
        assert {"exponents_runs", "trajectory", "claims"} <= rules_in(said)
    assert scratch.outputs() == before
    assert (scratch.folder / LISTS[0]).read_text() == lists[LISTS[0]]
    status, lines = verify(scratch)
    assert (status, len(lines)) == (0, 1)
    assert verify(scratch, str(smoke.folder / LISTS[0]))[0] == 0


def test_results_without_lists_cannot_be_compared(fresh):
    """In one line."""
    status, lines = verify(fresh)
    assert (status, len(lines)) == (1, 1)
    assert "cannot be read; a run of ./reproduce writes" in lines[0]

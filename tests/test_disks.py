"""Full and read-only disks: one message that says what to do, and nothing half-written."""

import shutil
import sys
import time
from pathlib import Path

import pytest
from disks import FULL, READ_ONLY, on_disk

from conftest import SMOKE, rules_in

REMEDY = "; check that its folder exists, is writable and has free space, then run again\n"
SNAKEMAKE = Path(sys.executable).parent / "snakemake"


@pytest.mark.parametrize(
    ("disk", "reason"), [(FULL, "No space left on device"), (READ_ONLY, "Read-only file system")]
)
@pytest.mark.parametrize("program", ["hopf", "reference"])
def test_program_on_such_a_disk(programs, good_groups, program, disk, reason):
    """It gives the system's reason in one line and ends with status 1; the disk is empty."""
    programs.write(good_groups[program])
    if program == "reference":
        # a long table: a small one has room
        disk = disk.replace("size=4k", "size=4k,nr_inodes=1")
    command = programs.command(program)
    run = on_disk(disk, "disk", programs.folder, *command, "input.nml", "disk/output")
    assert run.returncode == 1
    assert run.stderr == f"error: disk/output: cannot write: {reason}{REMEDY}"
    assert run.stdout == ""


def test_disk_that_fills_up_ends_a_trajectory(programs, good_inputs):
    """At once: all of it would take minutes."""
    values = {**good_inputs["trajectory"], "t_end": 1e8, "sample_interval": 1.0}
    programs.write({"scene": values})
    command = programs.command("trajectory")
    begun = time.monotonic()
    disk = FULL.replace("4k", "1m")
    run = on_disk(disk, "disk", programs.folder, *command, "input.nml", "disk/output")
    assert time.monotonic() - begun < 20
    assert run.returncode == 1
    last = run.stderr.splitlines(keepends=True)[-1]
    assert last == f"error: disk/output: cannot write: No space left on device{REMEDY}"
    assert run.stdout == ""


def test_script_on_a_full_disk(scratch):
    """The same from the workflow, without a traceback of the script."""
    place = "results/figures"
    shutil.rmtree(scratch.folder / place)
    run = on_disk(FULL, place, scratch.folder, SNAKEMAKE, "--cores", "2", "figure_1", *SMOKE)
    assert run.returncode != 0
    assert (
        f"error: {place}/figure_1.pdf: cannot write: No space left on device{REMEDY}" in run.stderr
    )
    assert 'figure_1.py", line' not in run.stderr
    assert run.stdout == ""


def test_reason_reaches_the_screen_where_the_log_has_no_room(scratch, tmp_path):
    """Log and result fill the same disk."""
    settings = tmp_path / "full.yaml"
    settings.write_text("{ pathvars: { results: full/run }, scenes: { torus: { t_end: 8000.0 } } }")
    target = "full/run/trajectories/torus.nc"
    command = [SNAKEMAKE, "--cores", "1", target, *SMOKE, settings]
    run = on_disk(FULL.replace("4k", "200k"), "full", scratch.folder, *command)
    assert run.returncode != 0
    assert f"error: {target}: cannot write: No space left on device{REMEDY}" in run.stderr


def test_home_that_cannot_be_written_is_not_needed(scratch, monkeypatch):
    """Snakemake keeps a cache there, and Matplotlib another."""
    monkeypatch.setenv("HOME", "/dev/null")
    for name in ("XDG_CACHE_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)
    run = scratch.snakemake("figure_1", "--force", *SMOKE)
    assert run.returncode == 0, run.stdout
    assert "figure_1" in rules_in(run.stdout)


def test_results_that_cannot_be_written(scratch):
    place = "results/logs"
    scratch.use_packages_at_hand()
    before = scratch.outputs()
    run = on_disk(READ_ONLY, place, scratch.folder, "./reproduce", "--forceall", "figure_1", *SMOKE)
    assert run.returncode == 1
    (line,) = run.stderr.splitlines()
    assert line.startswith(f"reproduce: nothing can be written in {place}; see that")
    assert scratch.outputs() == before

"""Full and read-only disks: one message that says what to do, and nothing half-written."""

import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import ROOT, write_script

REMEDY = "; check that its folder exists, is writable and has free space, then run again\n"
NAMESPACE = ["unshare", "--map-root-user", "--mount"]
READ_ONLY = "mount --bind {0} {0} && mount -o remount,ro,bind {0}"


def full(size: str) -> str:
    """Mounts a disk of this size; one of a page has no room for a NetCDF file."""
    return f"mount -t tmpfs -o size={size} none {{0}}"


def on_disk(
    kind: str, place: str, folder: Path, *command: str | Path
) -> subprocess.CompletedProcess[str]:
    """Run a command in `folder`, with a disk of this kind at `place` below it, which is made for it
    in a namespace of its own.

    What the command says is in stderr; stdout lists the files on the disk afterwards.
    """
    tried = [*NAMESPACE, "mount", "-t", "tmpfs", "none", "/mnt"]
    if (said := subprocess.run(tried, capture_output=True, text=True)).returncode != 0:
        pytest.skip(f"no disk can be mounted here: {said.stderr.strip()}")
    (folder / place).mkdir(exist_ok=True)
    mounted = f'{kind.format(place)} && {{ "$@" >&2; status=$?; ls -A {place}; exit $status; }}'
    words = [*NAMESPACE, "sh", "-c", mounted, "sh", *command]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize(
    ("program", "disk", "reason"),
    [
        # fills up during the run, all of which would take minutes
        ("trajectory", full("1m"), "No space left on device"),
        ("reference", full("4k"), "No space left on device"),
        ("reference", READ_ONLY, "Read-only file system"),
    ],
)
def test_program_on_such_a_disk(programs, good_groups, program, disk, reason):
    """It gives the system's reason in one line and ends with status 1; the disk is empty."""
    if program == "trajectory":
        good_groups[program]["scene"] |= {"t_end": 1e8, "sample_interval": 1.0}
    programs.write(good_groups[program])
    command = programs.command(program)
    run = on_disk(disk, "disk", programs.folder, *command, "input.nml", "disk/output")
    assert (run.returncode, run.stdout) == (1, "")
    *progress, last = run.stderr.splitlines(keepends=True)
    assert last == f"error: disk/output: cannot write: {reason}{REMEDY}"
    assert all(line.startswith("trajectory of ") for line in progress)


@pytest.mark.parametrize(
    ("script", "place", "words"),
    [
        ("reproduce", "results", "reproduce: nothing can be written in results; see that"),
        ("tools/setup/setup.sh", ".", "set-up: nothing can be written in "),
    ],
)
def test_script_on_a_read_only_disk(tmp_path, script, place, words):
    """It says so at once, and starts nothing."""
    folder = tmp_path / "project"
    shutil.copytree(ROOT / "tools/setup", folder / "tools/setup")
    for name in ("reproduce", "requirements.lock"):
        shutil.copy(ROOT / name, folder)
    if script == "reproduce":
        write_script(folder / "tools/setup/setup.sh", "exit 0")
    run = on_disk(READ_ONLY, place, folder, folder / script)
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1].startswith(words)

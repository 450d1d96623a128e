"""What several test files share: a copy of the project, its smoke run and its programs."""

import copy
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
import xarray as xr

from scripts.config.check_config import checked
from scripts.config.read_config import merged, read
from scripts.namelists.write_namelist import write_namelist

ROOT = Path(__file__).parent.parent
SMOKE = ("--configfile", "config/smoke.yaml")
"""Arguments for a run in smoke size; further config files may follow, targets must stand before."""
GROUPS = {
    "trajectory": "scene",
    "spectrum": "spectrum",
    "hopf": "hopf_curves",
    "linear_stability": "linear_stability",
    "velocity_step": "velocity_step",
}
"""Namelist group of each program."""
MADE = {
    ".git",
    ".venv",
    ".snakemake",
    "build",
    "results",
    "__pycache__",
    ".pytest_cache",
    ".ruff_cache",
}
"""Folders that hold none of the project's own files."""


def timeless(path: Path) -> bytes:
    """Contents of a file; of a table without its column of measured seconds."""
    content = path.read_bytes()
    if path.parent.name != "tables":
        return content
    rows = [line.split(b"\t") for line in content.splitlines()]
    kept = [i for i, name in enumerate(rows[0]) if name != b"seconds"]
    return b"\n".join(b"\t".join(row[i] for i in kept) for row in rows)


@dataclass
class Project:
    """A copy of the project in which the workflow runs."""

    folder: Path

    def snakemake(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run Snakemake on two cores; all it says is in stdout."""
        snakemake = Path(sys.executable).parent / "snakemake"
        return subprocess.run(
            [snakemake, "--cores", "2", *arguments],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=900,
        )

    def copy_to(self, folder: Path) -> "Project":
        """A copy with results, programs and Snakemake's records."""
        shutil.copytree(self.folder, folder)
        return Project(folder)

    def outputs(self) -> dict[str, bytes]:
        """Contents of results by path, without logs and measured times."""
        results = self.folder / "results"
        files = [path for path in results.rglob("*") if path.is_file()]
        names = {path.relative_to(results).as_posix(): path for path in files}
        changing = (
            "logs/",
            "benchmarks/",
            "measurements/",
            "figures/work_precision",
            "index.html",
        )
        return {n: timeless(path) for n, path in names.items() if not n.startswith(changing)}


def unfinished(path: Path) -> set[Path]:
    """What runs are writing that will become `path`."""
    return set(path.parent.glob(f"{path.name}.*.part"))


def wait_for(done: Callable[[], bool]) -> None:
    """Return when something is so."""
    end = time.monotonic() + 60
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)


@dataclass
class Programs:
    """The built programs, run by hand in one folder."""

    binaries: Path
    folder: Path

    @property
    def output(self) -> Path:
        """Where a program writes."""
        return self.folder / "output.nc"

    def run(self, program: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a program with these arguments."""
        return subprocess.run(
            [self.binaries / program, *arguments],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=60,
        )

    def start(self, program: str, **options) -> subprocess.Popen:
        """A run in the background; the options are those of Popen."""
        command = [self.binaries / program, "input.nml", self.output.name]
        return subprocess.Popen(command, cwd=self.folder, **options)

    def begin(self, program: str, **options) -> subprocess.Popen:
        """A run in the background that has begun to write."""
        before = unfinished(self.output)
        run = self.start(program, **options)
        wait_for(lambda: bool(unfinished(self.output) - before))
        return run

    def run_with(self, program: str, values: dict) -> subprocess.CompletedProcess[str]:
        """Run a program with a namelist of these values."""
        write_namelist(self.folder / "input.nml", GROUPS[program], values)
        return self.run(program, "input.nml", self.output.name)

    def made_by(self, program: str, values: dict) -> xr.Dataset:
        """What a program makes of good values."""
        run = self.run_with(program, values)
        assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
        return xr.load_dataset(self.output)

    def left_behind(self) -> list[str]:
        """Names of the files in the folder that are not its namelist."""
        return sorted(path.name for path in self.folder.iterdir() if path.suffix != ".nml")


def rules_in(log: str) -> set[str]:
    """Names of the rules in the log of a run or a dry run."""
    return set(re.findall(r"^(?:local)?(?:rule|checkpoint) (\w+):", log, flags=re.MULTILINE))


def project_files() -> list[str]:
    """Paths of the project's own files, also where there is no git."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
        names = set(listed.stdout.split("\0")) - {""}
    except (OSError, subprocess.CalledProcessError):
        paths = (path.relative_to(ROOT) for path in ROOT.rglob("*"))
        names = {str(path) for path in paths if not MADE & set(path.parts)}
    return sorted(name for name in names if (ROOT / name).is_file())


def copy_of_project(folder: Path) -> Project:
    """The project's own files in a new folder."""
    for name in project_files():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, target)
    return Project(folder)


@pytest.fixture(scope="session")
def default_config() -> dict:
    """The config as it stands in the file; not to be changed."""
    return read(ROOT / "config" / "config.yaml")


@pytest.fixture
def config(default_config) -> dict:
    """A config to change."""
    return copy.deepcopy(default_config)


@pytest.fixture(scope="session")
def smoke_config() -> dict:
    """The config of the smoke run, with its defaults; not to be changed."""
    return checked(merged([ROOT / "config" / name for name in ("config.yaml", "smoke.yaml")], []))


@pytest.fixture
def project(tmp_path) -> Project:
    """A fresh copy in which nothing was built."""
    return copy_of_project(tmp_path / "a project")


@pytest.fixture(scope="session")
def smoke_run(tmp_path_factory) -> tuple[Project, subprocess.CompletedProcess[str]]:
    """The whole workflow in smoke size, and its log."""
    project = copy_of_project(tmp_path_factory.mktemp("smoke") / "a project")
    run = project.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    return project, run


@pytest.fixture(scope="session")
def smoke(smoke_run) -> Project:
    """The copy of the project after the smoke run; not to be changed."""
    return smoke_run[0]


@pytest.fixture
def scratch(smoke, tmp_path) -> Project:
    """A copy of the smoke run to change."""
    return smoke.copy_to(tmp_path / "a copy")


@pytest.fixture
def programs(smoke, tmp_path) -> Programs:
    """The programs and an empty folder."""
    folder = tmp_path / "a folder"
    folder.mkdir()
    return Programs(smoke.folder / "build" / "release" / "bin", folder)


def of_trajectory(config: dict, scene: str) -> dict:
    """What the namelist of a scene's trajectory holds of the configuration."""
    studies = ("exponents", "attractors")
    return {key: value for key, value in config["scenes"][scene].items() if key not in studies}


@pytest.fixture
def good_inputs(config, smoke) -> dict[str, dict]:
    """Namelist values that each program accepts, to change."""
    config = checked(config)
    scene = {"name": "torus", **of_trajectory(config, "torus"), "t_end": 30.0, "t_transient": 5.0}
    trajectory = str(smoke.folder / "results" / "trajectories" / "torus.nc")
    return {
        "trajectory": {**scene, "sample_interval": 0.25, "variables": ["theta", "u", "v"]},
        "spectrum": {"trajectory": trajectory, **config["spectra"]},
        "hopf": config["hopf_curves"]["tau_of_epsilon"] | {"cells": 20},
        "linear_stability": {
            **{key: scene[key] for key in ("tau", "epsilon", "xi", "gamma")},
            **config["linear_stability"],
        },
        "velocity_step": config["velocity_step"],
    }

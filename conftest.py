"""What several test files share: a copy of the project, its smoke run and its programs."""

import contextlib
import copy
import fcntl
import functools
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
import xarray as xr
from dry_runs import Job, jobs_in
from namelist_groups import (
    CASES,
    EXPONENTS,
    MEASURE,
    OBSERVATION,
    POINTS,
    REFERENCE,
    SYNCHRONY,
    in_groups,
)

from generator.compile import compile_module
from generator.definition import read_files
from generator.module import write_module
from scripts.models.compiled import models_in, objects_of, parts_of
from scripts.models.models import PAPER, models
from scripts.plans import studies
from scripts.requests.write_namelist import write_namelist
from scripts.workflow import manifest
from scripts.workflow.plan import read_plan

ROOT = Path(__file__).parent
SMOKE = (
    *("--configfile", "config/smoke.yaml"),
    *(path.relative_to(ROOT).as_posix() for path in studies.files_of("smoke.yaml")),
)
"""Arguments for a run in smoke size; further config files may follow, targets must stand before."""
COMMANDS = sorted(path.stem[:-8] for path in ROOT.glob("fortran/src/commands/*_command.f90"))
GROUPS = {
    "trajectory": "scene",
    "spectrum": "spectrum",
    "hopf": "hopf_curves",
    "cycles": "cycles",
    "linear_stability": "linear_stability",
    "slip_events": "scene",
}
"""Namelist group of each command that reads one alone, as tests name it."""
collect_ignore = (
    [] if (studies.FOLDER / "work_precision").exists() else ["tests/test_benchmarks.py"]
)
"""Benchmarks measure the cases of this study."""
MADE = set(".git .venv .snakemake build __pycache__ .pytest_cache .hypothesis .ruff_cache".split())
"""Folders that hold none of the project's own files, beside the one of the results."""


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    """No other process that locks this file is within."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@dataclass
class Project:
    """A copy of the project in which the workflow runs."""

    folder: Path

    def run(self, *command: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a command in the folder; all it says is in stdout."""
        together = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        return subprocess.run(command, cwd=self.folder, timeout=900, **together)

    def snakemake(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        snakemake = Path(sys.executable).parent / "snakemake"
        # another process of the test run may be at work in the same folder
        with locked(self.folder.with_name(f"{self.folder.name}.lock")):
            # one second, not the three of the profile: Snakemake may end so much later
            looks = ("--max-jobs-per-timespan", "1000/1s")
            return self.run(snakemake, "--cores", "2", *looks, *arguments)

    def use_packages_at_hand(self) -> None:
        """Let ./reproduce find everything set up."""
        write_script(self.folder / "tools/setup/setup.sh", "exit 0")
        for tool in ("python", "snakemake"):
            path = Path(sys.executable).parent / tool
            write_script(self.folder / ".venv" / "bin" / tool, f"exec '{path}' \"$@\"")

    def reproduce(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        self.use_packages_at_hand()
        return self.run(self.folder / "reproduce", *arguments)

    def copy_to(self, folder: Path) -> "Project":
        shutil.copytree(self.folder, folder)
        return Project(folder)

    def outputs(self) -> dict[str, bytes]:
        """Contents of results by path, without logs and what was measured."""
        results = self.folder / "results"
        names = [name for name in manifest.results_in(results) if not studies.is_measured(name)]
        return {name: (results / name).read_bytes() for name in names}


def unfinished(path: Path) -> set[Path]:
    """What runs are writing that will become `path`."""
    return set(path.parent.glob(f"{path.name}.*.part"))


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests with a copy of the project run Snakemake; files with such tests come last, but for one
    that makes the smoke run: while it waits for Snakemake, the other process of `./test` has tests
    to run. The longest file comes first of them. A process takes whole files, so that what is dear
    is made once."""
    for item in items:
        if {"smoke_run", "project", "fresh"} & set(item.fixturenames):
            item.add_marker("workflow")
    workflow = {item.path for item in items if item.get_closest_marker("workflow")}
    first = [item.path for item in items if "smoke_run" in item.fixturenames][:1]
    longest = ROOT / "tests" / "test_user_files.py"
    items.sort(
        key=lambda item: (item.path not in first, item.path in workflow, item.path != longest)
    )


def wait_for(done: Callable[[], bool]) -> None:
    end = time.monotonic() + 60
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)


@dataclass
class Programs:
    """The built programs, run by hand in one folder."""

    binaries: Path
    folder: Path

    def command(self, name: str) -> list[Path | str]:
        """The program that has this command, and the command."""
        program = "spring_block_quad" if name == "reference" else "spring_block"
        return [self.binaries / program, name]

    @property
    def output(self) -> Path:
        return self.folder / "output.nc"

    def run(self, program: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*self.command(program), *arguments],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=60,
        )

    def begin(self, program: str, **options) -> subprocess.Popen:
        """A run in the background that has begun to write; the options are those of Popen."""
        before = unfinished(self.output)
        command = [*self.command(program), "input.nml", self.output.name]
        run = subprocess.Popen(command, cwd=self.folder, **options)
        wait_for(lambda: any(path.stat().st_size for path in unfinished(self.output) - before))
        return run

    def write(self, groups: dict[str, dict]) -> Path:
        """Write a namelist; the models that it names are compiled."""
        groups = in_groups(groups)
        for model in models_in(groups):
            compile_model(model, quad="reference" in groups)
        write_namelist(self.folder / "input.nml", groups)
        return self.folder / "input.nml"

    def run_groups(self, program: str, groups: dict[str, dict]) -> subprocess.CompletedProcess[str]:
        return self.run(program, self.write(groups).name, self.output.name)

    def made_of(self, program: str, groups: dict[str, dict]) -> xr.Dataset:
        self.check_silent(self.run_groups(program, groups))
        return xr.load_dataset(self.output)

    @staticmethod
    def check_silent(run: subprocess.CompletedProcess[str]) -> None:
        """It succeeded without words, but for progress, which a busy machine reports of runs that
        are short elsewhere."""
        said = [line for line in run.stderr.splitlines() if not re.search(r": \d+ %, ", line)]
        assert (run.returncode, run.stdout, said) == (0, "", [])

    def made_by(self, program: str, values: dict) -> xr.Dataset:
        return self.made_of(program, {GROUPS[program]: values})

    def left_behind(self) -> list[str]:
        """Names of the files in the folder that are not its namelist."""
        return sorted(path.name for path in self.folder.iterdir() if path.suffix != ".nml")


def write_script(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/bash\n{text}\n")
    path.chmod(0o755)


def rules_in(log: str) -> set[str]:
    """Names of the rules in the log of a run or a dry run."""
    return set(re.findall(r"^(?:local)?(?:rule|checkpoint) (\w+):", log, flags=re.MULTILINE))


@functools.cache
def project_files() -> list[str]:
    """Paths of the project's own files, also where there is no git."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
        names = set(listed.stdout.split("\0")) - {""}
    except (OSError, subprocess.CalledProcessError):
        paths = (path.relative_to(ROOT) for path in ROOT.rglob("*"))
        own = (path for path in paths if path.parts[0] != "results" and not MADE & set(path.parts))
        names = {"results/README.md", *map(str, own)}
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
    """The config as it stands in the files; not to be changed."""
    return studies.merged("config.yaml")


@pytest.fixture(scope="session")
def filled_config(default_config) -> dict:
    """The config with its defaults; not to be changed."""
    return read_plan({}).config


@pytest.fixture
def config(default_config) -> dict:
    return copy.deepcopy(default_config)


@pytest.fixture
def own_config(filled_config) -> dict:
    """The config with its defaults, to change."""
    return copy.deepcopy(filled_config)


@pytest.fixture(scope="session")
def smoke_config() -> dict:
    """The config of the smoke run, with its defaults; not to be changed."""
    return read_plan(studies.merged("smoke.yaml")).config


@pytest.fixture
def styled() -> Iterator[None]:
    """The style of all figures; none is left open for the next test."""
    from scripts.drawing.style import STYLE, plt  # most tests draw nothing

    with plt.style.context(STYLE):
        yield
    plt.close("all")


@pytest.fixture
def project(tmp_path) -> Project:
    """A fresh copy in which nothing was built."""
    return copy_of_project(tmp_path / "project")


@pytest.fixture(scope="session")
def fresh(tmp_path_factory) -> Project:
    """A fresh copy in which nothing was built; not to be changed."""
    return copy_of_project(tmp_path_factory.mktemp("fresh") / "project")


@pytest.fixture(scope="session")
def planned(fresh) -> list[Job]:
    """Jobs of the paper, as a dry run in a fresh copy lists them."""
    run = fresh.snakemake("--dry-run")
    assert run.returncode == 0, run.stdout
    return jobs_in(run.stdout)


@pytest.fixture(scope="session")
def shared(tmp_path_factory) -> Path:
    """A folder for all processes of a test run; without pytest-xdist there is one process."""
    folder = tmp_path_factory.getbasetemp()
    return folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder


@functools.cache
def compile_model(name: str, *, quad: bool) -> None:
    """Compile a model of the project where it is not up to date; other names are the program's."""
    if name not in models({}):
        return
    (path,) = objects_of({name}, {}, "", quad)
    parts = [ROOT / part for part in parts_of(name, {}, "")]
    sources = [*parts, *ROOT.glob("generator/*.py"), *ROOT.glob("generator/fortran/shared/*.f90")]
    with locked(ROOT / "build" / "lock"):
        made = (ROOT / path).stat().st_mtime if (ROOT / path).exists() else 0.0
        if made < max(source.stat().st_mtime for source in sources):
            compile_module(write_module(read_files(parts)), ROOT / path)


@pytest.fixture(scope="session")
def binaries() -> Path:
    """The folder of the project's programs; they are built where they are not up to date, with the
    models of the paper's law. Others are compiled for the namelists that name them."""
    with locked(ROOT / "build" / "lock"):
        targets = ["spring_block", "spring_block_quad"]
        build = ["--build", "build/release", "--parallel", "2", "--target", *targets]
        for command in (["--preset", "release", "-S", "fortran"], build):
            run = subprocess.run(["cmake", *command], cwd=ROOT, capture_output=True, text=True)
            assert run.returncode == 0, run.stdout + run.stderr
    for quad in (False, True):
        compile_model(PAPER, quad=quad)
    return ROOT / "build" / "release" / "bin"


@pytest.fixture(scope="session")
def smoke_run(binaries, shared) -> tuple[Project, str]:
    """The whole workflow in smoke size, and its log; it builds the smaller one of the programs."""
    project, log = Project(shared / "smoke" / "project"), shared / "smoke" / "log"
    with locked(shared / "smoke.lock"):
        if not log.exists():
            copy_of_project(project.folder)
            given = project.folder / "build" / "release" / "bin" / "spring_block"
            given.parent.mkdir(parents=True)
            shutil.copy(binaries / given.name, given)
            project.snakemake("--touch", str(given.relative_to(project.folder)))
            run = project.snakemake(*SMOKE)
            assert run.returncode == 0, run.stdout
            log.write_text(run.stdout)
    return project, log.read_text()


@pytest.fixture(scope="session")
def smoke(smoke_run) -> Project:
    """The copy of the project after the smoke run; not to be changed."""
    return smoke_run[0]


@pytest.fixture
def scratch(smoke, tmp_path) -> Project:
    """A copy of the smoke run to change."""
    return smoke.copy_to(tmp_path / "copy")


@pytest.fixture
def programs(binaries, tmp_path) -> Programs:
    folder = tmp_path / "a folder"
    folder.mkdir()
    return Programs(binaries, folder)


def trajectory_settings(config: dict, scene: str) -> dict:
    """What the namelist of the trajectory of a scene of one block holds of the configuration."""
    left_out = ("exponents", "attractors", "blocks", "ends", "kappa", "disturbance")
    return {key: value for key, value in config["scenes"][scene].items() if key not in left_out}


def torus(config: dict, **changes) -> dict:
    """Values of the torus, some of them changed."""
    return {"name": "torus", **trajectory_settings(config, "torus"), **changes}


@pytest.fixture(scope="session")
def trajectory_file(binaries, filled_config, tmp_path_factory) -> Path:
    """A trajectory of the torus, for its spectrum."""
    programs = Programs(binaries, tmp_path_factory.mktemp("trajectory"))
    values = torus(filled_config, t_end=600.0, t_transient=200.0, sample_interval=0.1)
    programs.made_by("trajectory", values)
    return programs.output


@pytest.fixture
def good_inputs(filled_config, trajectory_file) -> dict[str, dict]:
    """Namelist values that each program of GROUPS accepts, to change."""
    config = copy.deepcopy(filled_config)
    scene = torus(config, t_end=30.0, t_transient=5.0, sample_interval=0.25)
    return {
        "trajectory": {**scene, "variables": ["theta", "u", "v"]},
        "spectrum": {"trajectory": str(trajectory_file), **config["spectra"]},
        "hopf": config["hopf_curves"]["tau_of_epsilon"] | {"cells": 20},
        "cycles": {
            **{key: config["cycles"][key] for key in ("v", "degree", "longest_period")},
            **config["cycles"]["lines"]["torus_in_epsilon"],
            **{"t_transient": 500.0, "intervals": 20, "most_orbits": 5},
        },
        "linear_stability": {
            **{key: scene[key] for key in ("tau", "epsilon", "xi", "gamma", "law")},
            **config["linear_stability"],
        },
        "slip_events": {**scene, "variables": ["theta", "u", "v"]},
    }


@pytest.fixture
def good_groups(good_inputs) -> dict[str, dict[str, dict]]:
    """Namelist groups that each program accepts, to change."""
    groups = {program: {group: good_inputs[program]} for program, group in GROUPS.items()}
    groups["exponents"] = {"scene": good_inputs["trajectory"], "exponents": EXPONENTS}
    chain = {"blocks": 1, "kappa": 1.0, "ends": "free"}
    groups["synchrony"] = {"scene": good_inputs["trajectory"] | chain, "synchrony": SYNCHRONY}
    groups["attractors"] = {"observation": OBSERVATION, "points": POINTS}
    groups["measure"] = {"cases": CASES, "measure": MEASURE}
    groups["reference"] = {"cases": CASES, "reference": REFERENCE}
    return copy.deepcopy(groups)

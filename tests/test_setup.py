"""What sets up, starts and tests the project, without setting anything up."""

import fcntl
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import ROOT, project_files, write_script
from scripts.files.read_config import read

SCRIPTS = [
    *("reproduce", "test", "tools/setup/setup.sh", ".ci/run", "tools/compilers/run"),
    "benchmarks/run",
]
LOCKS = [
    *(".", "tools/setup", "docs", "benchmarks", "profiles/slurm", "python"),
    *("tests/browser", "tests/formats"),
]
"""Folders with a lock of Python packages."""


def locked_packages(folder: str) -> list[str]:
    """Each package of the lock with its hashes, as one line."""
    text = (ROOT / folder / "requirements.lock").read_text()
    lines = re.sub(r"\\\n", " ", re.sub(r"^\s*#.*\n", "", text, flags=re.MULTILINE)).splitlines()
    return [line for line in lines if line.strip()]


@pytest.mark.parametrize("script", SCRIPTS)
def test_shell_script_is_sound(script):
    """Its syntax, its run bit, and that it stops at the first failure."""
    path = ROOT / script
    assert subprocess.run(["bash", "-n", path]).returncode == 0
    assert path.stat().st_mode & 0o111
    text = path.read_text()
    assert text.startswith("#!/usr/bin/env bash\n")
    assert "set -euo pipefail" in text or "\nexec " in text


@pytest.mark.parametrize("folder", LOCKS)
def test_lock_holds_every_required_package(folder):
    """With version and hashes. What is added to the main .venv has the versions that are there."""
    packages = locked_packages(folder)
    line = re.compile(r"[a-zA-Z0-9._-]+==\S+( ; [^;]+?)?( +--hash=sha256:[0-9a-f]{64})+ *")
    assert [package for package in packages if not line.fullmatch(package)] == []
    text = (ROOT / folder / "requirements.in").read_text()
    wanted = {name.lower() for name in re.findall(r"^([a-zA-Z][\w.-]*)", text, re.MULTILINE)}
    assert set() < wanted <= {package.split("==")[0].lower() for package in packages}
    if folder.startswith("profiles/"):
        main, added = (
            dict(re.findall(r"^(\S+)==(\S+)", "\n".join(lines), re.MULTILINE))
            for lines in (locked_packages("."), packages)
        )
        assert {name for name in main.keys() & added if main[name] != added[name]} == set()


def test_no_file_names_a_package_index():
    address = re.compile(
        r"(?<!no-emit)-index-url|find-links|trusted-host|PIP_INDEX|UV_INDEX|/simple\b|^deb(-src)? ",
        re.MULTILINE,
    )
    files = set(project_files()) - {"tests/test_setup.py"}
    texts = {name: (ROOT / name).read_text(errors="ignore") for name in files}
    assert [name for name, text in texts.items() if address.search(text)] == []
    locks = [text for name, text in texts.items() if name.endswith("requirements.lock")]
    assert "://" not in "".join(locks)


def test_continuous_integration_calls_the_tests():
    """And nothing else, in a container of each Debian that is supported. Images and actions are
    named by digest: a tag may be moved to other contents."""
    job = read(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["test"]
    images = job["strategy"]["matrix"]["image"]
    assert [re.match(r"debian:(\d+)", image)[1] for image in images] == ["12", "13"]
    recipe = (ROOT / "tools/containers" / "Containerfile").read_text()
    for image in [*images, *re.findall(r"^FROM (\S*/\S+)", recipe, re.MULTILINE)]:
        assert re.search("@sha256:[0-9a-f]{64}$", image)
    actions = [step["uses"] for step in job["steps"] if "uses" in step]
    assert actions
    assert all(re.search("@[0-9a-f]{40}$", action) for action in actions)
    assert {".ci/run", "./test long"} <= {step.get("run") for step in job["steps"]}
    assert (ROOT / ".ci" / "run").read_text().endswith('/../test"\n')


NUMBERS = {"threads"}
"""Names in braces whose values Snakemake itself makes, without characters of a shell."""
RULES = "".join(path.read_text() for path in [ROOT / "Snakefile", *ROOT.glob("rules/*.smk")])
COMMANDS = re.findall(r"^ +shell:\n((?: {8,}.*\n)+)", RULES, re.MULTILINE)


def unquoted(command: str) -> set[str]:
    """Names in braces without `:q`; doubled braces are for the shell."""
    names = re.findall(r"\{([^{}]*)\}", re.sub(r"\{\{|\}\}", "", command))
    return {name for name in names if not name.endswith(":q")} - NUMBERS


def test_commands_quote_paths_and_texts():
    """A folder may hold spaces, a file what a shell would run. Every command is looked at."""
    assert {command: unquoted(command) for command in COMMANDS if unquoted(command)} == {}
    assert len(COMMANDS) == len(re.findall(r"\bshell\b\s*[:(]", RULES)) > 2


def said_by(*command: str | Path, **options) -> tuple[int, str]:
    """Exit status of a command, and what it says."""
    together = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    run = subprocess.run(command, **together, **options)
    return run.returncode, run.stdout


def test_help_and_wrong_words(tmp_path):
    """From any folder, also through a link; ./test names its parts."""
    (tmp_path / "link").symlink_to(ROOT / "reproduce")
    status, words = said_by(tmp_path / "link", "--help", cwd=tmp_path)
    assert (status, "./reproduce [FILE.yaml] [TARGET...]" in words) == (0, True)
    status, words = said_by(ROOT / "test", "nonsense")
    parts = re.findall(r"^ +\./test (\w+)", (ROOT / "test").read_text(), re.MULTILINE)
    assert len(parts) == 8
    assert (status, [part for part in ["'nonsense'", *parts] if part not in words]) == (2, [])


def test_second_run_of_the_same_file_says_so(tmp_path):
    """A run holds a lock of the operating system, which ends with it."""
    shutil.copy(ROOT / "reproduce", tmp_path)
    write_script(tmp_path / "tools/setup/setup.sh", "exit 0")
    (tmp_path / ".snakemake").mkdir()
    with open(tmp_path / ".snakemake" / "run of the paper", "a") as run:
        fcntl.flock(run, fcntl.LOCK_EX)
        status, words = said_by(tmp_path / "reproduce")
    assert status == 1
    assert words.startswith("reproduce: another run of the paper is at work here; ")


@pytest.fixture
def bare(tmp_path) -> Path:
    """The set-up in a folder without anything else."""
    shutil.copytree(ROOT / "tools/setup", tmp_path / "bare/tools/setup")
    shutil.copy(ROOT / "requirements.lock", tmp_path / "bare")
    return tmp_path / "bare"


@pytest.mark.parametrize("character", list('${};"\\|<>: []\n\t'))
def test_folder_in_which_nothing_can_be_built_is_refused(bare, character):
    """At once: CMake, Make, Snakemake or PATH give the character a meaning of their own."""
    folder = bare.rename(bare.with_name(f"a{character}b"))
    status, words = said_by(folder / "tools/setup/setup.sh")
    assert (status, words.count("\n")) == (1, 1)
    named = str(folder).replace("\n", "\\n").replace("\t", "\\t")
    assert f"'{named}': a path without " in words
    assert {path.name for path in folder.iterdir()} == {"tools", "requirements.lock"}


def test_environment_that_is_a_link_is_refused(bare):
    """It may be that of another project."""
    (bare / "other").mkdir()
    (bare / ".venv").symlink_to("other")
    status, words = said_by(bare / "tools/setup/setup.sh")
    assert status == 1
    assert "set-up: .venv is a link; expected a folder" in words
    assert list((bare / "other").iterdir()) == []


def test_each_compiler_has_a_preset():
    """By the name of its package, which tools/compilers/run builds with."""
    presets = json.loads((ROOT / "fortran" / "CMakePresets.json").read_text())["configurePresets"]
    lists = [path.read_text() for path in ROOT.glob("tools/compilers/*/apt-packages.txt")]
    wanted = {*re.findall(r"^(?:gfortran|flang)-\S+", "\n".join(lists), re.MULTILINE)}
    assert set() < wanted <= {preset["name"] for preset in presets}

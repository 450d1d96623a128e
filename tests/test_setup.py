"""What sets up and starts the project, without setting anything up."""

import re
import subprocess
from pathlib import Path

import pytest
from conftest import ROOT, project_files

from scripts.config.read_config import read

SCRIPTS = [
    "reproduce",
    "test",
    "setup/setup.sh",
    ".ci/run",
    "benchmarks/run",
    "compilers/run",
]
LOCKS = {
    **{".": 10, "setup": 0, "benchmarks": 2, "docs": 0, "tests/browser": 1, "tests/formats": 0},
    "profiles/slurm": 0,
}
"""Folders with a lock of Python packages, and more than how many of them are named by hand."""


def run(*command: str, **options) -> subprocess.CompletedProcess[str]:
    """Run a command and keep what it says."""
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **options)


def locked_packages(folder: str) -> list[str]:
    """Each package of the lock with its hashes, as one line."""
    text = (ROOT / folder / "requirements.lock").read_text()
    lines = re.sub(r"\\\n", " ", re.sub(r"^\s*#.*\n", "", text, flags=re.MULTILINE)).splitlines()
    return [line for line in lines if line.strip()]


@pytest.mark.parametrize("script", SCRIPTS)
def test_shell_script_is_sound(script):
    """Its syntax, its run bit, and that it stops at the first failure."""
    path = ROOT / script
    assert run("bash", "-n", str(path)).returncode == 0
    assert path.stat().st_mode & 0o111
    text = path.read_text()
    assert text.startswith("#!/usr/bin/env bash\n")
    assert "set -euo pipefail" in text or "\nexec " in text


def test_container_runs_what_the_project_has():
    """The base has a version; every program and folder that a step names is there."""
    steps = (ROOT / "containers" / "Containerfile").read_text().replace("\\\n", " ")
    images = re.findall(r"^FROM (\S+)", steps, re.MULTILINE)
    assert re.match(r"docker\.io/library/debian:\d+\.\d+-slim@", images[0])
    assert set(images[1:]) == {"base"}
    assert re.findall(r'^CMD \["(.*)"\]', steps, re.MULTILINE) == ["./test", "./reproduce"]
    folders = re.findall(r"setup/setup\.sh (?!&)(\S+)", steps)
    assert folders
    assert [folder for folder in folders if not (ROOT / folder).is_dir()] == []


def test_container_leaves_out_what_git_ignores():
    """By the last part of each path."""

    def names_in(file: str) -> set[str]:
        lines = (ROOT / file).read_text().splitlines()
        return {Path(line).name for line in lines if line and not line.startswith("#")}

    assert names_in(".gitignore") == names_in(".dockerignore")


@pytest.mark.parametrize("folder", LOCKS)
def test_every_locked_package_has_version_and_hash(folder):
    """Nothing but `name==version` with sha256 hashes."""
    packages = locked_packages(folder)
    assert len(packages) > {".": 30, "setup": 0}.get(folder, 5)
    line = re.compile(r"[a-zA-Z0-9._-]+==\S+( ; [^;]+?)?( +--hash=sha256:[0-9a-f]{64})+ *")
    assert [package for package in packages if not line.fullmatch(package)] == []


@pytest.mark.parametrize("folder", LOCKS)
def test_lock_holds_every_required_package(folder):
    """What requirements.in names is locked."""
    text = (ROOT / folder / "requirements.in").read_text()
    wanted = {name.lower() for name in re.findall(r"^([a-zA-Z][\w.-]*)", text, re.MULTILINE)}
    locked = {package.split("==")[0].lower() for package in locked_packages(folder)}
    assert len(wanted) > LOCKS[folder]
    assert wanted <= locked


@pytest.mark.parametrize("folder", LOCKS)
def test_lock_names_no_address(folder):
    """Where packages come from is the user's business."""
    text = (ROOT / folder / "requirements.lock").read_text()
    assert not re.search(r"://|index-url|find-links|trusted-host", text)


def test_lock_of_the_profile_agrees_with_the_main_one():
    """Both fill one .venv: what both name has one version."""
    pins = [
        {line.partition(" ;")[0].split(" ")[0] for line in locked_packages(folder)}
        for folder in (".", "profiles/slurm")
    ]
    names = [{pin.split("==")[0] for pin in each} for each in pins]
    added = {pin for pin in pins[1] - pins[0] if pin.split("==")[0] in names[0]}
    assert added == set()
    assert names[1] - names[0] == {
        "snakemake-executor-plugin-slurm",
        "snakemake-executor-plugin-slurm-jobstep",
    }


def test_no_file_names_a_package_index():
    """Nor does any other file."""
    address = re.compile(
        r"(?<!no-emit)-index-url|find-links|trusted-host|PIP_INDEX|UV_INDEX|/simple\b|^deb(-src)? ",
        re.MULTILINE,
    )
    files = set(project_files()) - {"tests/test_setup.py"}
    texts = {name: (ROOT / name).read_text(errors="ignore") for name in files}
    assert len(texts) > 50
    assert [name for name, text in texts.items() if address.search(text)] == []


@pytest.mark.parametrize("folder", ["setup", "benchmarks", "tests/browser", "tests/slurm"])
def test_apt_list_is_sorted_out(folder):
    """One Debian package a line, none twice."""
    text = (ROOT / folder / "apt-packages.txt").read_text()
    packages = [line for line in re.sub(r"#.*", "", text).split("\n") if line.strip()]
    assert len(packages) > (10 if folder == "setup" else 1)
    assert len(packages) == len(set(packages))
    assert all(re.fullmatch(r"[a-z0-9][a-z0-9+.-]+", package) for package in packages)


def test_test_names_its_parts():
    """An unknown part is refused before anything is set up."""
    result = run(str(ROOT / "test"), "nonsense")
    assert result.returncode == 2
    assert result.stdout == ""
    assert "'nonsense'" in result.stderr
    assert all(
        part in result.stderr
        for part in ("quick", "lint", "fortran", "python", "long", "compilers", "slurm")
    )


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_reproduce_says_how_it_is_used(option, tmp_path):
    """From any folder, before anything is set up."""
    result = run(str(ROOT / "reproduce"), option, cwd=tmp_path)
    assert result.returncode == 0
    assert "./reproduce [FILE.yaml] [TARGET...]" in result.stdout
    assert "./test" in result.stdout


def test_images_and_actions_are_named_by_digest():
    """A tag may be moved to other contents."""
    recipe = (ROOT / "containers" / "Containerfile").read_text()
    images = re.findall(r"^FROM (\S*/\S+)", recipe, re.MULTILINE)
    job = read(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["test"]
    images += job["strategy"]["matrix"]["image"]
    assert len(images) == 3
    assert all(re.search("@sha256:[0-9a-f]{64}$", image) for image in images)
    actions = [step["uses"] for step in job["steps"] if "uses" in step]
    assert actions
    assert all(re.search("@[0-9a-f]{40}$", action) for action in actions)


def test_continuous_integration_calls_the_tests():
    """And nothing else; the hosted one does so in a container of each Debian that is supported."""
    job = read(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["test"]
    images = job["strategy"]["matrix"]["image"]
    assert [re.match(r"debian:(\d+)", image)[1] for image in images] == ["12", "13"]
    assert {".ci/run", "./test long"} <= {step.get("run") for step in job["steps"]}
    lines = (ROOT / ".ci" / "run").read_text().splitlines()
    assert [line for line in lines if line and not line.startswith("#")] == [
        'exec "$(dirname "$(readlink -f "$0")")/../test"'
    ]

"""What sets up and starts the project, without setting anything up."""

import re
import subprocess

import pytest

from conftest import ROOT, project_files
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

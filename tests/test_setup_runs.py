"""The set-up, with stand-ins for what would install something."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from conftest import ROOT, write_script

NOBODY = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] * (os.geteuid() == 0)
"""Another user than root."""
ASKED = "sudo apt-get install -y --no-install-recommends cmake gfortran\n"


@pytest.fixture
def bare() -> Iterator[Path]:
    """The set-up in a folder that any user may read, with tools that pretend: all packages are
    there, and .venv was made from this lock in this folder."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        shutil.copytree(ROOT / "tools/setup", folder / "tools/setup")
        shutil.copy(ROOT / "requirements.lock", folder)
        pretend_installed(folder, debian_packages())
        write_script(folder / "bin" / "dpkg-query", f"cat '{folder}/installed'")
        write_script(folder / "bin" / "dpkg", "exit 0")
        write_script(folder / "bin" / "sudo", '[[ $1 == -n ]] && shift; exec "$@"')
        calls = f"echo \"$*\" >>'{folder}/calls'"
        write_script(folder / "bin" / "apt-get", f"{calls}; [[ $1 == update ]]")
        write_script(folder / ".venv" / "bin" / "python", calls)
        files = "tools/setup/requirements.lock requirements.lock tools/setup/setup.sh"
        noted = f"(sha256sum {files}; /usr/bin/python3 --version; pwd) >.venv/made-from"
        subprocess.run(["bash", "-c", noted], cwd=folder, check=True)
        yield folder


def set_up_in(folder: Path, *before: str, part: tuple[str, ...] = ()) -> tuple[int, str]:
    """Exit status and words of the set-up of a folder, for all or for a part."""
    run = subprocess.run(
        [*before, folder / "tools/setup/setup.sh", *part],
        env={**os.environ, "PATH": f"{folder}/bin:/usr/bin:/bin", "PIP_NO_INDEX": "1"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    assert run.stdout == ""
    return run.returncode, run.stderr


def calls_in(folder: Path) -> list[str]:
    """What was asked of the tools that would install something."""
    calls = folder / "calls"
    return calls.read_text().splitlines() if calls.exists() else []


def debian_packages(folder: str = "tools/setup") -> list[str]:
    text = (ROOT / folder / "apt-packages.txt").read_text()
    return sorted({line for line in text.split("\n") if line and not line.startswith("#")})


def pretend_installed(folder: Path, packages: list[str]) -> None:
    (folder / "installed").write_text("".join(f"{package} installed\n" for package in packages))


def test_set_up_that_is_complete_does_nothing(bare):
    """No word, no call; but a build that holds the paths of another folder is dropped."""
    assert set_up_in(bare) == (0, "")
    (bare / "fortran").mkdir()
    for name, source in (("moved", "/elsewhere/fortran"), ("own", f"{bare}/fortran")):
        (bare / "build" / name).mkdir(parents=True)
        cache = bare / "build" / name / "CMakeCache.txt"
        cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={source}\n")
    assert set_up_in(bare)[0] == 0
    assert [path.name for path in (bare / "build").iterdir()] == ["own"]
    assert calls_in(bare) == []


def test_only_missing_packages_are_installed(bare):
    """As root or with sudo, without what is only recommended; a half-installed one is missing. Who
    may not install is asked for them, and so is who cannot."""
    wanted = debian_packages()
    pretend_installed(bare, [name for name in wanted if name not in ("cmake", "gfortran")])
    with open(bare / "installed", "a") as listed:
        listed.write("cmake half-configured\n")
    status, said = set_up_in(bare)
    assert (status, ASKED in said) == (1, True)
    update, install = calls_in(bare)
    assert update.startswith("update")
    assert "--no-install-recommends" in install
    assert install.endswith(" cmake gfortran")
    write_script(bare / "bin" / "sudo", "exit 1")
    status, said = set_up_in(bare, *NOBODY)
    assert (status, ASKED in said) == (1, True)
    assert len(calls_in(bare)) == 2


def test_packages_of_a_profile_are_added(bare):
    """To .venv as it is, once; a .venv made anew gets them again."""
    profile = bare / "profiles" / "slurm"
    shutil.copytree(ROOT / "profiles" / "slurm", profile)
    for _ in range(2):
        assert set_up_in(bare, part=("profiles/slurm",))[0] == 0
    build_tool, added = calls_in(bare)
    assert "pip install" in added
    assert build_tool.endswith("--require-hashes -r tools/setup/requirements.lock")
    assert added.endswith("--require-hashes -r profiles/slurm/requirements.lock")
    assert "--no-build-isolation" in added
    (bare / ".venv" / "made-from-slurm").unlink()
    assert set_up_in(bare, part=("profiles/slurm",))[0] == 0
    assert len(calls_in(bare)) == 4


def test_folder_that_cannot_be_filled_is_refused(bare):
    """A .venv that is a link, to that of another project; a folder that is closed to writing."""
    (bare / ".venv").rename(bare / "other")
    (bare / ".venv").symlink_to("other")
    (bare / "other" / "made-from").unlink()
    status, said = set_up_in(bare)
    assert status == 1
    assert said.splitlines()[-1].startswith("set-up: .venv is a link; expected a folder")
    assert (bare / "other" / "bin" / "python").exists()
    (bare / ".setup.lock").unlink()
    bare.chmod(0o555)
    status, said = set_up_in(bare, *NOBODY)
    bare.chmod(0o755)
    assert status == 1
    (line,) = said.splitlines()
    assert line.startswith(f"set-up: nothing can be written in {bare}; see that it is on no read-")


def test_folder_in_which_nothing_can_be_built_is_refused(bare):
    """At once: CMake, Make, Snakemake or PATH give the character a meaning of their own. The others
    were tried with a build and a run."""
    for character in [*'${};"\\|<>: []\n\t', "#%=()&*?~'!@,+`^é"]:
        folder = bare / f"a{character}b"
        for name in ("tools", "bin"):
            shutil.copytree(bare / name, folder / name)
        status, said = set_up_in(folder)
        assert ("cannot work in" in said) == (len(character) == 1)
        if len(character) == 1:
            assert (status, len(said.splitlines())) == (1, 1)
            named = str(folder).replace("\n", "\\n").replace("\t", "\\t")
            assert f"'{named}': a path without " in said
            assert {path.name for path in folder.iterdir()} == {"tools", "bin"}


def test_each_compiler_has_a_preset():
    """By the name of its package, which tools/compilers/run builds with."""
    presets = json.loads((ROOT / "fortran" / "CMakePresets.json").read_text())["configurePresets"]
    names = {preset["name"] for preset in presets}
    lists = [path.parent for path in ROOT.glob("tools/compilers/*/apt-packages.txt")]
    wanted = {name for folder in lists for name in debian_packages(str(folder.relative_to(ROOT)))}
    assert {name for name in wanted if re.match("(gfortran|flang)-", name)} <= names

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

NOBODY = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
"""Another user than root."""
if os.geteuid() != 0:
    NOBODY = []


@pytest.fixture
def bare() -> Iterator[Path]:
    """The set-up in a folder that any user may read, with tools that pretend."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        shutil.copytree(ROOT / "setup", folder / "setup")
        shutil.copy(ROOT / "requirements.lock", folder)
        write_script(folder / "bin" / "dpkg-query", f"cat '{folder}/installed'")
        write_script(folder / "bin" / "dpkg", "exit 0")
        write_script(folder / "bin" / "sudo", '[[ $1 == -n ]] && shift; exec "$@"')
        yield folder


def set_up_in(
    folder: Path, *before: str, part: tuple[str, ...] = ()
) -> subprocess.CompletedProcess[str]:
    """Run the set-up with the tools that pretend, in the folder, for all or for a part."""
    return subprocess.run(
        [*before, folder / "setup" / "setup.sh", *part],
        env={**os.environ, "PATH": f"{folder}/bin:/usr/bin:/bin", "PIP_NO_INDEX": "1"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )


def debian_packages(folder: str = "setup") -> list[str]:
    text = (ROOT / folder / "apt-packages.txt").read_text()
    return sorted({line for line in text.split("\n") if line and not line.startswith("#")})


def made_from(folder: Path) -> str:
    """What the set-up notes of the .venv that it made there."""
    files = "setup/requirements.lock requirements.lock setup/setup.sh"
    command = f"sha256sum {files}; /usr/bin/python3 --version; pwd"
    run = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True)
    return run.stdout


def pretend_installed(folder: Path, packages: list[str]) -> None:
    (folder / "installed").write_text("".join(f"{package} installed\n" for package in packages))


def test_missing_packages_without_root_are_asked_for(bare):
    wanted = debian_packages()
    pretend_installed(bare, [name for name in wanted if name not in ("cmake", "gfortran")])
    write_script(bare / "bin" / "sudo", "exit 1")
    run = set_up_in(bare, *NOBODY)
    assert run.returncode == 1
    assert "sudo apt-get install -y --no-install-recommends cmake gfortran\n" in run.stderr
    assert not (bare / ".venv").exists()


def test_each_compiler_has_a_preset():
    """By the name of its package, which compilers/run builds with."""
    presets = json.loads((ROOT / "fortran" / "CMakePresets.json").read_text())["configurePresets"]
    names = {preset["name"] for preset in presets}
    lists = [path.parent for path in ROOT.glob("compilers/*/apt-packages.txt")]
    wanted = {name for folder in lists for name in debian_packages(str(folder.relative_to(ROOT)))}
    assert {name for name in wanted if re.match("(gfortran|flang)-", name)} <= names


def test_packages_of_a_profile_are_added(bare):
    """To .venv as it is, once; a .venv made anew gets them again."""
    pretend_installed(bare, debian_packages())
    (bare / "profiles" / "slurm").mkdir(parents=True)
    shutil.copy(ROOT / "profiles" / "slurm" / "requirements.lock", bare / "profiles" / "slurm")
    write_script(bare / ".venv" / "bin" / "python", f"echo \"$*\" >>'{bare}/calls'")
    (bare / ".venv" / "made-from").write_text(made_from(bare))
    for _ in range(2):
        run = set_up_in(bare, part=("profiles/slurm",))
        assert run.returncode == 0, run.stderr
    build_tool, added = (bare / "calls").read_text().splitlines()
    assert "pip install" in added
    assert build_tool.endswith("--require-hashes -r setup/requirements.lock")
    assert added.endswith("--require-hashes -r profiles/slurm/requirements.lock")
    assert "--no-build-isolation" in added
    (bare / ".venv" / "made-from-slurm").unlink()
    assert set_up_in(bare, part=("profiles/slurm",)).returncode == 0
    assert len((bare / "calls").read_text().splitlines()) == 4


@pytest.mark.parametrize("character", list('${};"\\|<>: []\n\t'))
def test_folder_in_which_nothing_can_be_built_is_refused(tmp_path, character):
    """At once: CMake, Make, Snakemake or PATH give the character a meaning of their own."""
    folder = tmp_path / f"a{character}b"
    shutil.copytree(ROOT / "setup", folder / "setup")
    run = subprocess.run([folder / "setup" / "setup.sh"], capture_output=True, text=True)
    assert run.returncode == 1
    (line,) = run.stderr.splitlines()
    named = str(folder).replace("\n", "\\n").replace("\t", "\\t")
    assert re.match(f"set-up: cannot work in .?'{re.escape(named)}': a path without ", line)
    assert [path.name for path in folder.iterdir()] == ["setup"]


def test_read_only_folder_is_told(bare):
    pretend_installed(bare, debian_packages())
    bare.chmod(0o555)
    run = set_up_in(bare, *NOBODY)
    bare.chmod(0o755)
    assert run.returncode == 1
    (line,) = run.stderr.splitlines()
    assert line.startswith(
        f"set-up: nothing can be written in {bare}; see that it is on no read-only"
    )


def test_only_missing_packages_are_installed(bare):
    """As root or with sudo, without what is only recommended; a half-installed one is missing."""
    wanted = debian_packages()
    pretend_installed(bare, [name for name in wanted if name not in ("cmake", "gfortran")])
    with open(bare / "installed", "a") as listed:
        listed.write("cmake half-configured\n")
    write_script(bare / "bin" / "apt-get", f'echo "$*" >>"{bare}/calls"; [[ $1 == update ]]')
    run = set_up_in(bare)
    assert run.returncode == 1
    update, install = (bare / "calls").read_text().splitlines()
    assert update.startswith("update")
    assert "--no-install-recommends" in install
    assert install.endswith(" cmake gfortran")
    assert "sudo apt-get install -y --no-install-recommends cmake gfortran\n" in run.stderr


def test_set_up_that_is_complete_does_nothing(bare):
    """All packages there, .venv made from this lock in this folder: no word, no call."""
    pretend_installed(bare, debian_packages())
    write_script(bare / ".venv" / "bin" / "python", "exit 0")
    (bare / ".venv" / "made-from").write_text(made_from(bare))
    write_script(bare / "bin" / "apt-get", f"touch '{bare}/called'")
    run = set_up_in(bare)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert not (bare / "called").exists()


def test_build_of_another_folder_is_dropped(bare):
    """It holds the paths of that folder; a build of this one stays."""
    pretend_installed(bare, [])
    write_script(bare / "bin" / "apt-get", "exit 1")
    (bare / "fortran").mkdir()
    for name, source in (("moved", "/elsewhere/fortran"), ("own", f"{bare}/fortran")):
        (bare / "build" / name).mkdir(parents=True)
        cache = bare / "build" / name / "CMakeCache.txt"
        cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={source}\n")
    set_up_in(bare)
    assert [path.name for path in (bare / "build").iterdir()] == ["own"]


def test_linked_packages_are_not_emptied(bare):
    """A .venv that is a link to that of another project."""
    pretend_installed(bare, debian_packages())
    (bare / "other").mkdir()
    (bare / "other" / "kept").touch()
    (bare / ".venv").symlink_to("other")
    run = set_up_in(bare)
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1].startswith("set-up: .venv is a link; expected a folder")
    assert (bare / "other" / "kept").exists()


def test_folder_in_which_a_build_works_is_accepted(bare):
    """Each of these characters was tried with a build and a run."""
    pretend_installed(bare, [])
    write_script(bare / "bin" / "apt-get", "exit 1")
    folder = bare / "a#%=()&*?~'!@,+`^éb"
    shutil.copytree(bare / "setup", folder / "setup")
    shutil.copytree(bare / "bin", folder / "bin")
    assert "cannot work in" not in set_up_in(folder).stderr

"""The solver outside this project: installed, found, and built by a project of others."""

import os
import platform
import re
import shutil
import subprocess
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "fortran" / "dde"
OUTSIDE = Path(__file__).parent / "outside_project"
"""Built by CMake, by fpm, and by a compiler alone."""
TOLERANCE = 1e-9
"""Of the outside project: the default of the solver."""


def run(*command, **settings) -> str:
    """What a command prints; its whole output where it fails."""
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, **settings)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def largest_error(printed: str) -> float:
    return float(re.search(r"largest error +(\S+)", printed)[1])


def test_version_stands_once(installed):
    """In fpm.toml; what is installed and the change log follow."""
    version = re.search(r'^version = "(.*)"$', (PACKAGE / "fpm.toml").read_text(), re.MULTILINE)[1]
    assert version not in (PACKAGE / "CMakeLists.txt").read_text()
    [found] = installed.rglob("dde-config-version.cmake")
    assert f'PACKAGE_VERSION "{version}"' in found.read_text()
    changes = (PACKAGE / "CHANGELOG.md").read_text()
    assert re.search(r"^## (\S+?),? ", changes, re.MULTILINE)[1] == version


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    """Folder of an installed copy; its sources and its build are gone."""
    folder = tmp_path_factory.mktemp("solver")
    source = shutil.copytree(PACKAGE, folder / "source")
    prefix = folder / "prefix"
    run("cmake", "-D", "DDE_TESTS=OFF", "-S", source, "-B", folder / "build")
    run("cmake", "--build", folder / "build")
    run("cmake", "--install", folder / "build", "--prefix", prefix)
    shutil.rmtree(source)
    shutil.rmtree(folder / "build")
    return prefix


def test_cmake_finds_it(installed, tmp_path):
    """In a project whose modules and targets have names that this project has, too."""
    where = [f"-DCMAKE_PREFIX_PATH={installed}"]
    run("cmake", *where, "-S", OUTSIDE, "-B", tmp_path)
    run("cmake", "--build", tmp_path)
    assert "100% tests passed" in run("ctest", "--test-dir", tmp_path)
    assert largest_error(run(tmp_path / "tester")) < 100 * TOLERANCE


def compiler_flags(prefix: Path) -> str:
    [folder] = [path.parent for path in prefix.rglob("dde.pc")]
    environment = {**os.environ, "PKG_CONFIG_PATH": str(folder)}
    return run("pkg-config", "--cflags", "--libs", "dde", env=environment)


def test_bounds_are_checked_where_the_manual_says(installed, tmp_path):
    """A second delayed value, where there is one delay, is named with -fcheck=bounds."""
    source = (PACKAGE / "example" / "mackey_glass.f90").read_text()
    assert source.count("0.2_wp*z/") == 1
    (tmp_path / "mine.f90").write_text(source.replace("0.2_wp*z/", "0.2_wp*z(2)/"))
    command = f"gfortran -fcheck=bounds mine.f90 -o mine {compiler_flags(installed)}"
    run("sh", "-c", command, cwd=tmp_path)
    ended = subprocess.run([tmp_path / "mine"], capture_output=True, text=True, timeout=60)
    assert ended.returncode != 0
    assert "Index '2' of dimension 1 of array 'z' above upper bound of 1" in ended.stderr


def test_pkg_config_finds_it(installed, tmp_path):
    """Flags for a compiler without a build system."""
    sources = [OUTSIDE / f"{name}.f90" for name in ("src/kinds", "src/errors", "app/main")]
    words = " ".join(f'"{path}"' for path in sources)
    run("sh", "-c", f"gfortran {words} -o mine {compiler_flags(installed)}", cwd=tmp_path)
    assert largest_error(run(tmp_path / "mine")) < 100 * TOLERANCE


def test_fpm_builds_it(tmp_path):
    """From a copy of its folder alone."""
    shutil.copytree(PACKAGE, tmp_path / "dde")
    shutil.copytree(OUTSIDE, tmp_path / "mine")
    printed = run("fpm", "run", cwd=tmp_path / "mine")
    assert largest_error(printed) < 100 * TOLERANCE
    assert "1.060954363" in run("fpm", "run", "--example", "--all", cwd=tmp_path / "dde")


@pytest.mark.skipif(platform.machine() != "x86_64", reason="other processors have other bits")
def test_five_problems_cost_what_the_manual_says(installed, tmp_path):
    source = PACKAGE / "example" / "delay_problems.f90"
    run("sh", "-c", f'gfortran "{source}" -o mine {compiler_flags(installed)}', cwd=tmp_path)
    assert run(tmp_path / "mine") in (PACKAGE / "README.md").read_text()


@pytest.mark.long
def test_references_agree_in_quadruple_precision(tmp_path):
    """By two methods, and with those that the program holds."""
    run("cmake", "-D", "DDE_QUAD=ON", "-S", PACKAGE, "-B", tmp_path)
    run("cmake", "--build", tmp_path, "--target", "dde_delay_problems")
    run(tmp_path / "dde_delay_problems")


@pytest.mark.long
def test_its_own_tests_pass(tmp_path):
    """From its folder alone."""
    build = tmp_path / "build"
    run("cmake", "-S", PACKAGE, "-B", build)
    run("cmake", "--build", build, "--parallel", "2")
    run("ctest", "--test-dir", build)


def test_it_stays_quiet_in_another_project(tmp_path):
    """As a folder of it: its tests and its installation stay away."""
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.18)\n"
        "project(mine LANGUAGES Fortran)\n"
        "include(CTest)\n"
        f'add_subdirectory("{PACKAGE}" solver)\n'
    )
    build = tmp_path / "build"
    run("cmake", "-S", tmp_path, "-B", build)
    assert "Total Tests: 0" in run("ctest", "--show-only", "--test-dir", build)
    assert "file(INSTALL" not in (build / "solver" / "cmake_install.cmake").read_text()

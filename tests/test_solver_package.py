"""The solver outside this project: installed, found, and built by a project of others; programs of
its manual."""

import math
import os
import platform
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from test_documents import blocks_of, prose_of

PACKAGE = Path(__file__).parent.parent / "fortran" / "dde"
OUTSIDE = Path(__file__).parent / "outside_project"
"""Built by CMake, by fpm, and by a compiler alone."""
MANUAL = "fortran/dde/README.md"
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


def with_procedures(source: str, *procedures: str) -> str:
    """The second program of the manual with more procedures in its type."""
    names = re.findall(r"^pure subroutine (\w+)", "\n".join(procedures), re.MULTILINE)
    grown = source.replace("rhs\n   end type", f"rhs, {', '.join(names)}\n   end type")
    grown = grown.replace("end module", "\n".join([*procedures, "end module"]), 1)
    return grown.replace("delayed_sine(n=1,", "delayed_sine(analytic=.true., n=1,")


def test_values_in_the_manual():
    """The example, which the solver's own tests run, has the published values."""
    printed = re.findall(r"y\((\d+)\) = (\d+\.\d+)", prose_of(MANUAL))
    # as in fortran/dde/test/suites/test_dde_accuracy.f90
    assert printed == [("50", f"{1.060954362898:.6f}"), ("200", f"{1.186718107117:.6f}")]


@pytest.mark.parametrize(
    ("method", "added"), [("auto", ()), ("taylor", (1, 2)), ("radau9", (1, 2))]
)
def test_second_program_of_the_manual(installed, tmp_path, method, added):
    """By flags of pkg-config. Maxima of sin t, and its values after going on, to 100 x tolerance;
    also with the procedures that the manual adds, linked without optimisation across modules."""
    blocks = blocks_of(MANUAL, "fortran")
    source = blocks[0].replace('method="auto"', f'method="{method}"')
    if added:
        source = with_procedures(source, *(blocks[i] for i in added))
    (tmp_path / "mine.f90").write_text(source)
    flags = ("-fno-lto " if added else "") + compiler_flags(installed)
    run("sh", "-c", f"gfortran mine.f90 -o mine {flags}", cwd=tmp_path)
    lines = run(tmp_path / "mine").splitlines()
    maxima = [float(line.split()[-1]) for line in lines if line.startswith("maximum")]
    assert maxima == pytest.approx([math.pi / 2, 5 * math.pi / 2, 9 * math.pi / 2], abs=2e-8)
    values = dict(map(float, line.split()) for line in lines if re.match(r"\d", line))
    assert values == pytest.approx({t: math.sin(t) for t in (16.0, 18.0, 20.0)}, abs=1e-8)
    assert lines[-1].split()[0] == "T"


def test_fpm_builds_it(tmp_path):
    """From a copy of its folder alone."""
    shutil.copytree(PACKAGE, tmp_path / "dde")
    shutil.copytree(OUTSIDE, tmp_path / "mine")
    assert largest_error(run("fpm", "run", cwd=tmp_path / "mine")) < 100 * TOLERANCE


@pytest.mark.skipif(platform.machine() != "x86_64", reason="other processors have other bits")
def test_five_problems_cost_what_the_manual_says(installed, tmp_path):
    source = PACKAGE / "example" / "delay_problems.f90"
    flags = f"-fno-lto {compiler_flags(installed)}"
    run("sh", "-c", f'gfortran "{source}" -o mine {flags}', cwd=tmp_path)
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
    """As a folder of it, in the way of the manual: its tests and its installation stay away."""
    project = blocks_of(MANUAL, "cmake")[0].replace("\nset(DDE", "\ninclude(CTest)\nset(DDE", 1)
    (tmp_path / "CMakeLists.txt").write_text(project)
    (tmp_path / "mackey_glass.f90").touch()
    build = tmp_path / "build"
    run("cmake", "-S", tmp_path, "-B", build, "-D", f"DDE={PACKAGE}")
    assert "Total Tests: 0" in run("ctest", "--show-only", "--test-dir", build)
    assert "file(INSTALL" not in (build / "dde" / "cmake_install.cmake").read_text()

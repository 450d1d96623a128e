"""What is built is the same wherever it is built, and takes nothing from the system by chance."""

import os
import re
import subprocess

from conftest import ROOT


def test_program_has_the_same_bytes_wherever_it_is_built(smoke, binaries):
    """So that a folder that was moved computes nothing again; no program names its folder."""
    made = [*binaries.iterdir(), *binaries.parent.glob("models*/*.so")]
    assert {path.name for path in binaries.iterdir()} == {"spring_block", "spring_block_quad"}
    assert [path for path in made if bytes(ROOT) in path.read_bytes()] == []
    elsewhere = (smoke.folder / "build" / "release" / "bin" / "spring_block_quad").read_bytes()
    assert bytes(smoke.folder) not in elsewhere
    assert elsewhere == (binaries / "spring_block_quad").read_bytes()


def test_no_lapack_of_the_system_is_used(binaries):
    """OpenBLAS, under the same name, gives other last bits, by the number of its threads."""
    listed = subprocess.run(["ldd", binaries / "spring_block"], capture_output=True, text=True)
    assert "libnetcdff" in listed.stdout
    assert not re.search("lib(lapack|blas|openblas)", listed.stdout)


SMALL_PROJECT = f"""
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES Fortran)
include("{ROOT}/fortran/touch_changed.cmake")
add_executable(small small.f90)
"""


def test_changed_source_with_an_old_time_is_compiled_again(tmp_path):
    """As an upgrade that keeps times leaves it; a source that is the same is not touched."""
    (tmp_path / "CMakeLists.txt").write_text(SMALL_PROJECT)
    for name in ("small", "same"):
        (tmp_path / f"{name}.f90").touch()
    for word in ("one", "two"):
        (tmp_path / "small.f90").write_text(f"print '(a)', '{word}'\nend\n")
        for path in tmp_path.glob("*.f90"):
            os.utime(path, (1.5e9, 1.5e9))
        for command in (["-S", ".", "-B", "build"], ["--build", "build"]):
            subprocess.run(["cmake", *command], cwd=tmp_path, check=True, capture_output=True)
        said = subprocess.run([tmp_path / "build" / "small"], capture_output=True, text=True)
        assert said.stdout == f"{word}\n"
    assert (tmp_path / "same.f90").stat().st_mtime == 1.5e9

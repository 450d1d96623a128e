# SPDX-License-Identifier: BSD-3-Clause
"""What is installed, and its interface for callers in C."""

import math
import re
import subprocess
from importlib import metadata
from pathlib import Path

import delaykit as dk
import numpy as np
import pytest
from delaykit import library

HERE = Path(__file__).parent
PACKAGE = Path(dk.__file__).parent
RUNTIME = {"libgcc_s", "libgfortran", "libquadmath"}
"""Of gfortran; LAPACK is linked in, or is a library of its own."""
SYSTEM = {"linux-vdso", "ld-linux", "libc", "libdl", "libm"}


@pytest.mark.skipif((PACKAGE / "__init__.py").is_symlink(), reason="linked, not installed")
def test_only_the_package_is_installed():
    """With what a model is compiled of, and nothing else of the tree."""
    names = [str(path) for path in metadata.files("delaykit") if path.suffix != ".pyc"]
    tops = {re.match(r"delaykit(-[\d.]+\.dist-info)?/", name) is not None for name in names}
    assert tops == {True}
    inside = {name.partition("/")[2] for name in names}
    wanted = {"libdelaykit.so", "delaykit.h", "py.typed", "generator/model.f90.jinja"}
    wanted |= {"generator/fortran/shared/model_border.f90", "fortran/dde/src/base/dde_kinds.f90"}
    assert wanted <= inside
    assert [name for name in inside if re.search(r"test|CMake|\.md$|\.c$", name)] == []


def test_the_version_is_that_of_the_metadata():
    assert dk.__version__ == metadata.version("delaykit")


def test_gfortran_s_runtime_is_the_only_library():
    listed = subprocess.run(["ldd", library.PATH], capture_output=True, text=True, check=True)
    names = re.findall(r"^\s*(?:/\S*/)?([\w-]+?)(?:-x86-64)?\.so", listed.stdout, re.MULTILINE)
    assert "libgfortran" in names
    assert set(names) <= RUNTIME | SYSTEM | {"liblapack", "libblas"}


def test_a_library_that_cannot_be_loaded(monkeypatch, tmp_path):
    """As where gfortran is not installed."""
    monkeypatch.setattr(library, "PATH", tmp_path / "libdelaykit.so")
    with pytest.raises(ImportError, match=r"libdelaykit.so: cannot open .* install gfortran"):
        library.load()


def test_ikeda_s_equation_from_c(tmp_path):
    """Up to t = tau the delayed state is 1; pi/2 is at rest, and disturbances decay at rate 1."""
    model = dk.Model({"y": "-y + mu*sin(y(t - tau))"}, {"mu": 1, "tau": 1}, name="ikeda")
    program = tmp_path / "ikeda"
    libraries = [library.PATH, f"-Wl,-rpath,{library.PATH.resolve().parent}", "-lm"]
    warnings = ["-Wall", "-Wextra", "-Werror", "-std=c99"]
    sources = [f"-I{PACKAGE}", HERE / "ikeda.c", *libraries]
    subprocess.run(["cc", *warnings, *sources, "-o", program], check=True)
    ended = subprocess.run([program, model.path], capture_output=True, text=True, check=True)
    t, y = np.array(ended.stdout.split(), float).reshape(-1, 2).T
    force = math.pi / 2 * math.sin(1)
    np.testing.assert_array_equal(t, [3, 60])
    np.testing.assert_allclose(y, [force + (1 - force) * math.exp(-3), math.pi / 2], rtol=1e-8)
    failed = subprocess.run([program, "none.so"], capture_output=True, text=True, check=False)
    assert (failed.returncode, failed.stdout) == (1, "")
    assert "none.so: cannot be opened" in failed.stderr


def test_doses_may_be_a_dict_and_one_exponent_asked_for(mackey_glass, sine):
    pair, table = (
        mackey_glass.integrate(1.2, 3, doses=doses, t_eval=[3]).y
        for doses in ([(0.3, {"y": 1})], {0.3: {"y": 1}})
    )
    assert pair == table
    assert abs(sine.exponents(1, 1, t_end=400).value.item()) < 1e-3

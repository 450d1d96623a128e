# SPDX-License-Identifier: BSD-3-Clause
"""The shared object of a model: its module, compiled with what all models share."""

import shutil
import subprocess
import tempfile
from pathlib import Path

from .module import SUPPORT

KINDS = Path(__file__).parents[1] / "fortran" / "dde" / "src" / "base" / "dde_kinds.f90"
SHARED = ("model_border", "nilpotent_numbers", "nilpotent_functions", "steady_states")
"""What is compiled with a model that uses it, in this order."""
COMPILER = "gfortran"
FLAGS = (
    "-O2 -std=f2018 -ffp-contract=off -fno-tree-slp-vectorize -frecursive -fstack-arrays"
    " -fno-semantic-interposition -ffree-line-length-none"
)
"""Short work arrays live on the stack; the rest is explained in fortran/CMakeLists.txt."""


class CompileError(Exception):
    """The compiler failed."""


def compile_module(text: str, path: Path, compiler: str = COMPILER, flags: str = FLAGS) -> None:
    """Compile the text of a module; the object is complete or absent, the module stands beside it.

    It is in quadruple precision if the name of its folder ends with "_quad".

    The compiler sees file names alone, so that the object has the same bytes wherever it is made.
    """
    path = path.resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        kinds = KINDS.read_text(encoding="utf-8")
        if path.parent.name.endswith("_quad"):
            kinds = kinds.replace("real64", "real128")
        Path(folder, KINDS.name).write_text(kinds, encoding="utf-8")
        shared = [f"{name}.f90" for name in SHARED if f"use {name}," in text]
        for name in shared:
            shutil.copy(SUPPORT / "shared" / name, folder)
        Path(folder, "model.f90").write_text(text, encoding="utf-8")
        names = [KINDS.name, *shared, "model.f90"]
        command = [compiler, *flags.split(), "-fPIC", "-shared", "-Wl,-Bsymbolic,-s"]
        made = subprocess.run(
            [*command, *names, "-o", "model.so"], cwd=folder, capture_output=True, text=True
        )
        if made.returncode:
            raise CompileError(f"{path}: {compiler} failed:\n{made.stderr}")
        Path(folder, "model.f90").replace(path.with_suffix(".f90"))
        Path(folder, "model.so").replace(path)

# SPDX-License-Identifier: BSD-3-Clause
"""Compiled models, kept in the user's cache by a digest of all that they are made of."""

import functools
import hashlib
import json
import os
import shutil
import subprocess
from pathlib import Path

from delaykit.errors import CompilerError, ModelError

COMPILER = os.environ.get("DELAYKIT_COMPILER", "gfortran")
ADVICE = (
    "a Fortran compiler is needed once for each model; install gfortran, for instance by "
    "`apt install gfortran`, `brew install gcc` or `conda install gfortran`"
)


def cache() -> Path:
    """The folder of compiled models: DELAYKIT_CACHE, or delaykit in the user's cache."""
    if own := os.environ.get("DELAYKIT_CACHE"):
        return Path(own)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "delaykit"


@functools.cache
def compiler_version(compiler: str) -> str:
    """What a compiler says of itself."""
    if shutil.which(compiler) is None:
        raise CompilerError(f"{compiler}: not found; {ADVICE}")
    said = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=False)
    if said.returncode:
        raise CompilerError(f"{compiler} --version failed: {said.stderr.strip()}; {ADVICE}")
    return said.stdout.partition("\n")[0]


@functools.cache
def generator_digest() -> bytes:
    """A digest of all that makes a module from a definition, and of what it is compiled with."""
    folder = Path(__file__).parent / "generator"
    files = sorted(path for path in folder.rglob("*") if path.suffix in {".py", ".f90", ".jinja"})
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).digest()


def compiled(definition: dict, extent: str) -> Path:
    """The object of a definition, made now unless it is in the cache.

    extent: "equations" alone, with their "jacobian", or "whole". Two processes may make the same
    one: each writes its own file and gives it the name then.
    """
    digest = hashlib.sha256(generator_digest())
    for part in (compiler_version(COMPILER), json.dumps(definition), extent):
        digest.update(part.encode() + b"\0")
    path = cache() / f"m{digest.hexdigest()[:24]}.so"
    if path.exists():
        return path
    # SymPy takes half a second, which an object in the cache does not need
    from delaykit.generator.compile import CompileError, compile_module
    from delaykit.generator.definition import read_model
    from delaykit.generator.model import ModelError as DefinitionError
    from delaykit.generator.module import write_module

    try:
        text = write_module(read_model(definition), extent)
    except DefinitionError as problem:
        raise ModelError(str(problem)) from None
    try:
        compile_module(text, path, COMPILER)
    except (CompileError, OSError) as problem:
        raise CompilerError(str(problem)) from None
    return path

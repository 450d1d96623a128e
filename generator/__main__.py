# SPDX-License-Identifier: BSD-3-Clause
"""Write the Fortran module of a model, or compile it.

    python -m generator DEFINITION.yaml ... MODULE.f90
    python -m generator DEFINITION.yaml ... FOLDER/OBJECT.so ...

Several definitions are one model: later files add to earlier ones. An object is in quadruple
precision if the name of its folder ends with "_quad".
"""

import argparse
import sys
from pathlib import Path

from .compile import COMPILER, FLAGS, CompileError, compile_module
from .definition import read_files
from .model import ModelError
from .module import write_module


def main() -> None:
    """Write a file, which is complete or absent."""
    parser = argparse.ArgumentParser(
        prog="python -m generator",
        description=__doc__,
        formatter_class=argparse.RawTextHelpFormatter,
    )
    parser.add_argument("--compiler", default=COMPILER, help="Fortran compiler of an object")
    parser.add_argument("--flags", default=FLAGS, help="its flags")
    parser.add_argument(
        "files", nargs="+", type=Path, help="files of one definition, then those to write"
    )
    arguments = parser.parse_args()
    made = [path for path in arguments.files if path.suffix in (".f90", ".so")]
    sources = [path for path in arguments.files if path not in made]
    try:
        text = write_module(read_files(sources))
        for path in made:
            if path.suffix == ".so":
                compile_module(text, path, arguments.compiler, arguments.flags)
            else:
                unfinished = path.with_suffix(".unfinished")
                unfinished.write_text(text, encoding="utf-8")
                unfinished.replace(path)
    except (CompileError, ModelError, OSError) as problem:
        sys.exit(f"error: {problem}")


if __name__ == "__main__":
    main()

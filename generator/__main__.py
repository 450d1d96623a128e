"""Write the Fortran module of a model, or compile it, or write the module of the interface.

    python -m generator DEFINITION ... MODULE.f90
    python -m generator DEFINITION ... FOLDER/OBJECT.so
    python -m generator INTERFACE.f90

Several definitions are one model: later files add to earlier ones. An object is in quadruple
precision if the name of its folder ends with "_quad".
"""

import argparse
import sys
from pathlib import Path

from generator.compile import COMPILER, FLAGS, CompileError, compile_module
from generator.definition import ModelError, read_files
from generator.module import write_interface, write_module


def main() -> None:
    """Write a file, which is complete or absent."""
    parser = argparse.ArgumentParser(
        prog="python -m generator",
        description=__doc__,
        formatter_class=argparse.RawTextHelpFormatter,
    )
    parser.add_argument("--name", help="name of the model, in place of that of the definition")
    parser.add_argument("--compiler", default=COMPILER, help="Fortran compiler of an object")
    parser.add_argument("--flags", default=FLAGS, help="its flags")
    parser.add_argument("sources", nargs="*", type=Path, help="files of one definition")
    parser.add_argument("made", type=Path, help="file to write")
    arguments = parser.parse_args()
    try:
        if arguments.sources:
            text = write_module(read_files(arguments.sources, arguments.name))
        else:
            text = write_interface()
        if arguments.made.suffix == ".so":
            compile_module(text, arguments.made, arguments.compiler, arguments.flags)
            return
        unfinished = arguments.made.with_suffix(".unfinished")
        unfinished.write_text(text, encoding="utf-8")
    except (CompileError, ModelError, OSError) as problem:
        sys.exit(f"error: {problem}")
    unfinished.replace(arguments.made)


if __name__ == "__main__":
    main()

"""Write the Fortran module of a model, or the module that makes models by their names.

    python -m generator DEFINITION ... MODULE.f90
    python -m generator --registry NAME ... MODULE.f90

Several definitions are one model: later files add to earlier ones.
"""

import argparse
import sys
from pathlib import Path

from generator.definition import ModelError, read_files
from generator.module import write_module, write_registry


def main() -> None:
    """Write a module; the file is complete or absent."""
    parser = argparse.ArgumentParser(
        prog="python -m generator",
        description=__doc__,
        formatter_class=argparse.RawTextHelpFormatter,
    )
    parser.add_argument("--registry", action="store_true", help="write the module of all names")
    parser.add_argument("--name", help="name of the model, in place of that of the definition")
    parser.add_argument("sources", nargs="+", help="files of one definition, or names of models")
    parser.add_argument("module", type=Path, help="file to write")
    arguments = parser.parse_args()
    try:
        if arguments.registry:
            text = write_registry(arguments.sources, arguments.module.stem)
        else:
            text = write_module(read_files(map(Path, arguments.sources), arguments.name))
        unfinished = arguments.module.with_suffix(".unfinished")
        unfinished.write_text(text, encoding="utf-8")
    except (ModelError, OSError) as problem:
        sys.exit(f"error: {problem}")
    unfinished.replace(arguments.module)


if __name__ == "__main__":
    main()

"""A benchmark is a module with a function `main` (benchmarks/run NAME)."""

import importlib
import subprocess
import sys

from workers import SolverError

from scripts.files.outputs import FileError

if __name__ == "__main__":
    name, *sys.argv[1:] = sys.argv[1:]
    try:
        importlib.import_module(name).main()
    except (SolverError, FileError, OSError, subprocess.CalledProcessError) as failure:
        raise SystemExit(f"benchmarks: {failure}") from None

"""A script and the modules of the project that it imports: what it makes depends on them."""

from functools import cache
from modulefinder import ModuleFinder
from pathlib import Path

SCRIPTS = Path(__file__).parents[1]
STYLED = "scripts.drawing.style"
STYLE = SCRIPTS / "drawing" / "paper.mplstyle"
"""The module that draws in a style, and its file."""


@cache
def modules_of(script: str) -> list[Path]:
    """A script, all modules that it imports, directly or not, and the style where it draws.

    The script is named by its path in the folder of scripts.
    """
    finder = ModuleFinder(path=[str(SCRIPTS.parent)])
    finder.run_script(str(SCRIPTS / script))
    files = [Path(module.__file__) for module in finder.modules.values() if module.__file__]
    style = [STYLE] if STYLED in finder.modules else []
    return sorted({SCRIPTS / script, *files, *style})

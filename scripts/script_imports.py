"""Modules of the project that a script imports: what it makes depends on them."""

from functools import cache
from modulefinder import ModuleFinder
from pathlib import Path

SCRIPTS = Path(__file__).parent
STYLED = "drawing"
STYLE = SCRIPTS / "paper.mplstyle"
"""The module that draws in a style, and its file."""


@cache
def modules_of(script: str) -> list[Path]:
    """Files of all modules that a script imports, directly or not, and the style where it draws."""
    finder = ModuleFinder(path=[str(SCRIPTS)])
    finder.run_script(str(SCRIPTS / script))
    files = [Path(module.__file__) for module in finder.modules.values() if module.__file__]
    style = [STYLE] if STYLED in finder.modules else []
    return sorted(file for file in files + style if file.name != script)

"""A script and the modules of the project that it loads: what it makes depends on them."""

import ast
from functools import cache
from pathlib import Path

from scripts.files.digests import content_of
from scripts.plans.studies import files_of

SCRIPTS = Path(__file__).parents[1]
PROJECT = SCRIPTS.parent
STYLED = SCRIPTS / "drawing" / "style.py"
STYLE = SCRIPTS / "drawing" / "paper.mplstyle"
"""The module that draws in a style, and its file."""


@cache
def imports_of(path: Path) -> frozenset[Path]:
    """The modules of the project that a module loads, anywhere in its text.

    Beside imports these are modules of studies, by calls such as `studies.load_parts("finding")`.
    """
    names, files = set(), set()
    for node in ast.walk(ast.parse(content_of(path))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            # those of a package of its own name each other by a dot
            beside = path.parent.relative_to(PROJECT).parts if node.level else ()
            module = ".".join([*beside, *filter(None, [node.module])])
            names |= {module, *(f"{module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == "load_parts":
            files |= {*files_of(f"{ast.literal_eval(node.args[0])}.py")}
    files |= {PROJECT.joinpath(*name.split(".")).with_suffix(".py") for name in names}
    return frozenset(file for file in files if file.exists())


@cache
def modules_of(script: str) -> list[Path]:
    """A script, all modules that it imports, directly or not, and the style where it draws.

    The script is named by its path in the folder of scripts.
    """
    found, waiting = set(), {SCRIPTS / script}
    while waiting:
        path = waiting.pop()
        found.add(path)
        waiting |= imports_of(path) - found
    return sorted(found | ({STYLE} if STYLED in found else set()))

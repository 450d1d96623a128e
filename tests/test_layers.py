"""The house: Fortran modules import from lower layers only, and keep to its style."""

import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT

FORTRAN = ROOT / "fortran"
GENERATOR = ROOT / "generator"
MAY_USE = {
    "bindings": {"bindings", "api"},
    "dde": {"dde", "api"},
    "generator": {"generator", "api"},
    "model": {"model", "generator", "api"},
    "methods": {"methods", "generator", "bindings", "api"},
    "study": {"study", "methods", "model", "generator", "bindings", "api"},
    "io": {"io", "study", "methods", "model", "generator", "files", "netcdf", "api"},
    "app": {"app", "io", "study", "methods", "model", "generator", "api"},
}
"""For each layer: the layers that its modules may use; `api` is what a user of the solver sees,
`files` is what of the bindings reads and writes."""
ALONE = {
    **dict.fromkeys(("dde", "dde_errors", "dde_kinds"), "api"),
    **dict.fromkeys(("process", "unfinished_file"), "files"),
    # made when the project is built
    "model_interface": "generator",
    "netcdf": "netcdf",
}
"""Layers of modules that are not those of their folders."""
INTRINSIC = {"ieee_arithmetic", "iso_c_binding", "iso_fortran_env"}
PROGRAMS = [FORTRAN / "app" / f"{name}.f90" for name in ("spring_block", "spring_block_quad")]
"""The sources that are no modules, in the folder of the commands."""


def code_of(text: str) -> str:
    """Statements without comments and texts, one a line."""
    text = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", "''", text)
    text = re.sub(r"![^\n]*", "", text)
    return re.sub(r"&\s*\n\s*&?", "", text).lower()


def layer_of(path: Path) -> str:
    if path.is_relative_to(GENERATOR):
        return "generator"
    *folder, _ = path.relative_to(FORTRAN).parts
    return "dde" if folder[0] == "dde" else folder[:2][-1]


SOURCES = {
    path: path.read_text()
    for path in sorted(
        [
            *FORTRAN.glob("src/**/*.f90*"),
            *FORTRAN.glob("dde/src/**/*.f90"),
            *FORTRAN.glob("app/*.f90"),
            *GENERATOR.glob("fortran/**/*.f90"),
        ]
    )
}
"""Text of each file."""
MODULES = {path: text for path, text in SOURCES.items() if path not in PROGRAMS}
"""Text of each module."""


def name_of(path: Path) -> str:
    return path.name.split(".")[0]


def uses_of(text: str) -> list[str]:
    return re.findall(r"^\s*use\b(?:\s*,\s*\w+)?\s*(?:::)?\s*(\w+)", code_of(text), re.MULTILINE)


LAYERS = {name_of(path): layer_of(path) for path in MODULES} | ALONE
"""Layer of each module."""


def violations(layer: str, text: str) -> list[str]:
    """Modules that a file on this layer uses and may not."""
    used = [name for name in uses_of(text) if name not in INTRINSIC]
    return [name for name in used if LAYERS.get(name) not in MAY_USE[layer]]


def test_no_import_from_a_higher_layer():
    """Modules use what lies below, and of the solver its facade."""
    found = {path: violations(layer_of(path), text) for path, text in SOURCES.items()}
    assert {path: wrong for path, wrong in found.items() if wrong} == {}


def output_statements(text: str) -> list[str]:
    to_screen = r"write\s*\(\s*(?:\*|\w*error_unit\b|\w*output_unit\b)"
    said = rf"^.*\b(?:error\s+stop\b|stop\b|print\b|{to_screen}).*$"
    return re.findall(said, code_of(text), re.MULTILINE)


def test_files_are_short_and_named_after_their_module():
    """A program has at most 60 lines: longer code belongs to a lower layer."""
    for path, text in SOURCES.items():
        assert len(text.splitlines()) <= (60 if layer_of(path) == "app" else 400), path
    for path, text in MODULES.items():
        modules = re.findall(r"^\s*module (?!procedure)(\w+)$", code_of(text), re.MULTILINE)
        assert modules == [name_of(path)]


def test_only_some_modules_speak_and_one_opens_models():
    """Those that end programs, show help and tell how far they have come."""
    speaking = {name_of(path) for path in MODULES if output_statements(MODULES[path])}
    assert speaking == {"namelist_input", "program_arguments", "progress"}
    opening = {name_of(path) for path, text in SOURCES.items() if "dlopen" in code_of(text)}
    assert opening == {"model_library"}


def test_versions_agree():
    """In all files that name that of the project, of the solver, or of generator and methods."""
    released = r"(?m)^## v?(\d[\d.]*)"
    built = r"project\(.* VERSION (\S+)"
    for places in (
        {"fortran/CMakeLists.txt": built, "CITATION.cff": r"(?m)^version: ([\d.]+)"}
        | {"CHANGELOG.md": released},
        # CMake reads that of fpm
        {"fortran/dde/CHANGELOG.md": released, "fortran/dde/fpm.toml": r'(?m)^version = "([\d.]+)'},
        {"generator/__init__.py": r'__version__ = "([\d.]+)', "generator/CHANGELOG.md": released},
    ):
        found = {
            name: re.search(line, (ROOT / name).read_text())[1] for name, line in places.items()
        }
        assert len(set(found.values())) == 1, found


PYTHON_LAYERS = [
    *("files", "namelists", "plans", "config", "tables", "claims", "drawing", "page", "workflow")
]
"""Rooms of scripts/ that studies share, from the lowest to the highest."""
STUDIES = ROOT / "scripts" / "studies"
SCRIPTS = {path: path.read_text() for path in sorted((ROOT / "scripts").glob("*/*.py"))}


def layers_imported(text: str) -> set[str]:
    """Folders of scripts/ whose modules a script imports."""
    found = re.findall(r"^\s*(?:from|import) scripts\.(\w+)", text, re.MULTILINE)
    return set(found) | set(re.findall(r"^\s*from scripts import (\w+)", text, re.MULTILINE))


def test_no_python_module_imports_from_a_higher_layer():
    """Nor from a study: what studies have is found by its name."""
    assert {path.parent.name for path in SCRIPTS} == set(PYTHON_LAYERS)
    wrong = {
        (path.relative_to(ROOT).as_posix(), layer)
        for path, text in SCRIPTS.items()
        for layer in layers_imported(text)
        if layer not in PYTHON_LAYERS[: PYTHON_LAYERS.index(path.parent.name) + 1]
    }
    assert wrong == set()


def imports_of_study(name: str, text: str) -> set[str]:
    """Rooms and studies from which a file of a study imports, but for those that all may import
    from. Tests may plan a run.
    """
    studies = re.findall(r"^\s*(?:from|import) scripts\.studies\.(\w+)", text, re.MULTILINE)
    others = re.findall(r"^\s*from scripts\.studies import (\w+)", text, re.MULTILINE)
    rooms = {*PYTHON_LAYERS, "studies"} - ({"workflow"} if not name.startswith("test_") else set())
    return {*studies, *others} | (layers_imported(text) - rooms)


def test_study_imports_from_shared_rooms_alone():
    files = {path: path.read_text() for path in sorted(STUDIES.glob("*/*.py"))}
    found = {path: imports_of_study(path.name, text) for path, text in files.items()}
    assert {path: names for path, names in found.items() if names - {path.parent.name}} == {}


def test_planning_loads_nothing_that_draws_fits_or_derives():
    """Of what the rules import."""
    rules = "".join(path.read_text() for path in [ROOT / "Snakefile", *ROOT.glob("rules/*.smk")])
    imports = re.findall(r"^from scripts.*$", rules, re.MULTILINE)
    code = "\n".join(["import sys", *imports, "read_plan({})", "print(*sys.modules)"])
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    heavy = {"matplotlib", "scipy.linalg", "powerlaw", "sympy", "xarray", "pandas"}
    assert heavy & {*run.stdout.split()} == set()

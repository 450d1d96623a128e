"""The house: Fortran modules import from lower layers only, and keep to its style."""

import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT, project_files
from scripts.files.read_config import read

FORTRAN = ROOT / "fortran"
GENERATOR = ROOT / "generator"
PYTHON = ROOT / "python"
FLOORS = ["base", "history", "step", "explicit", "radau", "taylor", "output", "loop", "dde"]
"""Folders of the solver from the lowest to the highest, above them all its facade."""
MAY_USE = {
    "bindings": {"bindings", "api"},
    "generator": {"generator", "api"},
    "model": {"model", "generator", "api"},
    "methods": {"methods", "generator", "bindings", "api"},
    "study": {"study", "methods", "model", "generator", "bindings", "api"},
    "commands": {"commands", "study", "methods", "model", "generator", "api"},
    "io": {"io", "commands", "methods", "files", "netcdf", "api"},
    "app": {"app", "io", "commands", "methods", "bindings"},
    "python": {"python", "commands", "methods", "model", "generator", "api"},
    **{floor: {"api", *FLOORS[: i + 1]} for i, floor in enumerate(FLOORS)},
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
PROGRAMS = {"spring_block", "spring_block_quad"}
"""The sources that are no modules, in the folder of the commands."""


def code_of(text: str) -> str:
    """Statements without comments and texts, one a line."""
    text = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", "''", text)
    text = re.sub(r"![^\n]*", "", text)
    return re.sub(r"&\s*\n\s*&?", "", text).lower()


def layer_of(path: Path) -> str:
    for root in (GENERATOR, PYTHON):
        if path.is_relative_to(root):
            return root.name
    *folder, _ = path.relative_to(FORTRAN).parts
    return ("dde", *folder[2:])[-1] if folder[0] == "dde" else folder[:2][-1]


CODE = {
    path: code_of(path.read_text())
    for path in [
        *FORTRAN.glob("src/**/*.f90*"),
        *FORTRAN.glob("dde/src/**/*.f90"),
        *FORTRAN.glob("app/*.f90"),
        *GENERATOR.glob("fortran/**/*.f90"),
        *PYTHON.glob("src/**/*.f90"),
    ]
}
"""Statements of each file."""


def name_of(path: Path) -> str:
    return path.name.split(".")[0]


def test_no_import_from_a_higher_layer():
    """Modules use what lies below, and of the solver its facade."""
    known = {name_of(path): layer_of(path) for path in CODE} | ALONE
    used = re.compile(r"^\s*use\b(?:\s*,\s*\w+)?\s*(?:::)?\s*(\w+)", re.MULTILINE)
    wrong = [
        f"{path} uses {name}"
        for path, code in CODE.items()
        for name in set(used.findall(code)) - INTRINSIC
        if known.get(name) not in MAY_USE[layer_of(path)]
    ]
    assert wrong == []


def test_files_are_short_and_named_after_their_module():
    """A program has at most 60 lines: longer code belongs to a lower layer."""
    for path, code in CODE.items():
        most = 60 if layer_of(path) == "app" else 400
        assert len(path.read_text().splitlines()) <= most, path
        modules = re.findall(r"^\s*module (?!procedure)(\w+)$", code, re.MULTILINE)
        assert modules == ([] if name_of(path) in PROGRAMS else [name_of(path)])


def test_only_some_modules_speak_and_one_opens_models():
    """Those that end programs, show help and tell how far they have come."""
    to_screen = r"write\s*\(\s*(?:\*|\w*error_unit\b|\w*output_unit\b)"
    speaks = re.compile(rf"\b(?:error\s+stop\b|stop\b|print\b|{to_screen})")
    speaking = {name_of(path) for path, code in CODE.items() if speaks.search(code)}
    assert speaking - PROGRAMS == {"program_arguments", "progress"}
    opening = {name_of(path) for path, code in CODE.items() if "model_open" in code}
    assert opening == {"model_library"}


def test_versions_agree():
    """In all files that name that of the project, or of generator and methods."""
    released = r"(?m)^## v?(\d[\d.]*)"
    built = r"project\(.* VERSION (\S+)"
    for places in (
        {"fortran/CMakeLists.txt": built, "CITATION.cff": r"(?m)^version: ([\d.]+)"}
        | {"CHANGELOG.md": released},
        {"generator/__init__.py": r'__version__ = "([\d.]+)', "generator/CHANGELOG.md": released},
    ):
        found = {
            name: re.search(line, (ROOT / name).read_text())[1] for name, line in places.items()
        }
        assert len(set(found.values())) == 1, found


def test_generator_and_methods_know_no_block():
    """No name of its laws, and no parameter or state of it as a component or in quotes."""
    model = FORTRAN / "src" / "model"
    block = read(model / "spring_block.yaml")
    keys = "|".join([*block["parameters"], *block["states"], "ln_v"])
    laws = "|".join(path.stem for path in (model / "laws").glob("*.yaml"))
    words = re.compile(rf"(?i)spring|friction|{laws}|%({keys})\b|[\"']({keys})[\"']")
    files = [*GENERATOR.glob("*.py"), *GENERATOR.glob("*.jinja"), *GENERATOR.glob("fortran/**/*.*")]
    files += (FORTRAN / "src" / "methods").glob("**/*.f90")
    found = {path: words.findall(path.read_text()) for path in files}
    assert [(path, met) for path, met in found.items() if met] == []


NO_SOURCES = (
    *(".ipynb", ".json", ".lock", ".md", ".png", ".tsv", ".typed"),
    *("LICENSE", "packages.txt", "ts.in"),
)
"""Ends of names of data and documents."""


def test_packages_are_permissive():
    """Each source names its licence: that of GSL and FFTW where it calls them, in no package."""
    licences, calling = {}, set()
    for name in project_files():
        if name.startswith(("fortran/", "generator/", "python/")) and not name.endswith(NO_SOURCES):
            text = (ROOT / name).read_text()
            found = re.match(r"(?:#!.*\n)?\W*SPDX-License-Identifier: (\S+)", text)
            licences[name] = found and found[1]
            calling |= {name} if re.search(r"fftw3\.f03|\"gsl_\w", text) else set()
    bound = ("fftw_transform", "gsl_distribution")
    assert calling == {f"fortran/src/bindings/{name}.f90" for name in bound}
    assert {*licences.values()} == {"BSD-3-Clause", "GPL-3.0-or-later"}
    assert {name for name in licences if licences[name] != "BSD-3-Clause"} == calling
    assert len({(ROOT / name / "LICENSE").read_text() for name in ("fortran", "generator")}) == 1


PYTHON_LAYERS = [
    *("files", "models", "requests", "plans", "config", "tables", "claims", "drawing", "page"),
    "workflow",
]
"""Rooms of scripts/ that studies share, from the lowest to the highest."""
SCRIPTS = {path: path.read_text() for path in (ROOT / "scripts").glob("**/*.py")}


def layers_imported(text: str) -> set[str]:
    """Folders of scripts/ whose modules a script imports."""
    found = re.findall(r"^\s*(?:from|import) scripts\.(\w+)", text, re.MULTILINE)
    return set(found) | set(re.findall(r"^\s*from scripts import (\w+)", text, re.MULTILINE))


def test_no_python_module_imports_from_a_higher_layer():
    """Shared rooms import from no study: what studies have is found by its name. Studies import
    from shared rooms alone; their tests may plan a run."""
    of_study = re.compile(r"^\s*(?:from|import) scripts\.studies(?:\.| import )(\w+)", re.MULTILINE)
    wrong = []
    for path, text in SCRIPTS.items():
        *folder, name = path.relative_to(ROOT / "scripts").parts
        allowed = {*PYTHON_LAYERS[:-1], "studies", *["workflow"] * name.startswith("test_")}
        if folder[:1] != ["studies"]:
            allowed = {*PYTHON_LAYERS[: PYTHON_LAYERS.index(folder[0]) + 1]} if folder else set()
        found = (layers_imported(text) - allowed) | ({*of_study.findall(text)} - {*folder})
        wrong += [f"{path} imports from {one}" for one in found]
    assert wrong == []


def test_the_python_package_imports_nothing_of_the_house():
    """But the generator, which is a part of it."""
    imports = re.compile(r"^\s*(?:from|import) (\w+)", re.MULTILINE)
    for path in PYTHON.glob("delaykit/*.py"):
        own = {*imports.findall(path.read_text())}
        assert own & {"conftest", "generator", "scripts", "snakemake"} == set(), path


def test_planning_loads_nothing_that_draws_fits_or_derives():
    """Of what the rules import."""
    rules = "".join(path.read_text() for path in [ROOT / "Snakefile", *ROOT.glob("rules/*.smk")])
    imports = re.findall(r"^from scripts.*$", rules, re.MULTILINE)
    code = "\n".join(["import sys", *imports, "read_plan({})", "print(*sys.modules)"])
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    heavy = {"matplotlib", "scipy.linalg", "powerlaw", "sympy", "xarray", "pandas"}
    assert heavy & {*run.stdout.split()} == set()

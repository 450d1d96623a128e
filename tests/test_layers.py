"""The house: Fortran modules import from lower layers only, and keep to its style."""

import re
from pathlib import Path

import pytest

from conftest import ROOT, project_files
from scripts.files.read_config import read

FORTRAN = ROOT / "fortran"
GENERATOR = ROOT / "generator"
MADE = ("model_interface",)
"""Modules that are made when the project is built."""
MAY_USE = {
    "bindings": {"bindings", "api"},
    "dde": {"dde", "api"},
    "generator": {"generator", "api"},
    "model": {"model", "generator", "api"},
    "methods": {"methods", "generator", "bindings", "api"},
    "study": {"study", "methods", "model", "generator", "bindings", "api"},
    "io": {"io", "study", "methods", "model", "generator", "files", "api"},
    "app": {"app", "io", "study", "methods", "model", "generator", "api"},
}
"""For each layer: the layers that its modules may use; `api` is what a user of the solver sees,
`files` is what of the bindings reads and writes."""
API = ("dde", "dde_errors", "dde_kinds")
FILES = ("process", "unfinished_file")
"""Modules that others may use: layers of their own."""
LIBRARIES = {
    "bindings": {"iso_c_binding"},
    "dde": {"ieee_arithmetic", "iso_fortran_env"},
    "generator": {"ieee_arithmetic", "iso_c_binding"},
    "model": {"ieee_arithmetic"},
    "methods": {"ieee_arithmetic", "iso_c_binding"},
    "study": {"ieee_arithmetic"},
    "io": {"ieee_arithmetic", "iso_fortran_env", "netcdf"},
}
"""For each layer: modules of others that it may use."""
PROGRAMS = [FORTRAN / "app" / f"{name}.f90" for name in ("spring_block", "spring_block_quad")]
"""The sources that are no modules, in the folder of the commands."""
MAY_SPEAK = {"namelist_input", "program_arguments", "progress"}
"""The modules that end programs, show help and tell how far they have come."""
MAY_OPEN = {"model_library"}
"""The module that opens compiled models."""


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


def layers() -> dict[str, str]:
    """Layer of each module; those that others may use are layers of their own."""
    by_folder = {name_of(path): layer_of(path) for path in MODULES}
    made = dict.fromkeys(MADE, "generator")
    return by_folder | made | dict.fromkeys(API, "api") | dict.fromkeys(FILES, "files")


def violations(layer: str, text: str, known: dict[str, str]) -> list[str]:
    """Modules that a file on this layer uses and may not."""
    allowed = MAY_USE[layer]
    others = LIBRARIES.get(layer, set())
    return [
        f"{layer} uses {name}"
        for name in uses_of(text)
        if (known[name] not in allowed if name in known else name not in others)
    ]


def test_no_import_from_a_higher_layer():
    """Modules use what lies below, and of the solver its facade."""
    known = layers()
    found = {path: violations(layer_of(path), text, known) for path, text in SOURCES.items()}
    assert {path: wrong for path, wrong in found.items() if wrong} == {}


@pytest.mark.parametrize(
    ("layer", "line", "wrong"),
    [
        ("dde", "use spring_block, only: spring_block_type", 1),
        ("dde", "use, intrinsic :: iso_c_binding, only: c_int", 1),
        ("model", "   USE :: netcdf_output, only: output_file_type", 1),
        ("methods", "use dde_errors, &\n   only: raise\nuse netcdf_output, only: output_file", 1),
        ("app", "use nobody_knows, only: what", 1),
        ("methods", "! use netcdf_output, only: output_file", 0),
        ("methods", "call say('&\n   use netcdf_output')", 0),
        ("methods", "use_of = 1", 0),
        ("methods", "use, intrinsic :: iso_c_binding, only: c_int", 0),
    ],
)
def test_violation_is_caught(layer, line, wrong):
    """The checker itself, on made-up lines; comments, texts and other names are no violations."""
    assert len(violations(layer, line, layers())) == wrong


def test_package_of_the_solver_uses_nothing_outside_of_it():
    """Its sources, tests, example and benchmarks."""
    files = [Path(name) for name in project_files() if name.startswith("fortran/dde/")]
    texts = {path: (ROOT / path).read_text() for path in files if path.suffix in (".f90", ".py")}
    modules = r"^ *module (?!procedure)(\w+)$"
    inside = {name for text in texts.values() for name in re.findall(modules, text, re.MULTILINE)}
    used = {name for path in texts if path.suffix == ".f90" for name in uses_of(texts[path])}
    assert used - inside == {"ieee_arithmetic", "iso_c_binding", "iso_fortran_env"}
    imports = r"^ *(?:from|import) (\w+)"
    imported = {name for text in texts.values() for name in re.findall(imports, text, re.MULTILINE)}
    assert imported & {"benchmarks", "project", "scripts"} == set()


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


def test_only_some_modules_print_and_stop():
    assert {name_of(path) for path in MODULES if output_statements(MODULES[path])} == MAY_SPEAK


def test_only_one_module_opens_models():
    opened = {path for path, text in SOURCES.items() if "model_open" in code_of(text)}
    assert {name_of(path) for path in opened} == MAY_OPEN


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


def words_of_the_block() -> re.Pattern:
    """Its names, those of its laws, and its parameters and states as components and in quotes."""
    model = FORTRAN / "src" / "model"
    names = [path.stem for path in (model / "laws").glob("*.yaml")]
    block = read(model / "spring_block.yaml")
    keys = "|".join([*block["parameters"], *block["states"], "ln_v"])
    alone = "|".join(["spring", "friction", "earthquake", *names])
    return re.compile(rf"(?i){alone}|%({keys})\b|[\"']({keys})[\"']")


def test_models_and_methods_know_no_block():
    """The package of generator and methods; which modules it uses is a matter of layers."""
    files = [
        *(path for path in GENERATOR.rglob("*.*") if "test" not in path.parts),
        *(FORTRAN / "src" / "methods").rglob("*.*"),
    ]
    code = {
        path: path.read_text() for path in files if path.suffix in {".f90", ".py", ".c", ".jinja"}
    }
    assert len(code) > 50
    met = {path.name: words_of_the_block().search(text) for path, text in code.items()}
    assert {name: word for name, word in met.items() if word} == {}
    for line in ("use spring_block", 'name == "tau"', "parameters%xi", "slip_cut_off.yaml"):
        assert words_of_the_block().search(line)


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


def imports_of_study(path: Path, text: str) -> set[str]:
    """Rooms and other studies from which a file of a study imports and may not.

    Tests may plan a run.
    """
    studies = set(re.findall(r"^\s*(?:from|import) scripts\.studies\.(\w+)", text, re.MULTILINE))
    others = re.findall(r"^\s*from scripts\.studies import (\w+)", text, re.MULTILINE)
    rooms = layers_imported(text) - {*PYTHON_LAYERS, "studies"}
    highest = set() if path.name.startswith("test_") else layers_imported(text) & {"workflow"}
    return (studies - {path.parent.name}) | {*others} | rooms | highest


def test_study_imports_from_shared_rooms_alone():
    files = {path: path.read_text() for path in sorted(STUDIES.glob("*/*.py"))}
    wrong = {path: found for path, text in files.items() if (found := imports_of_study(path, text))}
    assert wrong == {}


@pytest.mark.parametrize(
    ("name", "line", "wrong"),
    [
        ("table.py", "from scripts.studies.hopf.table import rows_of", {"hopf"}),
        ("test_mine.py", "from scripts.studies import hopf", {"hopf"}),
        ("table.py", "    from scripts.workflow.plan import read_plan", {"workflow"}),
        ("test_mine.py", "from scripts.workflow.plan import read_plan", set()),
        ("figure.py", "from scripts.studies.mine.table import rows_of", set()),
        ("figure.py", "from scripts.drawing.style import INK", set()),
    ],
)
def test_import_from_another_study_is_caught(name, line, wrong):
    assert imports_of_study(STUDIES / "mine" / name, line) == wrong

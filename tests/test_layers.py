"""The house: Fortran modules import from lower layers only, and keep to its style."""

import re
from pathlib import Path

import pytest
from conftest import ROOT

FORTRAN = ROOT / "fortran"
MAY_USE = {
    "bindings": {"bindings", "api"},
    "dde": {"dde", "api"},
    "model": {"model", "api"},
    "methods": {"methods", "bindings", "api"},
    "study": {"study", "methods", "model", "bindings", "api"},
    "io": {"io", "study", "methods", "model", "files", "api"},
    "app": {"io", "study", "methods", "model", "api"},
}
"""For each layer: the layers that its modules may use; `api` is what a user of the solver sees,
`files` is what of the bindings reads and writes."""
API = ("dde", "dde_errors", "dde_kinds")
FILES = ("file_system", "process")
"""Modules that others may use: layers of their own."""
LIBRARIES = {
    "bindings": {"iso_c_binding"},
    "dde": {"ieee_arithmetic", "iso_fortran_env"},
    "model": {"ieee_arithmetic"},
    "methods": {"ieee_arithmetic", "iso_c_binding"},
    "study": {"ieee_arithmetic"},
    "io": {"ieee_arithmetic", "iso_fortran_env", "netcdf"},
}
"""For each layer: modules of others that it may use."""
WITHOUT_ONLY = {("fftw", "iso_c_binding"), ("dde_explicit_stages", "dde_dop853_tableau")}
"""An interface passed on whole, and a list of coefficients used in one place."""
PUBLIC = {"fftw", "dde_dop853_tableau"}
"""Modules without a secret: the same two."""
MAY_SPEAK = {"program_arguments", "progress"}
"""The modules that end programs and tell how far they have come."""


def code_of(text: str) -> str:
    """Statements without comments and texts, one a line."""
    text = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", "''", text)
    text = re.sub(r"![^\n]*", "", text)
    return re.sub(r"&\s*\n\s*&?", "", text).lower()


def layer_of(path: Path) -> str:
    """Name of the layer that a file lives on."""
    *folder, _ = path.relative_to(FORTRAN).parts
    return "dde" if folder[0] == "dde" else folder[:2][-1]


SOURCES = {
    path: path.read_text()
    for path in sorted(
        [
            *FORTRAN.glob("src/**/*.f90*"),
            *FORTRAN.glob("dde/src/**/*.f90"),
            *FORTRAN.glob("app/*.f90"),
        ]
    )
}
"""Text of each file."""
MODULES = {path: text for path, text in SOURCES.items() if layer_of(path) != "app"}
"""Text of each module."""


def name_of(path: Path) -> str:
    return path.name.split(".")[0]


def uses_of(text: str) -> list[tuple[str, bool]]:
    """Modules that a file uses, and whether it says which of their names."""
    found = re.findall(
        r"^\s*use\b(?:\s*,\s*\w+)?\s*(?:::)?\s*(\w+)(.*)$", code_of(text), re.MULTILINE
    )
    return [(name, re.match(r"\s*,\s*only\s*:", rest) is not None) for name, rest in found]


def layers() -> dict[str, str]:
    """Floor of each module; those that others may use are layers of their own."""
    by_folder = {name_of(path): layer_of(path) for path in MODULES}
    return by_folder | dict.fromkeys(API, "api") | dict.fromkeys(FILES, "files")


def violations(layer: str, text: str, known: dict[str, str]) -> list[str]:
    """Modules that a file on this layer uses and may not."""
    allowed = MAY_USE[layer]
    others = LIBRARIES.get(layer, set())
    return [
        f"{layer} uses {name}"
        for name, _ in uses_of(text)
        if (known[name] not in allowed if name in known else name not in others)
    ]


def test_all_layers_are_there():
    """The table and the folders are the same."""
    assert {layer_of(path) for path in SOURCES} == set(MAY_USE)


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


def output_statements(text: str) -> list[str]:
    to_screen = r"write\s*\(\s*(?:\*|\w*error_unit\b|\w*output_unit\b)"
    said = rf"^.*\b(?:error\s+stop\b|stop\b|print\b|{to_screen}).*$"
    return re.findall(said, code_of(text), re.MULTILINE)


def reals_without_kind(text: str) -> list[str]:
    literal = r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[ed][+-]?\d))(?:[ed][+-]?\d+)?(?!\w*_wp)(?![\w.])"
    return re.findall(literal, re.sub(r"\.\w+\.", " ", code_of(text)))


def test_modules_keep_to_the_style():
    """One module a file, of its name, with `implicit none` and a list of what is public."""
    for path, text in MODULES.items():
        code, name = code_of(text), name_of(path)
        assert re.findall(r"^\s*module (?!procedure)(\w+)$", code, re.MULTILINE) == [name]
        access = re.findall(r"^\s*(private|public)\s*$", code, re.MULTILINE)
        assert access[:1] == ["public" if name in PUBLIC else "private"], path
    for path, text in SOURCES.items():
        assert re.search(r"^\s*implicit none\b", code_of(text), re.MULTILINE), path
        assert len(text.splitlines()) <= (60 if layer_of(path) == "app" else 400), path
    uses = [(name_of(path), *use) for path, text in SOURCES.items() for use in uses_of(text)]
    assert {(name, used) for name, used, only in uses if not only} <= WITHOUT_ONLY


def test_only_some_modules_print_and_stop():
    assert {name_of(path) for path in MODULES if output_statements(MODULES[path])} == MAY_SPEAK


def test_every_real_number_has_its_kind():
    found = {path: reals_without_kind(text) for path, text in SOURCES.items()}
    assert {path: reals for path, reals in found.items() if reals} == {}


def test_checkers_find_what_they_look_for():
    """Each on a file that is made up."""
    for literal in ("1.0", "1.", ".5", "1e3", "1.0e-3", "2d0", "1.5d+3"):
        assert len(reals_without_kind(f"x = {literal} + 1.0_wp*2 + 1e3_wp\n")) == 1, literal
    for line in (
        "stop",
        "error stop 'x'",
        "print *, x",
        "write (*, *) x",
        "write(error_unit, f) x",
    ):
        assert output_statements(f"if (x) {line}\n"), line
    assert output_statements("! stop\nwrite (unit, f) x\ncall say('stop')\n") == []


def test_versions_agree():
    """Of the programs, the citation and the changelog."""
    build = re.search(r"project\(.* VERSION (\S+)", (FORTRAN / "CMakeLists.txt").read_text())[1]
    citation = re.search(
        r"^version: \"?([\d.]+)", (ROOT / "CITATION.cff").read_text(), re.MULTILINE
    )[1]
    entries = re.findall(r"^## \[?v?(\d[\d.]*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert build == citation == entries[0]


PYTHON_LAYERS = [
    *("files", "namelists", "config", "results", "tables", "claims", "drawing", "figures"),
    *("page", "workflow"),
]
"""Folders of scripts/, from the lowest to the highest."""
SCRIPTS = {path: path.read_text() for path in sorted((ROOT / "scripts").glob("*/*.py"))}


def layers_imported(text: str) -> set[str]:
    """Folders of scripts/ whose modules a script imports."""
    found = re.findall(r"^\s*(?:from|import) scripts\.(\w+)", text, re.MULTILINE)
    return set(found) | set(re.findall(r"^\s*from scripts import (\w+)", text, re.MULTILINE))


def test_no_python_module_imports_from_a_higher_layer():
    assert {path.parent.name for path in SCRIPTS} == set(PYTHON_LAYERS)
    wrong = {
        (path.relative_to(ROOT).as_posix(), layer)
        for path, text in SCRIPTS.items()
        for layer in layers_imported(text)
        if PYTHON_LAYERS.index(layer) > PYTHON_LAYERS.index(path.parent.name)
    }
    assert wrong == set()

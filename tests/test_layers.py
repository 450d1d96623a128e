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
    """File name without endings."""
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


def test_facade_of_the_solver_uses_the_solver_only():
    """It passes names on."""
    uses = {name for name, _ in uses_of((FORTRAN / "dde" / "src" / "api" / "dde.f90").read_text())}
    assert len(uses) > 3
    assert all(name.startswith("dde_") for name in uses)


@pytest.mark.parametrize(
    ("layer", "line"),
    [
        ("bindings", "use spring_block, only: spring_block_type"),
        ("dde", "use spring_block, only: spring_block_type"),
        ("dde", "use lapack, only: solve"),
        ("methods", "use spring_block, only: spring_block_type"),
        ("bindings", "use dde_integrator, only: integrate"),
        ("model", "use normal_form, only: first_lyapunov_coefficient"),
        ("dde", "use, intrinsic :: iso_c_binding, only: c_int"),
        ("model", "use dde_history, only: history_type"),
        ("model", "use fftw, only: fftw_plan_dft_r2c_1d"),
        ("model", "   USE :: netcdf_output, only: output_file_type"),
        ("model", "use measured_case, only: case_type"),
        ("methods", "use measured_run, only: run_type"),
        ("study", "use dde_integrator, only: integrate"),
        ("study", "use cases_input, only: read_cases"),
        ("study", "use file_system, only: rename_file"),
        ("methods", "use hopf_files, only: hopf_settings_type"),
        ("methods", "use netcdf, only: nf90_open"),
        ("methods", "use dde_integrator"),
        ("methods", "use file_system, only: rename_file"),
        ("io", "use gsl_roots, only: find_root"),
        ("io", "use dde_outcome, only: reached_end"),
        ("app", "use dde_outcome, only: reached_end"),
        ("app", "use nobody_knows, only: what"),
        ("methods", "use dde_errors, &\n   only: raise\nuse netcdf_output, only: output_file"),
    ],
)
def test_violation_is_caught(layer, line):
    """The checker itself, on made-up lines."""
    assert len(violations(layer, line, layers())) == 1


@pytest.mark.parametrize(
    "line",
    [
        "! use netcdf_output, only: output_file",
        "call say('&\n   use netcdf_output')",
        "use_of = 1",
        "use, intrinsic :: iso_c_binding, only: c_int",
    ],
)
def test_no_violation_is_made_up(line):
    """Comments, texts and other names."""
    assert violations("methods", line, layers()) == []


def names_of_modules(text: str) -> list[str]:
    """Modules that a file defines."""
    return re.findall(r"^\s*module (?!procedure)(\w+)$", code_of(text), re.MULTILINE)


def access_of(text: str) -> str | None:
    """The first statement `private` or `public` of a module."""
    said = re.findall(r"^\s*(private|public)\s*$", code_of(text), re.MULTILINE)
    return said[0] if said else None


def is_explicit(text: str) -> bool:
    """Whether a file has the statement `implicit none`."""
    return re.search(r"^\s*implicit none\b", code_of(text), re.MULTILINE) is not None


def output_statements(text: str) -> list[str]:
    """Statements that print or stop."""
    to_screen = r"write\s*\(\s*(?:\*|\w*error_unit\b|\w*output_unit\b)"
    said = rf"^.*\b(?:error\s+stop\b|stop\b|print\b|{to_screen}).*$"
    return re.findall(said, code_of(text), re.MULTILINE)


def reals_without_kind(text: str) -> list[str]:
    """Real numbers without `_wp`."""
    literal = r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[ed][+-]?\d))(?:[ed][+-]?\d+)?(?!\w*_wp)(?![\w.])"
    return re.findall(literal, re.sub(r"\.\w+\.", " ", code_of(text)))


def test_file_holds_the_module_of_its_name():
    """One module in each file."""
    wrong = [path for path in MODULES if names_of_modules(MODULES[path]) != [name_of(path)]]
    assert wrong == []


def test_programs_are_short():
    """At most 60 lines: longer code belongs to a lower layer."""
    programs = {path: text for path, text in SOURCES.items() if layer_of(path) == "app"}
    assert programs
    for path, text in programs.items():
        assert re.findall(r"^\s*program (\w+)$", code_of(text), re.MULTILINE), path
        assert len(text.splitlines()) <= 60, path


def test_files_are_short():
    """At most 400 lines."""
    assert [path for path, text in SOURCES.items() if len(text.splitlines()) > 400] == []


def test_nothing_is_implicit():
    """Every module and every program has `implicit none`."""
    assert [path for path, text in SOURCES.items() if not is_explicit(text)] == []


def test_modules_are_private():
    """They list what is public."""
    expected = {path: "public" if name_of(path) in PUBLIC else "private" for path in MODULES}
    assert {path: access_of(text) for path, text in MODULES.items()} == expected


def test_every_use_has_only():
    """Except for those of WITHOUT_ONLY."""
    uses = [(name_of(path), *use) for path, text in SOURCES.items() for use in uses_of(text)]
    assert {(name, used) for name, used, only in uses if not only} <= WITHOUT_ONLY


def test_only_some_modules_print_and_stop():
    """The others return an error."""
    assert {name_of(path) for path in MODULES if output_statements(MODULES[path])} == MAY_SPEAK


def test_every_real_number_has_its_kind():
    """1.0_wp, never 1.0 or 1d0."""
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
    assert not is_explicit("module a\n! implicit none\nend module a\n")
    assert access_of("module a\nprivate :: b\nend module a\n") is None
    assert access_of("module a\n   private\n   public\n") == "private"
    assert names_of_modules("module a\nend module a\nmodule b\nend module b\n") == ["a", "b"]
    assert uses_of("use a\nuse :: b, only: c\nuse, intrinsic :: d, e => f\n") == [
        ("a", False),
        ("b", True),
        ("d", False),
    ]


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
    """Of the project's own modules."""
    assert {path.parent.name for path in SCRIPTS} == set(PYTHON_LAYERS)
    wrong = {
        (path.relative_to(ROOT).as_posix(), layer)
        for path, text in SCRIPTS.items()
        for layer in layers_imported(text)
        if PYTHON_LAYERS.index(layer) > PYTHON_LAYERS.index(path.parent.name)
    }
    assert wrong == set()

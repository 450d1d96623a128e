"""The house: Fortran modules look down the stairs only, and keep to its style."""

import re
from pathlib import Path

import pytest
from conftest import ROOT

FORTRAN = ROOT / "fortran"
BASE = {"base", "face"}
MAY_USE = {
    "base": BASE,
    "bindings": {"bindings"} | BASE,
    "linear": {"linear", "bindings"} | BASE,
    "dde": {"dde", "face"},
    "model": {"model"} | BASE,
    "measure": {"measure", "model"} | BASE,
    "analysis": {"analysis", "model", "linear", "bindings"} | BASE,
    "io": {"io", "analysis", "measure", "model", "files", "process"} | BASE,
    "app": {"io", "analysis", "measure", "model"} | BASE,
}
"""For each floor: the floors that its modules may use."""
LIBRARIES = {
    "bindings": {"iso_c_binding"},
    "dde": {"ieee_arithmetic", "iso_fortran_env"},
    "analysis": {"ieee_arithmetic", "iso_c_binding"},
    "io": {"ieee_arithmetic", "iso_fortran_env", "netcdf"},
    "base": {"ieee_arithmetic", "iso_fortran_env"},
    "model": {"ieee_arithmetic"},
    "measure": {"ieee_arithmetic"},
}
"""For each floor: modules of others that it may use."""
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


def floor_of(path: Path) -> str:
    """Name of the floor that a file lives on."""
    *folder, _ = path.relative_to(FORTRAN).parts
    if folder[0] == "dde":
        return "dde"
    return "base" if folder == ["src"] else folder[:2][-1]


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
MODULES = {path: text for path, text in SOURCES.items() if floor_of(path) != "app"}
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


def floors() -> dict[str, str]:
    """Floor of each module; those that others may use are floors of their own."""
    by_folder = {name_of(path): floor_of(path) for path in MODULES}
    faces = dict.fromkeys(("dde", "dde_errors", "dde_kinds"), "face")
    return by_folder | faces | {"files": "files", "process": "process"}


def violations(floor: str, text: str, known: dict[str, str]) -> list[str]:
    """Modules that a file on this floor uses and may not."""
    allowed = MAY_USE[floor]
    others = LIBRARIES.get(floor, set())
    return [
        f"{floor} uses {name}"
        for name, _ in uses_of(text)
        if (known[name] not in allowed if name in known else name not in others)
    ]


def each(files: dict[Path, str]):
    """Run a test on each of these files."""
    return pytest.mark.parametrize("path", files, ids=name_of)


def test_all_floors_are_there():
    """The table and the folders are the same."""
    assert {floor_of(path) for path in SOURCES} == set(MAY_USE)


@each(SOURCES)
def test_nobody_looks_up_the_stairs(path):
    """Modules use what lies below, and of the solver its facade."""
    assert violations(floor_of(path), SOURCES[path], floors()) == []


def test_facade_of_the_solver_uses_the_solver_only():
    """It passes names on."""
    uses = {name for name, _ in uses_of((FORTRAN / "dde" / "src" / "face" / "dde.f90").read_text())}
    assert len(uses) > 3
    assert all(name.startswith("dde_") for name in uses)


@pytest.mark.parametrize(
    ("floor", "line"),
    [
        ("base", "use dde_integrator, only: integrate"),
        ("bindings", "use spring_block, only: spring_block_type"),
        ("dde", "use spring_block, only: spring_block_type"),
        ("dde", "use lapack, only: solve"),
        ("linear", "use spring_block, only: spring_block_type"),
        ("linear", "use dde_integrator, only: integrate"),
        ("model", "use normal_form, only: first_lyapunov_coefficient"),
        ("dde", "use, intrinsic :: iso_c_binding, only: c_int"),
        ("model", "use dde_history, only: history_type"),
        ("model", "use fftw, only: fftw_plan_dft_r2c_1d"),
        ("model", "   USE :: netcdf_output, only: output_file"),
        ("model", "use measured_case, only: case_type"),
        ("analysis", "use measured_run, only: run_type"),
        ("measure", "use dde_integrator, only: integrate"),
        ("measure", "use cases_input, only: read_cases"),
        ("measure", "use files, only: rename_file"),
        ("analysis", "use hopf_input, only: hopf_settings"),
        ("analysis", "use netcdf, only: nf90_open"),
        ("analysis", "use dde_integrator"),
        ("analysis", "use files, only: rename_file"),
        ("io", "use gsl_roots, only: find_root"),
        ("io", "use dde_outcome, only: reached_end"),
        ("app", "use dde_outcome, only: reached_end"),
        ("app", "use nobody_knows, only: what"),
        ("analysis", "use dde_errors, &\n   only: raise\nuse netcdf_output, only: output_file"),
    ],
)
def test_violation_is_caught(floor, line):
    """The checker itself, on made-up lines."""
    assert len(violations(floor, line, floors())) == 1


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
    assert violations("analysis", line, floors()) == []


@each(MODULES)
def test_file_holds_the_module_of_its_name(path):
    """One module a file."""
    assert re.findall(r"^\s*module (?!procedure)(\w+)$", code_of(MODULES[path]), re.MULTILINE) == [
        name_of(path)
    ]


@each({path: text for path, text in SOURCES.items() if floor_of(path) == "app"})
def test_program_is_short(path):
    """Read, call, write; what is longer belongs on a lower floor."""
    assert re.findall(r"^\s*program (\w+)$", code_of(SOURCES[path]), re.MULTILINE)
    assert len(SOURCES[path].splitlines()) <= 60


@each(SOURCES)
def test_file_is_one_idea(path):
    """About 400 lines at most."""
    assert len(SOURCES[path].splitlines()) <= 400


@each(SOURCES)
def test_nothing_is_implicit(path):
    """Every module and program says so."""
    assert re.search(r"^\s*implicit none\b", code_of(SOURCES[path]), re.MULTILINE)


@each(MODULES)
def test_module_is_private(path):
    """And lists what is public."""
    said = re.findall(r"^\s*(private|public)\s*$", code_of(MODULES[path]), re.MULTILINE)
    assert said[0] == ("public" if name_of(path) in PUBLIC else "private")


@each(SOURCES)
def test_every_use_says_what_it_uses(path):
    """But for the two exceptions."""
    whole = {(name_of(path), name) for name, only in uses_of(SOURCES[path]) if not only}
    assert whole <= WITHOUT_ONLY


@each(MODULES)
def test_only_programs_print_and_stop(path):
    """Others hand an error back."""
    spoken = (
        r"^.*\b(?:error\s+stop|stop|print|write\s*\(\s*(?:\*|\w*error_unit|\w*output_unit))\b.*$"
    )
    found = re.findall(spoken, code_of(MODULES[path]), re.MULTILINE)
    assert bool(found) is (name_of(path) in MAY_SPEAK)


@each(SOURCES)
def test_every_real_number_has_its_kind(path):
    """1.0_wp, never 1.0 or 1d0."""
    literal = r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[ed][+-]?\d))(?:[ed][+-]?\d+)?(?!\w*_wp)(?![\w.])"
    code = re.sub(r"\.\w+\.", " ", code_of(SOURCES[path]))
    assert re.findall(literal, code) == []


@pytest.mark.parametrize("literal", ["1.0", "1.", ".5", "1e3", "1.0e-3", "2d0", "1.5d+3"])
def test_real_number_without_kind_is_caught(literal, tmp_path, monkeypatch):
    """The checker itself."""
    path = tmp_path / "made_up.f90"
    monkeypatch.setitem(SOURCES, path, f"x = {literal} + 1.0_wp*2\n")
    with pytest.raises(AssertionError):
        test_every_real_number_has_its_kind(path)


def test_versions_agree():
    """Of the programs, the citation and the changelog."""
    build = re.search(r"project\(.* VERSION (\S+)", (FORTRAN / "CMakeLists.txt").read_text())[1]
    citation = re.search(
        r"^version: \"?([\d.]+)", (ROOT / "CITATION.cff").read_text(), re.MULTILINE
    )[1]
    entries = re.findall(r"^## \[?v?(\d[\d.]*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert build == citation == entries[0]

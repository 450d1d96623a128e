"""What is made for the documents: the pages about the code, and the programs of the solver's
manual, built and run as they are printed."""

import math
import os
import re
import subprocess
import sys
from itertools import pairwise

import offline_pages
import pytest
from PIL import Image
from test_documents import blocks_of, prose_of

from conftest import ROOT, write_script
from scripts.files.tsv import read_table

FORTRAN = ROOT / "fortran"


def test_pages_about_the_code_are_made(project):
    """By FORD with the settings of docs/ford.md, then made to fetch nothing; a warning is a
    failure that leaves no pages."""
    pages, ford = project.folder / "results" / "docs", project.folder / "docs/.venv/bin/ford"
    write_script(project.folder / "tools/setup/setup.sh", "exit 0")
    write_script(ford.with_name("python"), "echo $* >results/docs/called")
    write_script(ford, "mkdir -p results/docs && echo 'Warning: a comment lost'")
    run = project.snakemake("docs")
    assert run.returncode != 0
    assert "Warning: a comment lost" in run.stdout
    assert not pages.exists()
    write_script(ford, "mkdir -p results/docs && echo $* > results/docs/index.html")
    run = project.snakemake("docs")
    assert run.returncode == 0, run.stdout
    assert (pages / "index.html").read_text() == "--quiet docs/ford.md\n"
    assert (pages / "called").read_text() == "docs/offline_pages.py results/docs\n"


def test_pages_fetch_nothing():
    """Bootstrap is a file beside them, MathJax is left out, links of their own are kept."""
    page = """<link href="https://cdn.example/bootstrap.min.css" rel="stylesheet"
        integrity="x"><script src="https://cdn.example/bootstrap.bundle.min.js"></script>
        <script src="https://cdn.example/MathJax.js?config=x" async></script>
        <link href="../css/local.css" rel="stylesheet"><a href="https://example.org">FORD</a>"""
    found = offline_pages.offline(page, "..")
    assert re.findall(r'(?:href|src)="(.*?)"', found) == [
        "../css/bootstrap.min.css",
        "../js/bootstrap.bundle.min.js",
        "../css/local.css",
        "https://example.org",
    ]


def test_unknown_fetch_is_refused():
    with pytest.raises(
        ValueError, match=r"fetches https://cdn\.example/new\.js; expected Bootstrap"
    ):
        offline_pages.offline('<script src="https://cdn.example/new.js"></script>', ".")


def test_everything_has_a_comment():
    """`!>` stands above modules, programs, types and procedures. Interfaces of other libraries are
    explained by pages of their own.

    FORD drops a first line such as `Name: text`.
    """
    procedure = re.compile(r"(?! *(?:end\b|!)) *(?:[\w(), =*:]+ )?(?:subroutine|function) \w+")
    thing = re.compile(r"\s*(?:module (?!procedure)\w+$|program \w+$|type(?:, [\w(), ]+)? :: \w+)")
    bare, dropped = [], []
    for path in (f for of in ("app", "src", "dde/src") for f in (FORTRAN / of).rglob("*.f90")):
        text = path.read_text()
        lines = re.sub(r"(?ms)^ +interface$.*?^ +end interface$", "", text).splitlines()
        for before, line in pairwise(["", *lines]):
            explained = before.strip().startswith("!>")
            if procedure.match(line) or thing.match(line):
                bare += [] if explained else [f"{path.name}: {line.strip()}"]
            elif not explained and re.match(r"\s*!> [\w-]+:(\s|$)", line):
                dropped.append(f"{path.name}: {line.strip()}")
    assert (bare, dropped) == ([], [])


MANUAL = "fortran/dde/README.md"


@pytest.fixture(scope="module")
def run_of(tmp_path_factory):
    """Lines that a program prints, built by the CMakeLists.txt of the manual; the solver is built
    once."""
    folder = tmp_path_factory.mktemp("mine")
    (folder / "CMakeLists.txt").write_text(blocks_of(MANUAL, "cmake")[0])
    build = folder / "build"
    # without optimisation, to build quickly
    settings = ["-D", "CMAKE_BUILD_TYPE=Debug", "-D", f"DDE={ROOT / 'fortran' / 'dde'}"]

    def run_of(source: str) -> list[str]:
        (folder / "mackey_glass.f90").write_text(source)
        for command in (
            ["cmake", "-S", folder, "-B", build, *settings],
            ["cmake", "--build", build],
            [build / "mine"],
        ):
            run = subprocess.run(command, capture_output=True, text=True)
            assert run.returncode == 0, run.stdout + run.stderr
        return run.stdout.splitlines()

    return run_of


def with_procedures(source: str, *procedures: str) -> str:
    """The second program of the manual with more procedures in its type."""
    names = re.findall(r"^pure subroutine (\w+)", "\n".join(procedures), re.MULTILINE)
    grown = source.replace("rhs\n   end type", f"rhs, {', '.join(names)}\n   end type")
    grown = grown.replace("end module", "\n".join([*procedures, "end module"]), 1)
    return grown.replace("delayed_sine(n=1,", "delayed_sine(analytic=.true., n=1,")


def test_values_in_the_manual():
    """The example, which test_solver_package.py runs, has the published values."""
    printed = re.findall(r"y\((\d+)\) = (\d+\.\d+)", prose_of(MANUAL))
    # as in fortran/dde/test/suites/test_dde_accuracy.f90
    assert printed == [("50", f"{1.060954362898:.6f}"), ("200", f"{1.186718107117:.6f}")]


@pytest.mark.parametrize(
    ("method", "added"), [("auto", ()), ("taylor", (1, 2)), ("radau9", (1, 2))]
)
def test_second_program_of_the_manual(run_of, method, added):
    """Maxima of sin t, and its values after going on, to 100 x tolerance; also with the procedures
    that the manual adds."""
    blocks = blocks_of(MANUAL, "fortran")
    source = blocks[0].replace('method="auto"', f'method="{method}"')
    if added:
        source = with_procedures(source, *(blocks[i] for i in added))
    lines = run_of(source)
    maxima = [float(line.split()[-1]) for line in lines if line.startswith("maximum")]
    assert maxima == pytest.approx([math.pi / 2, 5 * math.pi / 2, 9 * math.pi / 2], abs=2e-8)
    values = dict(map(float, line.split()) for line in lines if re.match(r"\d", line))
    assert values == pytest.approx({t: math.sin(t) for t in (16.0, 18.0, 20.0)}, abs=1e-8)
    assert lines[-1].split()[0] == "T"


def test_recipes_in_python_run(smoke, tmp_path):
    (tmp_path / "results").symlink_to(smoke.folder / "results")
    recipes = "".join(blocks_of("docs/results-in-python.md", "python"))
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", recipes],
        cwd=tmp_path, env={**os.environ, "MPLBACKEND": "agg"}, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    table = read_table(smoke.folder / "results" / "tables" / "attractors.tsv")
    classes = [row["class"].replace(" ", "_") for row in table if row["scene"] == "torus"]
    assert f"\n{classes}\n" in run.stdout
    with Image.open(tmp_path / "torus.png") as plot:
        assert plot.size == (800, 300)

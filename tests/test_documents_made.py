"""What is made for the documents: the pages about the code, and recipes that run."""

import os
import re
import subprocess
import sys
from itertools import pairwise

import offline_pages
import pytest
from PIL import Image
from test_documents import blocks_of

from conftest import ROOT
from scripts.files.tsv import read_table

FORTRAN = ROOT / "fortran"


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

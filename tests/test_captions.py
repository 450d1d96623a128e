"""Captions: their templates, numbers and verdicts, and the files that the run writes."""

import re

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from made_up_results import attractor_row, followed_cycles, hopf_curve, route_rows

from scripts.captions import numbers_of_motions, numbers_of_planes, numbers_of_solver
from scripts.captions.wording import count, joined, short
from scripts.captions.write_captions import IN_WORDS, caption_of
from scripts.claims.claims_results import VERDICTS
from scripts.claims.ledger import paper_claims
from scripts.figures.entries import FIGURES, template_of
from scripts.figures.entries import caption_of as path_of
from scripts.files.tsv import write_table
from scripts.page import captions

ROWS = {"settings": {"rows": {"a": {"scene": "mine", "paper": "a torus"}}, "end_shown": 10.0}}


@pytest.mark.parametrize("figure", FIGURES)
def test_caption_is_written_whole(figure, smoke):
    """In sentences that docutils reads, with nothing left of its template."""
    text = (smoke.folder / path_of(figure).replace("<results>", "results")).read_text()
    assert len(text.split()) >= 8
    assert text.rstrip().endswith(".")
    assert not re.search(r"[{}%]{2}|\bnan\b|None", text)
    assert captions.as_html(
        smoke.folder / path_of(figure).replace("<results>", "results")
    ).startswith("<p>")


def test_captions_say_whether_claims_hold(smoke):
    """By the ledger; each claim that a caption names is one of the list."""
    named = {
        figure: re.findall(r'verdict\("(\w+)"\)', (ROOT / template_of(figure)).read_text())
        for figure in FIGURES
    }
    assert {name for names in named.values() for name in names} <= set(paper_claims())
    without = [figure for figure, names in named.items() if not names]
    assert without == ["figure_1", "work_precision"]


@pytest.mark.parametrize("verdict", VERDICTS)
def test_verdicts_have_words(verdict, tmp_path):
    """Each its own."""
    template = tmp_path / "figure.rst"
    template.write_text('Its claim {{ verdict("one") }}.')
    figure = {"name": "figure", "template": template, "inputs": {}, "params": {}}
    assert (
        caption_of(figure, [{"id": "one", "verdict": verdict}]) == f"Its claim {IN_WORDS[verdict]}."
    )
    assert len(set(IN_WORDS.values())) == len(VERDICTS)


def test_claim_that_is_not_listed_is_an_error(tmp_path):
    """And so is a number that nobody gives."""
    template = tmp_path / "figure.rst"
    figure = {"name": "figure", "template": template, "inputs": {}, "params": {}}
    for text in ('{{ verdict("other") }}', "{{ number }}"):
        template.write_text(text)
        with pytest.raises(Exception, match=r"other|number"):
            caption_of(figure, [])


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (0.0984, "0.0984"),
        (-0.0112, "\N{MINUS SIGN}0.0112"),
        (1e8, ":math:`10^{8}`"),
        (2.5e-7, r":math:`2.5 \times 10^{-7}`"),
    ],
)
def test_numbers_in_sentences(value, words):
    """With true minus signs and powers of ten."""
    assert short(value) == words


def test_counts_and_lists_in_sentences():
    """In words up to ten, and with one thing or several."""
    assert [count(1, "branch", "branches"), count(3, "scene")] == ["one branch", "three scenes"]
    assert [count(0), count(12, "point")] == ["no", "12 points"]
    assert [joined(["a"]), joined(["a", "b", "c"])] == ["a", "a, b and c"]


def test_numbers_of_hopf_curves(tmp_path):
    """Of made-up curves: 12 points of one branch, one of them subcritical, one off the boundary."""
    curves = hopf_curve()
    curves["l1"][3] = 0.2
    curves["unstable_pairs"][curves.epsilon.values.argmax()] = 1
    curves["crossing"][:4] = -1
    curves["special_kind"] = ("special", np.array(["hopf_without_delay"]))
    curves["special_epsilon"] = ("special", [0.28])
    curves.drop_vars("xi").to_netcdf(tmp_path / "curves.nc")
    scenes = {"in_it": {"epsilon": 0.5, "tau": 10.0, "xi": 0.5, "gamma": 0.8}}
    found = numbers_of_planes.of_hopf_curves({"curves": tmp_path / "curves.nc"}, {"scenes": scenes})
    counts = ("branches", "points", "subcritical", "stabilising", "double")
    assert [found[name] for name in counts] == [1, 12, 1, 4, 0]
    assert found["without_delay"] == [0.28]
    assert found["inside"] == ["in it"]
    ordered = np.sort(curves.epsilon.values)
    assert found["boundary"] == (short(ordered[0]), short(ordered[-2]))


def test_numbers_of_trajectories(tmp_path):
    """The end of v, the class and the period of made-up motions."""
    time = np.arange(0.0, 40.0, 0.1)
    v = 1 + np.where(time < 20, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    xr.Dataset({"v": ("t", v)}, {"t": time}).to_netcdf(tmp_path / "run.nc")
    given = {"trajectories": [tmp_path / "run.nc"], "table": tmp_path / "attractors.tsv"}

    def row_where(*rows: dict) -> dict:
        write_table(given["table"], list(rows))
        return numbers_of_motions.of_trajectories(given, ROWS)["rows"]["a"]

    cycle = row_where(attractor_row("cycle"), attractor_row("chaos", history=2))
    assert (cycle["paper"], cycle["met"]) == ("a torus", "limit cycle")
    assert cycle["end"] == "between 0.5 and 1.5 with a period of 10"
    rest = row_where(attractor_row("fixed point"))
    assert rest["end"] == "0.5 or less from steady sliding, :math:`v = 1`"
    assert row_where(attractor_row("torus", "other"))["met"] == "unknown"


def test_numbers_of_routes(tmp_path):
    """Where each class is met first along the first run, in the order of the parameter."""
    rows = route_rows("cycle", "torus", "cycle", "undecided", "chaos", run="near")
    rows += route_rows("chaos", "chaos", "chaos", "chaos", "chaos", run="up")
    write_table(tmp_path / "route.tsv", rows)
    (route,) = numbers_of_planes.of_routes({"tables": [tmp_path / "route.tsv"]}, {})["routes"]
    assert route == {
        "letter": "a",
        "symbol": r"\tau",
        "first": "cycle 0.1, torus 0.2 and chaos 0.5",
    }


def test_numbers_of_cycles(tmp_path):
    """Branches, special points and stable stretches of the made-up lines."""
    followed_cycles().to_netcdf(tmp_path / "cycles.nc")
    (line,) = numbers_of_planes.of_cycles({"cycles": [tmp_path / "cycles.nc"]}, {})["lines"]
    assert line["branches"] == 2
    assert line["points"] == ["one fold", "one torus bifurcation", "two period doublings"]
    assert line["stable"] == ["0.6 to 0.7"]


def test_numbers_of_the_solver(tmp_path):
    """Completed runs, and those with the error that is expected; the fastest method."""
    runs = [
        {"method": "auto", "status": "ok", "error": 1e-8, "error_expected": 1e-9},
        {"method": "auto", "status": "ok", "error": 2e-7, "error_expected": 1e-9},
        {"method": "auto", "status": "stopped", "error": 1.0, "error_expected": 1e-9},
    ]
    write_table(tmp_path / "stability.tsv", [{**row, "tolerance": 1e-9} for row in runs])
    found = numbers_of_solver.of_stability({"table": tmp_path / "stability.tsv"}, {})
    counts = {"runs": 3, "completed": 2, "measured": 2, "within": 1}
    assert found["methods"] == [{"name": "auto", **counts}]

    base = {"scene": "mine", "t_end": 10.0, "tolerance": 1e-8}
    ours = [
        {**base, "solver": "slow", "error_max": 1e-9, "seconds": 4.0},
        {**base, "solver": "fast", "error_max": 1e-7, "seconds": 2.0},
        {**base, "solver": "rough", "error_max": 1e-3, "seconds": 1.0},
    ]
    others = [
        {**base, "solver": "ours", "error_max": 1e-9, "seconds": 1.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 6.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 3.0, "t_end": 5.0},
    ]
    # a scene without a run of another solver that is as long
    ours.append({**ours[0], "scene": "other", "t_end": 5.0})
    write_table(tmp_path / "ours.tsv", ours)
    write_table(tmp_path / "others.tsv", others)
    measured = tmp_path / "others.tsv"
    measured.write_text("# date: 2026-11-22\n" + measured.read_text())
    given = {"table": tmp_path / "ours.tsv", "others": measured}
    found = numbers_of_solver.of_work_precision(given, {})
    assert found["fastest"] == ["fast (in one scene)", "slow (in one scene)"]
    assert (found["ratios"], found["date"]) == (["3", "3"], "2026-11-22")

"""Captions: their templates, numbers and verdicts, of the paper's figures and of users' files."""

import math
import re

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from jinja2 import nodes
from made_up_results import attractor_row, hopf_curve, route_rows
from matplotlib import pyplot as plt

from scripts.claims.claims_results import VERDICTS
from scripts.claims.ledger import paper_claims
from scripts.figures import figure_4, plane, stability, work_precision
from scripts.drawing.wording import as_formulas, count, joined, short, shortened
from scripts.drawing.write_captions import ENVIRONMENT, render
from scripts.drawing.write_captions import caption_of as caption_from
from scripts.files.tsv import write_table
from scripts.page import captions
from scripts.plans.registry import FIGURES, OF_USERS, caption_of, template_of
from scripts.tables.attractor_tables import same_attractor


@pytest.mark.parametrize("figure", FIGURES)
def test_caption_is_written_whole(figure, smoke):
    """In sentences that docutils reads, with nothing left of its template."""
    path = smoke.folder / caption_of(figure).replace("<results>", "results")
    text = path.read_text()
    assert len(text.split()) >= 8
    assert text.rstrip().endswith(".")
    assert not re.search(r"[{}%]{2}|\bnan\b|None", text)
    sentence = captions.first_sentence(captions.as_html(path))
    assert len(sentence.split()) >= 4
    assert sentence.endswith(".")
    assert not re.search(r"[\\<>`:]{2}|\\", sentence)


def test_captions_say_whether_claims_hold():
    """Each claim that a caption names is one of the list."""
    named = {
        figure: re.findall(r'verdict\("(\w+)"\)', (ROOT / template_of(figure)).read_text())
        for figure in FIGURES
    }
    assert {name for names in named.values() for name in names} <= set(paper_claims())
    without = [figure for figure, names in named.items() if not names]
    assert without == ["figure_1", "work_precision", "synchrony", "chain_modes"]


@pytest.mark.parametrize("kind", OF_USERS)
def test_captions_of_users_say_nothing_of_the_papers_claims(kind):
    """A file of one's own may have no claims: verdicts stand within `if paper` alone."""
    tree = ENVIRONMENT.parse((ROOT / template_of(f"{kind}/mine")).read_text())
    allowed = [
        call
        for branch in tree.find_all(nodes.If)
        if isinstance(branch.test, nodes.Name) and branch.test.name == "paper"
        for part in branch.body
        for call in part.find_all(nodes.Call)
    ]
    calls = [call for call in tree.find_all(nodes.Call) if call.node.name == "verdict"]
    assert [call for call in calls if call not in allowed] == []


def test_plane_without_a_curve_has_a_figure_and_a_caption(smoke):
    """In the window of the file."""
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / "tau_of_epsilon.nc")
    empty = curves.isel(point=slice(0), special=slice(0))
    figure = plane.draw(empty, {})
    window = (0.0, pytest.approx(1.5)), (0.0, pytest.approx(20.0))
    assert (figure.axes[0].get_xlim(), figure.axes[0].get_ylim()) == window
    plt.close(figure)
    text = (ROOT / template_of("planes/mine")).read_text()
    caption = render(text, [], paper=False, **plane.numbers(empty, {}))
    assert caption.startswith("No Hopf curve lies in this plane, at ")
    assert "Lyapunov" not in caption


@pytest.mark.parametrize("text", ['{{ verdict("other") }}', "{{ other }}"])
def test_claim_or_number_that_is_not_there_is_an_error(text):
    with pytest.raises(Exception, match="other"):
        render(text, [])


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (short(0.0984), "0.0984"),
        (short(-0.0112), "\N{MINUS SIGN}0.0112"),
        (short(1e8), ":math:`10^{8}`"),
        (short(2.5e-7), r":math:`2.5 \times 10^{-7}`"),
        (count(1, "branch", "branches"), "one branch"),
        (count(3, "scene"), "three scenes"),
        (count(0), "no"),
        (count(12, "point"), "12 points"),
        (joined(["a"]), "a"),
        (joined(["a", "b", "c"]), "a, b and c"),
        (shortened("abcdefgh"), "a, b, c, d, e, f, g and h"),
        (shortened("abcdefghi"), "a, …, i"),
        (as_formulas(r"$\tau = 2$ or $u$"), r":math:`\tau = 2` or :math:`u`"),
    ],
)
def test_numbers_and_lists_in_sentences(words, expected):
    """True minus signs, powers of ten, counts in words up to ten, formulas of captions."""
    assert words == expected


def test_numbers_of_trajectories():
    """Maxima on the attractor, not on a part of the run, the class and the period."""
    time = np.arange(0.0, 20.0, 0.1)
    v = 1 + np.where(time < 9.9, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    settings = {"rows": {"a": {"scene": "mine"}}, "end_shown": 10.0}

    def row_where(*table: dict) -> dict:
        trajectory = xr.Dataset({"v": ("t", v)}, {"t": time})
        return figure_4.numbers([trajectory], list(table), settings)["rows"]["a"]

    peaks = {"smallest_maximum": 2e9, "largest_maximum": 2e9}
    cycle = row_where(attractor_row("cycle", **peaks), attractor_row("chaos", history=2))
    words = "maxima of v are :math:`2 \\times 10^{9}` with a period of 10"
    assert cycle == {"motion": "limit cycle", "end": words}
    rest = row_where(attractor_row("fixed point"))
    assert rest["end"] == "at the end v is 0.5 or less from steady sliding, :math:`v = 1`"
    assert row_where(attractor_row("torus", "other"))["motion"] == "unknown"


def test_numbers_of_stability():
    """Completed runs, and those with the error that is expected."""
    run = {"method": "auto", "tolerance": 1e-9, "error_expected": 1e-9}
    ended = [run | {"status": "ok", "error": error} for error in (1e-8, 2e-7)]
    found = stability.numbers([*ended, run | {"status": "stopped", "error": 1.0}])
    counts = {"runs": 3, "completed": 2, "measured": 2, "within": 1}
    assert found["methods"] == [{"name": "auto", **counts}]


def test_numbers_of_work_and_precision():
    """The fastest method of each scene; other solvers count where their runs are as long."""
    base = {"scene": "mine", "t_end": 10.0, "tolerance": 1e-8}
    ours = [
        {**base, "solver": "slow", "error_max": 1e-9, "seconds": 4.0},
        {**base, "solver": "fast", "error_max": 1e-7, "seconds": 2.0},
        {**base, "solver": "rough", "error_max": 1e-3, "seconds": 1.0},
    ]
    ours.append({**ours[0], "scene": "other", "t_end": 5.0})
    others = [
        {**base, "solver": "ours", "error_max": 1e-9, "seconds": 1.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 6.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 3.0, "t_end": 5.0},
    ]
    found = work_precision.numbers(ours, others, "2026-11-22")
    assert found["fastest"] == ["fast (in one scene)", "slow (in one scene)"]
    assert found["ratios"] == ["3", "3"]


def test_numbers_of_a_plane():
    """Counts along the curves, the boundary, and special points with their places."""
    curves = hopf_curve()
    curves["l1"][3] = 0.2
    curves["unstable_pairs"][curves.epsilon.values.argmax()] = 1
    curves["crossing"][:4] = -1
    curves["map_unstable_pairs"] = (("map_y", "map_x"), [[0, 0], [0, 1]])
    kinds = ["double_hopf", "hopf_without_delay", "double_hopf"]
    curves["special_kind"] = ("special", np.array(kinds))
    curves["special_epsilon"] = ("special", [1.143, 0.28, 0.336])
    curves["special_tau"] = ("special", [3.343, 0.0, 13.4])
    found = plane.numbers(curves, {})
    assert (found["stabilising"], found["double"], found["without_delay"]) == (4, 2, [0.28])
    ordered = np.sort(curves.epsilon.values)
    assert found["boundary"] == (short(ordered[0]), short(ordered[-2]))


def test_caption_of_a_route(tmp_path):
    """Where classes first appear, runs that agree, and where motions coexist."""
    kept = {"smallest_maximum": 2.0, "largest_maximum": 3.0, "problem": math.nan}
    kept |= {"exponent_1": 0.02, "error_1": 0.001}
    rows = [
        row | kept
        for run, last in (("near", "chaos"), ("slip", "torus"), ("up", "chaos"))
        for row in route_rows("cycle/1", "torus", "cycle/2", "undecided", last, run=run)
    ]
    # a cycle of another size
    rows[7] |= {"smallest_maximum": 4.0, "largest_maximum": 5.0}
    write_table(tmp_path / "route.tsv", rows)
    claims = [{"id": name, "verdict": VERDICTS[0]} for name in paper_claims()]
    inputs = {"tables": [tmp_path / "route.tsv"]}
    words = " ".join(caption_from("routes/mine", inputs, {}, claims).split())
    assert "15 points. In runs near and up each class first appears at this value" in words
    assert "motions at 2 of 5 values of :math:`\\tau`: 0.3 and 0.5." in words


def test_rows_of_tables_and_of_files_are_compared_alike():
    """A table's empty cell for the problem of a run is no problem."""
    one = attractor_row("cycle", smallest_maximum=2.0, problem=math.nan)
    assert same_attractor(one, one | {"problem": ""})
    assert same_attractor(one | {"problem": ""}, one)
    assert not same_attractor(one | {"problem": "it stopped"}, one)

"""Captions: their templates, numbers and verdicts, of the paper's figures and of users' files."""

import math
import re

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from made_up_results import PLACE, attractor_row, followed_cycles, hopf_curve, route_rows

from scripts.claims.claims_results import VERDICTS
from scripts.claims.ledger import paper_claims
from scripts.drawing.spectra import BASE, HARMONIC
from scripts.figures import figure_4, plane, routes, scene, stability, work_precision
from scripts.figures.registry import FIGURES, caption_of, template_of
from scripts.figures.wording import as_formulas, count, joined, short, shortened
from scripts.figures.write_captions import IN_WORDS, render
from scripts.figures.write_captions import caption_of as caption_from
from scripts.files.tsv import write_table
from scripts.page import captions
from scripts.tables.attractor_tables import same_attractor


def words_of(figure: str, inputs: dict, **params) -> str:
    """The caption of a figure, on one line; verdicts are not of interest."""
    claims = [{"id": name, "verdict": VERDICTS[0]} for name in paper_claims()]
    return " ".join(caption_from(figure, inputs, params, claims).split())


@pytest.mark.parametrize("figure", FIGURES)
def test_caption_is_written_whole(figure, smoke):
    """In sentences that docutils reads, with nothing left of its template."""
    path = smoke.folder / caption_of(figure).replace("<results>", "results")
    text = path.read_text()
    assert len(text.split()) >= 8
    assert text.rstrip().endswith(".")
    assert not re.search(r"[{}%]{2}|\bnan\b|None", text)
    assert captions.as_html(path).startswith("<p>")


def test_captions_say_whether_claims_hold():
    """Each claim that a caption names is one of the list."""
    named = {
        figure: re.findall(r'verdict\("(\w+)"\)', (ROOT / template_of(figure)).read_text())
        for figure in FIGURES
    }
    assert {name for names in named.values() for name in names} <= set(paper_claims())
    without = [figure for figure, names in named.items() if not names]
    assert without == ["figure_1", "work_precision"]


@pytest.mark.parametrize("verdict", VERDICTS)
def test_verdicts_have_words(verdict):
    """Each other words."""
    claims = [{"id": "one", "verdict": verdict}]
    assert render('Its claim {{ verdict("one") }}.', claims) == f"Its claim {IN_WORDS[verdict]}."
    assert len(set(IN_WORDS.values())) == len(VERDICTS)


@pytest.mark.parametrize("text", ['{{ verdict("other") }}', "{{ other }}"])
def test_claim_or_number_that_is_not_there_is_an_error(text):
    """The message names it."""
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
    """The end of v, the class and the period of made-up motions."""
    time = np.arange(0.0, 20.0, 0.1)
    v = 1 + np.where(time < 9.9, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    settings = {"rows": {"a": {"scene": "mine"}}, "end_shown": 10.0}

    def row_where(*table: dict) -> dict:
        trajectory = xr.Dataset({"v": ("t", v)}, {"t": time})
        return figure_4.numbers([trajectory], list(table), settings)["rows"]["a"]

    cycle = row_where(attractor_row("cycle"), attractor_row("chaos", history=2))
    words = "between 0.5 and 1.5 with a period of 10"
    assert cycle == {"motion": "limit cycle", "end": words}
    rest = row_where(attractor_row("fixed point"))
    assert rest["end"] == "0.5 or less from steady sliding, :math:`v = 1`"
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


def attractors_of(met: str, period: int) -> xr.Dataset:
    """What was found from one history, with three exponents."""
    classes = {"flag_meanings": "undecided fixed_point cycle torus 3-torus chaos"}
    kind = classes["flag_meanings"].split().index(met)
    flags = dict.fromkeys(("class", "by_exponents", "by_section", "by_spectrum"), kind)
    values = dict.fromkeys(
        ("smallest_maximum", "largest_maximum", "time", "roughness", "base_2", "base_3"), 0.0
    )
    values |= {"base_1": 0.1, "period": period, "problem": "", **PLACE}
    values |= {f"history_{key}": 1.0 for key in ("theta", "u", "v")}
    return xr.Dataset(
        {
            **{name: ("point", [value], classes) for name, value in flags.items()},
            **{name: ("point", [value]) for name, value in values.items()},
            "reason": ("point", [1], {"flag_meanings": "none not_confirmed"}),
            "lyapunov_exponent": (("point", "exponent"), [[0.0, -0.0141, math.nan]]),
            "lyapunov_error": (("point", "exponent"), [[0.0, 0.002, math.nan]]),
        }
    )


def test_caption_of_a_scene(tmp_path):
    """Class, end, period, exponents, fundamental frequency and roots."""
    time = np.arange(0.0, 400.0, 0.1)
    v = 1 + np.where(time < 202.5, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    made = {
        "trajectory": xr.Dataset({"v": ("t", v)}, {"t": time}, PLACE),
        "spectrum": xr.Dataset(
            {"base_frequency": ("base", [0.1]), "peak_kind": ("peak", [BASE, HARMONIC])},
            attrs={"spectrum_kind": "periodic"},
        ),
        "attractors": attractors_of("cycle", period=1),
        "roots": xr.Dataset(
            {"root_real": ("root", [-0.2, 0.03]), "root_imag": ("root", [0.0, 0.8])},
            attrs={"unstable_pairs": 1},
        ),
    }
    paths = {name: tmp_path / f"{name}.nc" for name in made}
    for name, data in made.items():
        data.to_netcdf(paths[name])
    words = words_of("scenes/mine", paths)
    assert words.startswith(
        r"The motion at :math:`\tau = 10`, :math:`\varepsilon = 0.5`, :math:`\xi = 0.8`,"
        r" :math:`\gamma = 0.8` is a limit cycle; at the end v is between 0.5 and 1.5 with a"
        " period of 10. The largest Lyapunov exponents are 0 and −0.0141 ± 0.002 (e)."
        " Seen in the spectrum (f): periodic, :math:`f_1` = 0.1000 and its harmonics."
        r" Steady sliding is unstable (1 unstable pair of roots, rightmost"
        r" :math:`\lambda = 0.03 \pm 0.8\,i`)."
    )
    assert "higher than drawn" not in words
    # two time units apart, the samples nearest to a maximum of 4 have 3.7: 8 % less
    coarse = made["trajectory"].isel(t=slice(7, None, 20))
    missed = scene.numbers(**made | {"trajectory": coarse})["missed"]
    assert 4 <= float(missed) < 10


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"class": "chaos"}, "chaotic"),
        ({"class": "cycle", "period": 3.0}, "a limit cycle with 3 points in its section"),
        ({"class": "undecided"}, "of no class that can be decided (not confirmed)"),
        ({"class": "undecided", "problem": "it stopped"}, "without a class (it stopped)"),
    ],
)
def test_motions_in_words(given, words):
    """Also those without a class."""
    row = attractor_row(given["class"], problem="", period=1.0) | given
    assert scene.motion_in_words(row | {"reason": "not confirmed"}) == words


def test_caption_of_exponents(tmp_path):
    """Of the scene that is drawn alone, at its own step."""
    measured = {"dimension": 1.5, "dimension_error": 0.25, "mean_step": 0.8}
    first = {**measured, "scene": "mine", "exponent": 0.02, "error": 0.004, "sign": "positive"}
    zero = {**first, "exponent": 0.0, "error": 0.0, "sign": "zero"}
    rows = [{**first, "scene": "other"}, first, zero, {**first, "mean_step": 0.1}]
    write_table(tmp_path / "exponents.tsv", rows)
    xr.Dataset(attrs={"scene": "mine"}).to_netcdf(tmp_path / "mine.nc")
    inputs = {"runs": [tmp_path / "mine.nc"], "table": tmp_path / "exponents.tsv"}
    words = words_of("exponents/mine", inputs)
    assert (
        "Scene mine has one zero exponent and one positive; the largest is 0.02 ± 0.004."
        " All are 0.02 ± 0.004 and 0. The Kaplan-Yorke dimension is 1.5 ± 0.25."
    ) in words
    assert "paper" not in words
    assert "The paper's claim" in words_of("exponents", inputs)


def test_caption_of_a_plane(tmp_path):
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
    curves = curves.drop_vars("xi")
    curves.to_netcdf(tmp_path / "plane.nc")
    words = words_of("planes/mine", {"curves": tmp_path / "plane.nc"}, scenes={"in_it": PLACE})
    assert words.startswith(
        r"One branch of Hopf curves at :math:`\xi = 0.5`, :math:`\gamma = 0.8`, supercritical at"
        " 11 of 12 points (solid lines) and subcritical at 1 (dashed lines). Steady sliding is"
        " stable in 75 % of the plane (no shade)."
    )
    assert (
        "two double Hopf points at (0.336, 13.4) and (1.14, 3.34); one Hopf point without delay"
        " at (0.28, 0). Scenes in this plane: in it."
    ) in words
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
    words = words_of("routes/mine", {"tables": [tmp_path / "route.tsv"]})
    assert words.startswith(
        r"Route along :math:`\tau` at :math:`\varepsilon = 0.5`, :math:`\xi = 0.8`,"
        r" :math:`\gamma = 0.8`: 15 points. In runs near and up each class first appears at this"
        r" value of :math:`\tau`: cycle 0.1, torus 0.2 and chaos 0.5. In run slip each class first"
        r" appears at this value of :math:`\tau`: cycle 0.1 and torus 0.2. Runs reach different"
        r" motions at 2 of 5 values of :math:`\tau`: 0.3 and 0.5."
    )
    rows = [row for row in rows if row["run"] == "near"]
    assert routes.numbers([rows])["routes"][0]["several"] == []


def test_caption_of_an_atlas(tmp_path):
    """Shares of the classes, and the largest exponent of the computed points."""
    rows = [attractor_row(met) for met in ("cycle", "cycle", "cycle", "chaos")]
    rows[3] |= {"exponent_1": 0.05, "error_1": 0.004, "tau": 7.0}
    rows[0] |= {"exponent_1": math.nan}
    write_table(tmp_path / "atlas.tsv", rows)
    assert (
        r"At :math:`\xi` = 0.8 and :math:`\gamma` = 0.8 (a, b) the points are cycle 75 %, chaos"
        r" 25 %. The largest Lyapunov exponent is 0.05 ± 0.004, at :math:`\tau = 7`,"
        r" :math:`\varepsilon = 0.4`."
    ) in words_of("atlas/mine", {"table": tmp_path / "atlas.tsv"})


def test_caption_of_cycles(tmp_path):
    """Where cycles are stable, Hopf points and special points."""
    followed_cycles().to_netcdf(tmp_path / "cycles.nc")
    assert (
        "Line (a) has two branches, with one fold, one torus bifurcation and two period doublings;"
        r" cycles are stable at :math:`\tau` = 0.6 to 0.7. The line is at"
        r" :math:`\varepsilon = 0.5`, :math:`\xi = 0.8`, :math:`\gamma = 0.8`."
        r" Hopf points of steady sliding are at :math:`\tau` = 0.1. On the branches: one fold at"
        " 0.45; one torus bifurcation at 0.3; two period doublings at 0.7 and 0.7."
    ) in words_of("cycles/mine", {"cycles": [tmp_path / "cycles.nc"]})


def test_rows_of_tables_and_of_files_are_compared_alike():
    """A table's empty cell for the problem of a run is no problem."""
    one = attractor_row("cycle", smallest_maximum=2.0, problem=math.nan)
    assert same_attractor(one, one | {"problem": ""})
    assert same_attractor(one | {"problem": ""}, one)
    assert not same_attractor(one | {"problem": "it stopped"}, one)

"""Captions of figures of users' files: their numbers, from small made-up files."""

import math
import re

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from made_up_results import PLACE, attractor_row, followed_cycles, hopf_curve, route_rows

from scripts.captions import numbers_of_own_figures as numbers
from scripts.captions.wording import as_formulas, listed
from scripts.captions.write_captions import caption_of
from scripts.drawing.spectrum_rows import BASE, HARMONIC
from scripts.figures.entries import OF_ONES_OWN, entry_of
from scripts.files.tsv import write_table
from scripts.tables.attractor_tables import same_attractor


def caption(kind: str, **given) -> str:
    """The caption of a figure of this kind, on one line."""
    name = entry_of(f"{kind}/mine").caption
    template = ROOT / "scripts" / "figures" / f"{name}.rst"
    params = {"scenes": {}}
    figure = {"name": name, "template": template, "inputs": given, "params": params}
    return " ".join(caption_of(figure, []).split())


def attractors_of(met: str, period: int = 0, problem: str = "") -> xr.Dataset:
    """What was found from one history, with three exponents."""
    classes = {"flag_meanings": "undecided fixed_point cycle torus 3-torus chaos"}
    kind = classes["flag_meanings"].split().index(met)
    flags = dict.fromkeys(("class", "by_exponents", "by_section", "by_spectrum"), kind)
    values = dict.fromkeys(
        ("smallest_maximum", "largest_maximum", "time", "roughness", "base_2", "base_3"), 0.0
    )
    values |= {"base_1": 0.1, "period": period, "problem": problem, **PLACE}
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
    for name, data in made.items():
        data.to_netcdf(tmp_path / f"{name}.nc")
    words = caption("scenes", **{name: tmp_path / f"{name}.nc" for name in made})
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
    made["trajectory"].isel(t=slice(7, None, 20)).to_netcdf(tmp_path / "coarse.nc")
    paths = {name: tmp_path / f"{name}.nc" for name in made}
    words = caption("scenes", **paths | {"trajectory": tmp_path / "coarse.nc"})
    assert re.search(r"Maxima of v are about [4-9]\.\d % higher than drawn", words), words


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
    assert numbers.motion_of(row | {"reason": "not confirmed"}) == words


def test_caption_of_exponents(tmp_path):
    """Of the scene that is drawn alone, at its own step."""
    measured = {"dimension": 1.5, "dimension_error": 0.25, "mean_step": 0.8}
    first = {**measured, "scene": "mine", "exponent": 0.02, "error": 0.004, "sign": "positive"}
    zero = {**first, "exponent": 0.0, "error": 0.0, "sign": "zero"}
    rows = [{**first, "scene": "other"}, first, zero, {**first, "mean_step": 0.1}]
    write_table(tmp_path / "exponents.tsv", rows)
    words = caption("exponents", runs=["mine.nc"], table=tmp_path / "exponents.tsv")
    assert words.startswith(
        "The motion has one zero Lyapunov exponent and one positive one: 0.02 ± 0.004 and 0."
        " The Kaplan-Yorke dimension is 1.5 ± 0.25."
    )


def test_caption_of_a_plane(tmp_path):
    """The share that is stable, and special points with their places."""
    curves = hopf_curve().drop_vars("xi")
    curves["l1"][3] = 0.2
    curves["map_unstable_pairs"] = (("map_y", "map_x"), [[0, 0], [0, 1]])
    kinds = ["double_hopf", "hopf_without_delay", "double_hopf"]
    curves["special_kind"] = ("special", np.array(kinds))
    curves["special_epsilon"] = ("special", [1.143, 0.28, 0.336])
    curves["special_tau"] = ("special", [3.343, 0.0, 13.4])
    curves.to_netcdf(tmp_path / "plane.nc")
    words = caption("planes", curves=tmp_path / "plane.nc")
    assert words.startswith(
        r"One branch of Hopf curves at :math:`\xi = 0.5`, :math:`\gamma = 0.8`, supercritical at"
        " 11 of 12 points (solid lines) and subcritical at 1 (dashed lines). Steady sliding is"
        " stable in 75 % of the plane (no shade)."
    )
    assert (
        "two double Hopf points at (0.336, 13.4) and (1.14, 3.34); one Hopf point without delay"
        " at (0.28, 0)."
    ) in words


def test_caption_of_a_route(tmp_path):
    """Classes with the values where they change, runs that agree, and where motions coexist."""
    kept = {"smallest_maximum": 2.0, "largest_maximum": 3.0, "problem": math.nan}
    kept |= {"exponent_1": 0.02, "error_1": 0.001}
    rows = [
        row | kept
        for run, last in (("near", "chaos"), ("slip", "torus"), ("up", "chaos"))
        for row in route_rows("cycle/1", "cycle/1", "cycle/2", "undecided", last, run=run)
    ]
    # a cycle of another size
    rows[7] |= {"smallest_maximum": 4.0, "largest_maximum": 5.0}
    write_table(tmp_path / "route.tsv", rows)
    words = caption("routes", tables=[tmp_path / "route.tsv"])
    assert words.startswith(
        r"Classes of motion along :math:`\tau` at :math:`\varepsilon = 0.5`, :math:`\xi = 0.8`,"
        r" :math:`\gamma = 0.8`: cycle at 0.1 to 0.2, multi-loop cycle at 0.3, undecided at 0.4"
        " and chaos at 0.5 (runs near and up). Run slip: cycle at 0.1 to 0.2, multi-loop cycle"
        " at 0.3, undecided at 0.4 and torus at 0.5. Runs reach different motions at 2 of 5"
        r" values of :math:`\tau`: 0.3 and 0.5."
    )


def test_long_sequences_of_classes_are_counted():
    """At how many values each class is met, where first and last, and how often it changes."""
    rows = route_rows(*["cycle/1", "torus"] * 6, "chaos", "torus", "torus")[::-1]
    assert numbers.sequence(rows, "tau") == (
        "among 15 values, cycle at 6 (first 0.1, last 1.1), torus at 8 (first 0.2, last 1.5) and"
        " chaos at 1 (1.3), with 13 changes"
    )
    listed = numbers.sequence(rows[:12], "tau")
    assert listed.startswith("cycle at 0.1, torus at 0.2, cycle at 0.3")
    assert listed.endswith("cycle at 1.1 and torus at 1.2")


def test_caption_of_an_atlas(tmp_path):
    """Shares of the classes, and the largest exponent of the computed points."""
    rows = [attractor_row(met) for met in ("cycle", "cycle", "cycle", "chaos")]
    rows[3] |= {"exponent_1": 0.05, "error_1": 0.004, "tau": 7.0}
    rows[0] |= {"exponent_1": math.nan}
    write_table(tmp_path / "atlas.tsv", rows)
    assert caption("atlas", table=tmp_path / "atlas.tsv").startswith(
        r"Classes of motion at :math:`\xi` = 0.8 and :math:`\gamma` = 0.8: the points are"
        " cycle 75 %, chaos 25 %. The largest Lyapunov exponent is 0.05 ± 0.004, at"
        r" :math:`\tau = 7`, :math:`\varepsilon = 0.4`."
    )


def test_caption_of_cycles(tmp_path):
    """Where cycles are stable, Hopf points and special points."""
    followed_cycles().to_netcdf(tmp_path / "cycles.nc")
    words = caption("cycles", cycles=[tmp_path / "cycles.nc"])
    assert words.startswith(
        r"Two branches of cycles along :math:`\tau` at :math:`\varepsilon = 0.5`,"
        r" :math:`\xi = 0.8`, :math:`\gamma = 0.8`; cycles are stable at :math:`\tau` = 0.6 to 0.7."
        r" Hopf points of steady sliding are at :math:`\tau` = 0.1. On the branches: one fold at"
        " 0.45; one torus bifurcation at 0.3; two period doublings at 0.7 and 0.7."
    )


def test_all_kinds_are_tested():
    """A new kind of figure needs a caption with numbers, too."""
    assert {entry_of(f"{kind}/mine").caption for kind in OF_ONES_OWN} == set(numbers.NUMBERS)


def test_wording():
    """Formulas of figures, and many values."""
    assert as_formulas(r"$\tau = 2$ or $u$") == r":math:`\tau = 2` or :math:`u`"
    assert listed(list("abcdefgh")) == "a, b, c, d, e, f, g and h"
    assert listed(list("abcdefghi")) == "a, …, i"


def test_rows_of_tables_and_of_files_are_compared_alike():
    """A table's empty cell for the problem of a run is no problem."""
    one = attractor_row("cycle", smallest_maximum=2.0, problem=math.nan)
    assert same_attractor(one, one | {"problem": ""})
    assert same_attractor(one | {"problem": ""}, one)
    assert not same_attractor(one | {"problem": "it stopped"}, one)

"""The linear_stability program: roots and changes of stability of the scenes, tables, verdicts."""

import math

import numpy as np
import pytest
from characteristic_equation import residual
from made_up_results import NO, YES, assert_finding, cases, changing

from scripts.claims.filters import with_changes
from scripts.files.tsv import read_table
from scripts.models.models import PARAMETERS
from scripts.studies.linear_stability.table import amplitude_death, row_of
from scripts.tables.roots_of_5 import unstable_roots

SCENES = {"fixed_point": 0, "oscillation": 2, "torus": 2, "chaos": 2}
SCENES |= {"true_torus": 2, "stick_slip": 2}
SCENES |= dict.fromkeys(["no_delay", "no_delay_stuck", "no_delay_fast"], 2)
SCENES |= {"no_delay_less": 2, "no_delay_more": 2, "laboratory": 4, "natural_fault": 4}
"""Number of unstable roots."""


@pytest.fixture(params=SCENES)
def stability(programs, good_inputs, smoke_config, request):
    scene = smoke_config["scenes"][request.param]
    parameters = {key: scene[key] for key in PARAMETERS}
    return programs.made_by("linear_stability", good_inputs["linear_stability"] | parameters)


def parameters(stability, **other):
    """epsilon, tau, xi and gamma of a file, some of them replaced."""
    return [{**stability.attrs, **other}[key] for key in ("epsilon", "tau", "xi", "gamma")]


def test_file_and_row_of_a_scene(stability):
    """Roots and crossings solve (5); unstable ones are counted among the roots and by crossings.

    Roots lie above the bound, the rightmost first, each with its partner.
    """
    roots = stability.root_real.values + 1j * stability.root_imag.values
    assert roots.size >= 2
    assert residual(roots, *parameters(stability)).max() < 1e-12
    assert (roots.real > stability.attrs["root_bound"]).all()
    assert (np.diff(roots.real) <= 0).all()
    assert set(roots) == set(roots.conj())
    number = stability.attrs["unstable_roots"]
    assert number == np.count_nonzero(roots.real > 0)
    assert number == unstable_roots(*parameters(stability))
    for key in ("tau", "epsilon"):
        places, omegas = stability[f"{key}_of_change"], stability[f"{key}_change_omega"]
        assert places.size > 0
        for place, omega in zip(places.values, omegas.values, strict=True):
            assert residual(1j * omega, *parameters(stability, **{key: place})) < 1e-12
    row = row_of("mine", stability)
    assert row["unstable_roots"] == number
    first, *others = row["tau_of_changes"].split("; ")
    before = int(stability.tau_change_roots_before[0])
    after = int(stability.tau_change_roots_after[0])
    assert first == f"{float(stability.tau_of_change[0]):.12g} ({before} -> {after})"
    assert len(others) == stability.tau_of_change.size - 1
    assert row["leading_roots"].startswith(f"{float(stability.root_real[0]):.10g}")


@pytest.mark.parametrize("stability", ["torus", "chaos"], indirect=True)
def test_amplitude_death(stability):
    """Unstable without delay, stable between the first two crossings; by the crossings, too."""
    ((begin, end),) = amplitude_death(stability)
    assert (begin, end) == tuple(stability.tau_of_change.values[:2])
    assert unstable_roots(*parameters(stability, tau=0.9 * begin)) == 2
    assert unstable_roots(*parameters(stability, tau=(begin + end) / 2)) == 0
    assert unstable_roots(*parameters(stability, tau=1.1 * end)) == 2


@pytest.mark.parametrize("stability", ["fixed_point", "oscillation"], indirect=True)
def test_state_stable_without_delay_does_not_die(stability):
    assert amplitude_death(stability) == []


def test_table_of_the_workflow(smoke):
    rows = read_table(smoke.folder / "results" / "tables" / "linear-stability.tsv")
    assert {row["scene"]: row["unstable_roots"] for row in rows} == SCENES


def test_bound_too_far_is_refused(programs, good_inputs):
    groups = {"linear_stability": {**good_inputs["linear_stability"], "tau": 1000.0}}
    run = programs.run_groups("linear_stability", groups)
    assert run.returncode == 1
    assert "a bound nearer to 0 expected" in run.stderr
    assert programs.left_behind() == []


def test_changes_of_a_row():
    """Fewer unstable roots are not enough for stability: none must be left."""
    row = with_changes({"tau_of_changes": "2.5 (0 -> 2); 3 (2 -> 4); 4 (4 -> 2); 5e+01 (2 -> 0)"})
    assert row["changes"] == [(2.5, 0, 2), (3, 2, 4), (4, 4, 2), (50, 2, 0)]
    assert (row["lost"], row["regained"]) == ([2.5], [50])
    assert with_changes({"tau_of_changes": math.nan})["changes"] == []


@cases(
    (
        # every scene must have such a delay
        *("delay_destabilises", {"scenes": ["a", "b"]}),
        (changing("2 (0 -> 2); 5 (2 -> 0)", "3 (0 -> 2)"), YES, "; b at $tau = 3$."),
        (changing("2 (0 -> 2)", "2 (2 -> 4); 5 (4 -> 2)"), NO, "; b at no $tau$."),
    ),
    (
        *("amplitude_death", {"scenes": ["a"]}),
        (changing("2 (0 -> 2); 5 (2 -> 0)"), YES, "stability: a at $tau = 5$."),
        (changing("2 (4 -> 2); 5 (2 -> 4)"), NO, "stability: none."),
    ),
)
def test_verdicts(case):
    assert_finding(*case)

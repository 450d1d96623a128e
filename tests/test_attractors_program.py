"""The program `attractors`: what it writes, and what a table makes of it.

The suite attractor_points shows that a failed run changes no other one.
"""

import math

import numpy as np
import pytest
from namelist_groups import OBSERVATION
from scipy.integrate import solve_ivp

ONE_HISTORY = {"theta": [0.0], "u": [0.0], "v": [1.1]}


SECTION = ("maximum", "section_theta", "section_u")


@pytest.fixture
def groups(good_groups) -> dict[str, dict]:
    """Namelist groups that the program accepts, to change."""
    return good_groups["attractors"]


def test_points_are_the_rectangle_for_each_history(programs, groups):
    """Epsilon runs fastest, histories slowest; the file has names, flags and settings."""
    found = programs.made_of("attractors", groups)
    np.testing.assert_allclose(found.epsilon, [0.3, 0.5] * 4, rtol=1e-15)
    assert found.tau.values.tolist() == [0.0, 0.0, 10.0, 10.0] * 2
    assert found.history_theta.values.tolist() == [0.0] * 4 + [0.5] * 4
    assert found.history_u.values.tolist() == [0.0] * 4 + [-0.5] * 4
    assert found.history_v.values.tolist() == [1.1] * 4 + [1.5] * 4
    meanings = "undecided fixed_point cycle torus 3-torus chaos"
    for key in ("class", "by_exponents", "by_section", "by_spectrum"):
        assert found[key].attrs["flag_meanings"] == meanings
        assert set(found[key].values) <= set(range(6))
    assert found.xi.values.tolist() == found.gamma.values.tolist() == [0.8] * 8
    settings = {"name": "a part", "sweep": "none", "method": "auto", "tolerance": 1e-6}
    recorded = ("t_transient", "t_observed", "t_turning", "interval", "zero_level")
    assert found.attrs.items() >= (settings | {key: OBSERVATION[key] for key in recorded}).items()
    assert found.problem.values.tolist() == [""] * 8


def test_own_parameter_of_a_law_is_an_axis(programs, groups):
    """Each point is as in a run at its value."""
    points = groups["points"] | {"tau_part": [1, 1], "epsilon_part": [3, 3], **ONE_HISTORY}
    # in another order than the definition's
    points |= {"law": "quasistatic_slip_cut_off", "zeta": 0.1}
    alone = []
    for c in (0.0, 0.5):
        groups["points"] = points | {"c": c}
        alone.append(programs.made_of("attractors", groups))
        assert (alone[-1].attrs["c"], alone[-1].attrs["zeta"]) == (c, 0.1)
    groups["points"] = points | {"tau": 0.0, "ordinate": "c"}
    groups["points"] |= {"c_window": [0.0, 0.5], "c_count": 2, "c_part": [1, 2]}
    found = programs.made_of("attractors", groups)
    assert (found.attrs["axes"], found.c.values.tolist()) == ("epsilon c", [0.0, 0.5])
    assert found.c.attrs["long_name"] == "velocity scale of the cut-off"
    expected = np.array([one.lyapunov_exponent.values[0] for one in alone])
    np.testing.assert_array_equal(found.lyapunov_exponent, expected)
    assert np.nanmax(np.abs(expected[0] - expected[1])) > 1e-3


def test_recurrence_time_of_a_cycle_is_its_period(programs, groups):
    """Without delay, beside SciPy's solution; a fixed point has none."""
    groups["observation"]["t_transient"] = 400.0
    groups["points"] |= {"tau_part": [1, 1], **ONE_HISTORY}
    at_rest, of_cycle = programs.made_of("attractors", groups).recurrence_time.values
    assert math.isnan(at_rest)

    def slopes(_t, y):
        theta, u, v = y[0], y[1], math.exp(y[2])
        return [-v * (theta + 1.5 * y[2]), v - 1, -0.64 * (u + (theta + y[2]) / 0.8) / v]

    def rise(_t, y):
        return y[2]

    rise.direction = 1
    start = [0.0, 0.0, math.log(1.1)]
    run = solve_ivp(slopes, (0.0, 600.0), start, method="DOP853", rtol=1e-9, events=rise)
    np.testing.assert_allclose(of_cycle, np.diff(run.t_events[0])[-1], rtol=1e-6)


def test_the_last_points_are_kept(programs, groups):
    """The number of points that `kept` gives, or none at all."""
    groups["points"] |= {"epsilon_part": [3, 3], "tau_part": [2, 2]}
    whole = programs.made_of("attractors", groups)
    groups["points"]["kept"] = 0
    assert not {*SECTION} & {*programs.made_of("attractors", groups)}
    groups["points"]["kept"] = 3
    found = programs.made_of("attractors", groups)
    for key in SECTION:
        for values, kept in zip(whole[key].values, found[key].values, strict=True):
            np.testing.assert_array_equal(kept, values[np.isfinite(values)][-3:])


@pytest.mark.parametrize("refinements", [0, 1])
def test_same_bytes_in_one_thread_and_in_two(programs, groups, monkeypatch, refinements):
    """Also if only some points are computed."""
    groups["points"] |= {"epsilon_part": [1, 3], "refinements": refinements}
    groups["points"] |= ONE_HISTORY if refinements else {}
    contents = set()
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        programs.made_of("attractors", groups)
        contents.add(programs.output.read_bytes())
    assert len(contents) == 1

"""The program `attractors`: what it writes, and what a table makes of it.

The suite attractor_points shows that a failed run changes no other one.
"""

import numpy as np
import pytest
from namelist_groups import OBSERVATION

ONE_HISTORY = {"theta": [0.0], "u": [0.0], "v": [1.1]}


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

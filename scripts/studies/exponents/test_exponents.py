"""Exponents: the program against known roots, its refusals, the config, table and figure.

The suites lyapunov_spectrum and tangent_runs show long intervals and other methods.
"""

import numpy as np
import pytest

from conftest import trajectory_settings
from scripts.requests.parameters import zero_of
from scripts.studies.exponents import table as exponents_table


@pytest.fixture
def groups(filled_config) -> dict[str, dict]:
    """Namelist groups that the program accepts, to change: the fixed point without delay."""
    scene = {"name": "fixed_point", **trajectory_settings(filled_config, "fixed_point")}
    settings = filled_config["exponents"] | zero_of(filled_config)
    settings |= {"t_turning": 100.0, "interval": 0.5}
    return {
        "scene": scene | {"t_transient": 200.0, "t_end": 300.0},
        "exponents": {"count": 3, "t_end": 500.0, **settings},
    }


def test_exponents_of_a_fixed_point_are_its_roots(programs, groups):
    """Real parts of the roots of (5) without delay, at each tolerance."""
    made = programs.made_of("exponents", groups)
    ratio = 0.8**2 / 0.8
    roots = np.roots([1, 1 + ratio, 0.8**2 + ratio - 1.3 * ratio, 0.8**2])
    known = np.sort(roots.real)[::-1]
    assert made.tolerance.values.tolist() == [1e-9, 1e-7, 1e-5, 1e-9]
    assert made.longest_step.fillna(0).values.tolist() == [0, 0, 0, 0.1]
    assert 0.09 < made.mean_step[3] <= 0.1 < made.mean_step[0]
    # what is left of the way to the fixed point, and the turning of the pair
    np.testing.assert_allclose(made.value, np.tile(known, (4, 1)), atol=1e-3)
    np.testing.assert_allclose(made.value[0].sum(), -(1 + ratio), atol=1e-4)
    # in the second half it is close enough that volumes shrink as at rest
    at_rest = made.block_value.isel(time_block=slice(10, 20))
    np.testing.assert_allclose(at_rest.sum("exponent"), -(1 + ratio), atol=1e-4)
    assert made.dimension.values.tolist() == [0, 0, 0, 0]
    assert made.t[-1] == pytest.approx(500)
    assert made.attrs["zero_exponents"] == 0


def test_rows_hold_the_values_of_their_run(programs, groups):
    made = programs.made_of("exponents", groups)
    rows = exponents_table.rows_of(made)
    assert len(rows) == made.value.size
    for n, row in enumerate(rows):
        at, i = made.isel(run=n // 3), n % 3
        assert (row["scene"], row["i"]) == ("fixed_point", i + 1)
        assert (row["exponent"], row["error"]) == (at.value[i], at.error[i])
        assert row["sign"] == ("negative" if at.value[i] < -3 * at.error[i] else "unclear")
        assert (row["dimension"], row["dimension_error"]) == (at.dimension, at.dimension_error)
        assert row["t"] == made.attrs["t_end"] - made.attrs["t_begin"]
        assert (row["tolerance"], row["mean_step"]) == (at.tolerance, at.mean_step)

"""Scenes in SI: parameters of (4) by the quantities of (2), refusals, and tables."""

import math

import numpy as np
import pytest
import xarray as xr

from scripts.config.check_config import checked
from scripts.config.si import doubts, in_si, parameters_of
from scripts.files.read_config import ConfigError
from scripts.studies.si.events_table import columns_of
from scripts.studies.si.table import row_of

QUANTITIES = {"a": 0.01, "b": 0.015, "sigma": "50 MPa", "D_c": "1 cm", "v0": "1e-9 m/s"}
SI = QUANTITIES | {"k": "30 MPa/m", "M": "3e6 kg/m^2"}
SLAB = QUANTITIES | {"G": "30 GPa", "W": "1 km", "rho": "3 g/cm^3"}
SCENE = {"si": SI, "tau": "2 years", "t_end": "5e5 days"}


@pytest.mark.parametrize("si", [SI, SLAB, SI | {"b": 0.005}])
def test_parameters_are_those_of_2(si):
    """(2) about steady sliding, in SI units and without delay, has the roots of (5) over L/v0."""
    q = in_si(si)
    a, b, rate = q["a"] * q["sigma"], q["b"] * q["sigma"], q["v0"] / q["D_c"]
    # theta, u and v; the unknowns in units of A, L and v0, time in seconds
    of_v = -np.array([a, q["k"] * q["D_c"], a]) / (q["M"] * q["v0"])
    second = np.array([[-rate, 0, -b * rate / a], [0, 0, rate], of_v])
    epsilon, xi, gamma = parameters_of(q).values()
    square = gamma**2
    of_5 = [1, 1 + square / xi, square * (1 + 1 / xi) - (1 + epsilon) * square / xi, square]
    assert np.poly(second / rate) == pytest.approx(of_5, rel=1e-6)


def test_values_with_units_become_nondimensional(config):
    """A section that two scenes share by an alias is that of each in its own units."""
    shared = {"v": "2e-9 m/s", "u": "1 mm", "theta": "0.1 MPa"}
    mine = SCENE | {"history": shared, "exponents": {"t_end": "1e5 days"}}
    config["scenes"] |= {"mine": mine, "fast": mine | {"si": SI | {"v0": "1e-8 m/s"}}}
    found, fast = (checked(checked(config))["scenes"][name] for name in ("mine", "fast"))
    assert (found["epsilon"], found["xi"]) == (0.5, 0.6)
    assert (found["tau"], found["t_end"], found["exponents"]["t_end"]) == (6.31152, 4320.0, 864.0)
    assert found["history"] == {"v": 2.0, "u": 0.1, "theta": 0.2}
    assert (fast["tau"], fast["history"]["v"]) == (63.1152, 0.2)


KEYS = "expected a, b, sigma, D_c, v0, k, M, or G, W and rho in place of k and M"
SIGMA = ["50 m", "50", "50 MPb", "nan Pa", "0 Pa", "-5 MPa", "1e400 Pa", [1], "9**9**9**9 Pa"]
SIGMA += ["1 Pa" + " m/m" * 20, "__import__('os').abort()"]
REFUSED = [
    *(
        ({"si": SI | {key: value}}, f"si: {key} = ")
        for key in SI
        for value in (0, "-1 m", math.inf)
    ),
    *(({"si": SLAB | {key: "0 m"}}, f"si: {key} = '0 m'; ") for key in ("G", "W", "rho")),
    *(
        ({"si": SI | {"sigma": text}}, "number with its unit, in [1e-30, 1e+30] Pa")
        for text in SIGMA
    ),
    *(({"si": si}, KEYS) for si in (SI | SLAB, SI | {"c": 1}, QUANTITIES, 5)),
    ({"xi": 0.5}, "xi = 0.5; expected none beside si, which gives 0.6"),
    ({"tau": "2 m"}, "tau = '2 m'; expected a finite number, alone or with a unit such as s"),
    ({"tau": "-2 years"}, "tau = -6.31152 (-2 years); expected delay, nondimensional, a finite"),
    (
        {"t_transient": "6e5 days"},
        "= 5184.0 (6e5 days); expected a finite number >= 0 and < t_end =",
    ),
    ({"t_transient": "6e5 days"}, " < t_end = 4320.0 (5e5 days)"),
    ({"si": SI | {"b": 1e30, "a": 1e-30}, "t_end": math.inf}, "t_end = inf; expected "),
]
"""Changes of the scene, and words of the one line that refuses them."""


@pytest.mark.parametrize(("changes", "words"), REFUSED)
def test_scene_is_refused(config, changes, words):
    config["scenes"]["mine"] = SCENE | changes
    with pytest.raises(ConfigError) as caught:
        checked(config)
    _, line = str(caught.value).splitlines()
    assert line.startswith("scene 'mine'")
    assert words in line


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, None),
        ({"tau": 2.2}, "scene 'mine': tau = 2.2 has no unit: it is 2.2 D_c/v0 = 2.2e+07 s"),
        (
            {"si": SI | {"sigma": "50 mPa"}},
            "scene 'mine' si: sigma = '50 mPa' is 0.05 Pa; faults and laboratories have 1000 to",
        ),
    ],
)
def test_what_may_be_meant_otherwise_is_said(changes, words):
    lines = list(doubts("scene 'mine'", SCENE | changes))
    assert [line.startswith(words or "none") for line in lines] == [True] * (words is not None)


def test_table_of_a_clock():
    """A mass of 1 kg on 4 pi^2 N/m swings once a second; 7 L/v0 of 3 s are 21 s."""
    si = {"a": 1, "b": 3, "sigma": "1 Pa", "D_c": "6 m", "v0": "2 m/s", "M": "1 kg/m^2"}
    row = row_of("clock", {"si": si | {"k": f"{4 * np.pi**2} Pa/m"}, "tau": 7.0})
    assert row["inertial_period_s"] == pytest.approx(1.0)
    assert (row["time_unit_s"], row["tau_s"]) == (3.0, 21.0)
    assert row["inertial_period_of_paper_s"] == pytest.approx(7.5 * np.pi)
    assert row["k_c_over_k"] == pytest.approx(2.0 / 6 / (4 * np.pi**2))


def test_stress_drops_by_what_the_plate_does_not_make_up_for():
    """5 cm in 2e7 s are 3 cm more than the plate goes, at 30 MPa/m."""
    event = {"onset": 1.0, "duration": 2.0, "slip": 5.0, "peak_velocity": 30.0}
    events = xr.Dataset({name: ("event", [value]) for name, value in event.items()})
    found = [float(column[0]) for column in columns_of(events, SI).values()]
    assert found == pytest.approx([1e7, 2e7, 0.05, 3e-8, 9e5])

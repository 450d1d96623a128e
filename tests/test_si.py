"""Scenes in SI: parameters of (4) by the quantities of (2), refusals, and slip events."""

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT

from scripts.config.check_config import checked
from scripts.config.si import in_si, parameters_of
from scripts.files.read_config import ConfigError, read
from scripts.tables.si_events_table import columns_of
from scripts.tables.si_table import row_of

SI = {"a": 0.01, "b": 0.015, "sigma": "50 MPa", "D_c": "1 cm", "v0": "1e-9 m/s"}
SPRING, SLAB = {"k": "30 MPa/m", "M": "3e6 kg/m^2"}, {"G": "30 GPa", "W": "1 km", "rho": "3 g/cm^3"}
SCENE = {"si": SI | SPRING, "tau": "2 years", "t_end": "5e5 days"}
PAPERS = {
    key: scene
    for key, scene in read(ROOT / "config/config.yaml")["scenes"].items()
    if "si" in scene
}


@pytest.mark.parametrize("si", [SI | SPRING, SI | SLAB, *(one["si"] for one in PAPERS.values())])
def test_parameters_are_those_of_2(si):
    """(2) about steady sliding, in SI units and without delay, has the roots of (5) over L/v0."""
    q = in_si(si)
    a, b, rate = q["a"] * q["sigma"], q["b"] * q["sigma"], q["v0"] / q["D_c"]
    # theta, u and v; the unknowns in units of A, L and v0, time in seconds
    second = np.array(
        [
            [-rate, 0, -b * rate / a],
            [0, 0, rate],
            -np.array([a, q["k"] * q["D_c"], a]) / (q["M"] * q["v0"]),
        ]
    )
    epsilon, xi, gamma = parameters_of(q).values()
    square = gamma**2
    of_5 = [1, 1 + square / xi, square * (1 + 1 / xi) - (1 + epsilon) * square / xi, square]
    assert np.poly(second / rate) == pytest.approx(of_5, rel=1e-6)


def test_values_with_units_become_nondimensional(config):
    """A section that two scenes share by an alias is that of each in its own units."""
    shared = {"v": "2e-9 m/s", "u": "1 mm", "theta": "0.1 MPa"}
    whole = SCENE | {"history": shared, "exponents": {"t_end": "1e5 days"}}
    config["scenes"] |= {"mine": whole, "fast": whole | {"si": SI | SPRING | {"v0": "1e-8 m/s"}}}
    scenes = checked(checked(config))["scenes"]
    mine = scenes["mine"]
    assert (mine["epsilon"], mine["xi"], mine["gamma"]) == (0.5, 0.6, pytest.approx(1e7 * 10**0.5))
    assert (mine["tau"], mine["t_end"], mine["exponents"]["t_end"]) == (6.31152, 4320.0, 864.0)
    assert mine["history"] == {"v": 2.0, "u": 0.1, "theta": 0.2}
    assert (scenes["fast"]["tau"], scenes["fast"]["history"]["v"]) == (63.1152, 0.2)


KEYS = "expected a, b, sigma, D_c, v0, k, M, or G, W and rho in place of k and M"
REFUSED = [
    *((key, value, "a number with its unit, in [1e-30, 1e+30]") for key in SI for value in (0, -1)),
    *(("sigma", text, " in [1e-30, 1e+30] Pa") for text in ("50 m", "50", "50 MPb", "nan Pa")),
    *(("sigma", text, " in [1e-30, 1e+30] Pa") for text in ("0 Pa", "-5 MPa", "1e400 Pa", [1])),
    *(
        ("D_c", text, " 1e+30] m")
        for text in ("9**9**9**9 m", "1 m" + " m/m" * 20, "(lambda: 1)()")
    ),
    *((key, f"-{(SPRING | SLAB)[key]}", "number with its unit") for key in SPRING | SLAB),
    *(("b", value, "with its unit, in [1e-30, 1e+30]") for value in (float("inf"), True)),
    *(("G", "30 GPa", KEYS), ("colour", 1, KEYS), ("v0", None, KEYS)),
]
"""A key under `si`, a value that is refused there (None: no such key), and words of the refusal."""


@pytest.mark.parametrize(("key", "value", "words"), REFUSED)
def test_quantity_is_refused(config, key, value, words):
    si = SI | (SLAB if key in SLAB and words != KEYS else SPRING) | {key: value}
    config["scenes"]["mine"] = SCENE | {"si": {k: v for k, v in si.items() if v is not None}}
    with pytest.raises(ConfigError) as caught:
        checked(config)
    _, line = str(caught.value).splitlines()
    assert line.startswith("scene 'mine' si: " + (f"{key} = {value!r}; " if words != KEYS else ""))
    assert line.endswith(words) or words in line.partition("; expected ")[2]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"tau": "2 m"}, "tau = '2 m'; expected a finite number, alone or with a unit such as s"),
        (
            {"tau": "-2 years"},
            "tau = -6.31152 (-2 years); expected delay, nondimensional, a finite",
        ),
        (
            {"t_transient": "6e5 days"},
            "t_transient = 5184.0 (6e5 days); expected a finite number >= 0 and < t_end = 4320.0 (5e5",
        ),
        ({"xi": 0.5}, "xi = 0.5; expected none beside si, which gives 0.6"),
        ({"si": 5}, "5; expected a, b, sigma, D_c, v0, k, M, or G, W and rho"),
        ({"si": SI | SPRING | {"a": 1e-30, "b": 1e30}, "t_end": 1e400}, "t_end = inf; expected "),
    ],
)
def test_scene_in_si_is_refused(config, changes, words):
    config["scenes"]["mine"] = SCENE | changes
    with pytest.raises(ConfigError) as caught:
        checked(config)
    assert words in str(caught.value)
    assert str(caught.value).count("\n") == 1


def test_table_of_a_clock():
    """A mass of 1 kg on 4 pi^2 N/m swings once a second; 7 L/v0 of 3 s are 21 s."""
    si = {"a": 1, "b": 3, "sigma": "1 Pa", "D_c": "6 m", "v0": "2 m/s", "M": "1 kg/m^2"}
    row = row_of("clock", {"si": si | {"k": f"{4 * np.pi**2} Pa/m"}, "tau": 7.0})
    assert row["inertial_period_s"] == pytest.approx(1.0)
    assert (row["time_unit_s"], row["tau_s"], row["epsilon"]) == (3.0, 21.0, 2.0)
    assert row["gamma"] == pytest.approx(6 * np.pi)
    assert row["inertial_period_of_paper_s"] == pytest.approx(7.5 * np.pi)
    assert row["k_c_over_k"] == pytest.approx(2.0 / 6 / (4 * np.pi**2))


def test_stress_drops_by_what_the_plate_does_not_make_up_for():
    """5 cm in 2e7 s are 3 cm more than the plate goes, at 30 MPa/m."""
    names = ("onset", "duration", "recurrence_time", "slip", "peak_velocity")
    values = zip(names, (1.0, 2.0, 9.0, 5.0, 30.0), strict=True)
    events = xr.Dataset({name: ("event", [value]) for name, value in values})
    found = columns_of(events, SI | SPRING)
    assert [float(column[0]) for column in found.values()] == pytest.approx(
        [1e7, 2e7, 9e7, 0.05, 3e-8, 9e5]
    )

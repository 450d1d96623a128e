"""Results made up for tests of the ledger: curves, spectra and events, and rows of tables."""

import math

import numpy as np
import pytest
import xarray as xr

from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED
from scripts.claims.decide import Finding, find
from scripts.models.models import HISTORY, PAPER, PARAMETERS
from scripts.plans import studies

YES, PARTLY, NO = REPRODUCED, CORRECTED, NOT_REPRODUCED
"""Verdicts, short for tables of expected ones."""
CLASSES = ["fixed point", "cycle", "torus", "chaos", "undecided"]
BLOCK = {"model": PAPER, "model_kind": "block", "parameters": " ".join(PARAMETERS), "signal": "v"}
"""What a file says of the block."""
PLACE = {"tau": 10.0, "epsilon": 0.5, "xi": 0.8, "gamma": 0.8}
"""Parameters of a line, but for the one along it."""
AT = {"along": "tau", "epsilon": 0.7, "xi": 0.5, "gamma": 0.8, "law": PAPER}
LINES = {
    "mine": AT,
    "beside": {**AT, "xi": 0.6},
    "faster": {**AT, "gamma": 0.9},
    "ageing": {**AT, "law": "ageing_delayed_velocity"},
    "across": {"along": "epsilon", "tau": 7.0, "xi": 0.5, "gamma": 0.8, "law": PAPER},
    "in_xi": {"along": "xi", "tau": 7.0, "epsilon": 0.9, "gamma": 0.8, "law": PAPER},
}
"""Lines of cycles: the first and `across` are lines of routes and in a plane of the atlas."""
SCENE = {"tau": 3.0, "epsilon": 0.4, "xi": 0.8, "gamma": 0.8}
"""Parameters of a scene."""


def finding(test: str, data: dict, **parameters) -> Finding:
    """What a test of claims finds in made-up data, by their names; data not given are empty."""
    makers = studies.data().items()
    empty = {name: {} if maker.output.endswith(".nc") else [] for name, maker in makers}
    assert data.keys() <= empty.keys()
    return find(test, {**empty, **data}, **parameters)


def cases(*groups: tuple) -> pytest.MarkDecorator:
    """Arguments of `assert_finding`: a test of claims, its parameters, and with these one or more
    results, each with the verdict, and words of the evidence if it is about them."""
    found = [(test, given, *one) for test, given, *several in groups for one in several]
    return pytest.mark.parametrize("case", found, ids=[test for test, *_ in found])


def assert_finding(test: str, given: dict, data: dict, verdict: str, words: str = "") -> None:
    """That a test has this verdict, and these words in its evidence."""
    found = finding(test, data, **given)
    assert found.verdict == verdict
    assert words in found.evidence


def hopf_curve(
    gamma: float = 0.8, xi: float = 0.5, k: int = 1, ordinate: str = "tau", scale: float = 1.0
):
    """A curve by its closed form, independent of (7) to (10), as in results/hopf/."""
    omega = scale * np.linspace(0.31, 1.43, 12)
    b = xi * (gamma**2 - omega**2) / (gamma**2 * omega)
    values = {
        "epsilon": np.sqrt((1 + omega**2) * (1 + b**2)) - 1,
        "tau": (np.arctan(b) - np.arctan(omega) + 2 * np.pi * k) / omega,
        "xi": np.full(omega.size, xi),
        "omega": omega,
        "branch": np.full(omega.size, k),
        "crossing": np.ones(omega.size, dtype=int),
        "residual": np.full(omega.size, 1e-15),
        "l1": np.full(omega.size, -0.1),
        "unstable_roots": np.zeros(omega.size, dtype=int),
    }
    data = {name: ("point", value) for name, value in values.items()}
    return xr.Dataset(data, attrs={"ordinate": ordinate, "gamma": gamma, "xi": xi})


def changed(curves: xr.Dataset, **values) -> xr.Dataset:
    size = curves.sizes["point"]
    new = {name: ("point", np.broadcast_to(value, size).copy()) for name, value in values.items()}
    return curves.assign(new)


def stability_row(scene: str = "mine", **given) -> dict:
    """A row of linear-stability.tsv: stable without delay, lost at 2, regained at 5, lost at 8."""
    return {
        "scene": scene,
        **SCENE,
        "unstable_roots": 2.0,
        "tau_of_changes": "2 (0 -> 2); 5 (2 -> 0); 8 (0 -> 2)",
        "epsilon_of_changes": "0.3 (0 -> 2); 0.9 (2 -> 4)",
        **given,
    }


def changing(*cells: str | float) -> dict:
    """Results of scenes a, b, ... whose stability changes at these delays."""
    scenes = zip("abc", cells, strict=False)
    return {"linear_stability": [stability_row(a, tau_of_changes=one) for a, one in scenes]}


def attractor_row(met: str, scene: str = "mine", history: int = 1, **given) -> dict:
    return {
        "scene": scene,
        "history": float(history),
        **SCENE,
        "class": met,
        "reason": "not confirmed" if met == "undecided" else math.nan,
        "period": 1.0 if met == "cycle" else math.nan,
        "by_exponents": met,
        "by_section": met,
        "by_spectrum": met,
        **{f"exponent_{i}": -0.01 * i for i in (1, 2, 3)},
        **{f"error_{i}": 0.001 for i in (1, 2, 3)},
        "f1": 0.1,
        "f2": 0.17 if met.endswith("torus") else math.nan,
        "f3": 0.13 if met == "3-torus" else math.nan,
        "largest_maximum": 1.0 if met == "fixed point" else 2.0,
        "recurrence_variation": math.nan if met == "fixed point" else 0.1,
        **given,
    }


def route_rows(*classes: str, name: str = "mine", run: str = "near", along: str = "tau"):
    """Rows of a route: classes, with a period behind a /, at 0.1, 0.2 and so on, last first."""
    rows = [
        {
            "route": name,
            "run": run,
            **PLACE,
            along: 0.1 * (i + 1),
            "class": met.split("/")[0],
            "period": float(met.split("/")[1]) if "/" in met else math.nan,
        }
        for i, met in enumerate(classes)
    ]
    return rows[::-1]


def followed_cycles(along: str = "tau", **fixed: float) -> xr.Dataset:
    """Two branches along a parameter with a special point of each of three kinds.

    The first starts at a Hopf point, turns at a fold at 0.45 and is stable behind a torus
    bifurcation at 0.3. The second is closed and doubles its period at 0.7, in both directions.
    """
    place = {key: value for key, value in {**PLACE, **fixed}.items() if key != along}
    other = "epsilon" if along == "tau" else "tau"
    orbits = {
        along: [0.1, 0.3, 0.4, 0.4, 0.35, 0.2, *(0.6, 0.8, 0.8, 0.6)],
        "v_most": [1.1, 1.5, 2.0, 2.5, 2.8, 3.5, *(2.0, 2.0, 2.5, 2.5)],
        "branch": [1] * 6 + [2] * 4,
        "unstable": [2, 2, 2, 3, 3, 1, *(0, 1, 1, 0)],
    }
    points = {
        "kind": ["fold", "torus", *["period_doubling"] * 2],
        along: [0.45, 0.3, 0.7, 0.7],
        "v_most": [2.2, 3.0, 2.1, 2.6],
        "branch": [1, 1, 2, 2],
        "unstable_before": [2, 3, 0, 1],
        "unstable_behind": [3, 1, 1, 0],
    }
    return xr.Dataset(
        {
            **{name: ("orbit", values) for name, values in orbits.items()},
            **{f"special_{name}": ("special", values) for name, values in points.items()},
            "branch_origin": ("branches", ["hopf", "trajectory"]),
            "branch_ending": ("branches", ["window", "closed"]),
            f"hopf_{along}": ("hopf", [0.1]),
            f"hopf_{other}": ("hopf", [place[other]]),
        },
        attrs={"along": along, **BLOCK, **place},
    )


def cycles_to_a_torus(along: str = "tau", cusps: int = 0, **fixed: float) -> xr.Dataset:
    """A branch with a torus bifurcation at 0.25, beyond which its cycles are unstable, and cusps.

    All cusps are at the same place.
    """
    place = {key: value for key, value in {**PLACE, **fixed}.items() if key != along}
    orbits = {
        along: [0.1, 0.2, 0.3, 0.4],
        "v_most": [1.1, 1.2, 1.3, 1.4],
        "branch": [1] * 4,
        "unstable": [0, 0, 2, 2],
        "multiplier_error": [1e-12] * 4,
    }
    points = {
        "kind": ["torus"],
        **{key: [value] for key, value in place.items()},
        along: [0.25],
        "v_most": [1.25],
        "branch": [1],
        "unstable_before": [0],
        "unstable_behind": [2],
        "period": [5.0],
        "angle": [0.24],
        "resonance_turns": [1],
        "resonance_periods": [4],
        "multiplier_error": [1e-12],
        "mesh_error": [2e-12],
        "criticality": ["supercritical"],
        "coefficient": [-0.123456789],
        "coefficient_error": [3.21e-10],
        "amplitude": [0.54321],
    }
    cusp = {**PLACE, "tau": 3.5, "period": 9.0, "v_most": 2.5}
    cusp |= {"multiplier_error": 1e-4, "mesh_error": 1e-10}
    return xr.Dataset(
        {
            **{name: ("orbit", values) for name, values in orbits.items()},
            **{f"special_{name}": ("special", values) for name, values in points.items()},
            **{f"cusp_{name}": ("cusp", [value] * cusps) for name, value in cusp.items()},
            "multiplier_real": (("orbit", "multiplier"), [[0.3], [0.54], [0.66], [0.8]]),
            "multiplier_imaginary": (("orbit", "multiplier"), [[0.4], [0.72], [0.88], [0.7]]),
            "branch_origin": ("branches", ["hopf"]),
            "branch_ending": ("branches", ["window"]),
        },
        attrs={"along": along, **BLOCK, **place},
    )


def torus_point(at: float = 0.25, **given) -> dict:
    """A row of cycle-points.tsv: a torus bifurcation of a stable cycle along tau."""
    stable = {"kind": "torus", "unstable_before": 0.0, "unstable_behind": 2.0}
    stable |= {"criticality": "supercritical"}
    return {"of": "mine", **PLACE, "tau": at, **stable, **given}


def trajectory(t: np.ndarray, **variables: np.ndarray) -> xr.Dataset:
    """A trajectory at these times, the first variable its signal."""
    data = {name: ("t", one, {"long_name": f"the {name}"}) for name, one in variables.items()}
    return xr.Dataset(data, {"t": t}, {"t_transient": 0.0, "signal": next(iter(variables))})


def spectrum(kind: str = "periodic", **heights: float) -> xr.Dataset:
    """A spectrum of this kind with peaks at multiples of 0.1: `x2=5.0` is one of 5 at 0.2."""
    multiples = [int(name.removeprefix("x")) for name in heights]
    peaks = {
        "peak_frequency": [0.1 * multiple for multiple in multiples],
        "peak_power": list(heights.values()),
        "peak_multiple": multiples,
    }
    attributes = {"spectrum_kind": kind, "continuum_share": 0.69}
    return xr.Dataset({name: ("peak", value) for name, value in peaks.items()}, attrs=attributes)


def slip_events(**values) -> xr.Dataset:
    """Slip events, one for each element of the longest value; v spans 10, half of it is stick."""
    size = max((np.size(value) for value in values.values()), default=200)
    made = {"recurrence_time": 8.0, "duration": 4.0, "slip": 6.0, "peak_velocity": 2.0}
    made |= {"least_velocity": 0.2, **values}
    data = {name: ("event", np.broadcast_to(value, size)) for name, value in made.items()}
    place = {"tau": 7.0, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
    history = {"history_theta": 0.0, "history_u": 0.0, "history_v": 1.1}
    return xr.Dataset(data, attrs={**place, **history})


def run_row(**given) -> dict:
    return {
        "case": "a case",
        "xi": 0.5,
        "gamma": 1e6,
        "method": "auto",
        "status": "ok",
        "steps": 200.0,
        "least_ln_v": -10.0,
        "most_ln_v": 3.0,
        "error": 1e-9,
        "reference": "same source in quadruple precision",
        "error_expected": 1e-8,
        "t_end": 100.0,
        "amplification": 10.0,
        **given,
    }


def survey_run(classes: list[str], **given) -> xr.Dataset:
    """A file with one point for each class, other values of points as given."""
    size = len(classes)
    known = [*CLASSES, "3-torus"]
    numbers = [known.index(name) for name in classes]
    meanings = " ".join(name.replace(" ", "_") for name in known)
    points = {
        **dict.fromkeys([*PARAMETERS, *(f"history_{key}" for key in HISTORY)], 1.0),
        **{"period": 1, "base_1": 0.1, "base_2": 0.0, "base_3": 0.0},
        **{"roughness": 0.5, "time": 900.0, "smallest_maximum": 1.0, "largest_maximum": 2.0},
        **{"recurrence_time": 8.0, "recurrence_variation": 0.1},
        **given,
    }
    exponents = {key: points.pop(key, 0.0) for key in ("lyapunov_exponent", "lyapunov_error")}
    words = np.broadcast_to(points.pop("problem", ""), size)
    data = {key: ("point", np.broadcast_to(value, size)) for key, value in points.items()}
    for key in ("class", "by_exponents", "by_section", "by_spectrum"):
        data[key] = ("point", numbers, {"flag_meanings": meanings})
    reasons = [int(name == "undecided") for name in classes]
    data["reason"] = ("point", reasons, {"flag_meanings": "none not_confirmed"})
    for key, value in exponents.items():
        first = np.broadcast_to(value, size)
        data[key] = (("point", "exponent"), np.stack([first, first - 1], axis=1))
    data["sign"] = (("point", "exponent"), np.sign(data["lyapunov_exponent"][1]))
    data["problem"] = ("point", words.astype(object))
    return xr.Dataset(data, attrs=BLOCK)

"""Every number of a configuration: its range, and what is no number; all keys in few checks."""

import copy

import pytest
from config_refusals import (
    NO_NUMBERS,
    apart,
    assert_refused,
    numbers_in,
    place_of,
    put,
    refusal,
    rounds,
    take_out,
)

from scripts.config.check_config import checked

TOLERANCE = ("[1e-13, 1e-2]", [0.0, 9.9e-14, 1.01e-2, -1e-9])
POSITIVE = ("> 0", [0.0, -1.0])
NOT_NEGATIVE = (">= 0", [-1e-300, -1.0])
COUNT = ("a whole number >= 1", [0, 2.5, -1])
ATLAS_COUNT = ("a whole number >= 1 and <= 100000", [0, 1.5, 100001, "5", True])
LINE_COUNT = ("a whole number >= 2 and <= 100000", [1, 2.5, 100001, "5", True])
HISTORY_V = ("> 0", [0.0, -1.1])


def below(*path: str, **ranges: tuple) -> dict[tuple, tuple]:
    """Ranges of the keys of a section."""
    return {(*path, key): rule for key, rule in ranges.items()}


def block(*path: str) -> dict[tuple, tuple]:
    """Ranges of the four parameters of the block."""
    epsilon = ("> -1", [-1.0, -2.0])
    return below(*path, tau=NOT_NEGATIVE, epsilon=epsilon, xi=POSITIVE, gamma=POSITIVE)


OBSERVATIONS = [
    ("attractors", "observation"),
    ("atlas", "observation"),
    ("routes", "observation"),
    ("basins", "observation"),
]
OBSERVED = {
    "t_transient": POSITIVE,
    "t_observed": POSITIVE,
    "t_lasting": (">= 0", [-1.0]),
    "t_turning": (">= 0", [-1.0]),
    "t_path": (">= 0", [-1.0, 1.1e5]),
    "interval": ("> 0", [0.0]),
    "exponents": ("a whole number >= 2", [1, 2.5, 65]),
    "zero_level": (">= 0", [-1e-9]),
    "longest_bar": ("> 0", [0.0]),
    "doublings": ("a whole number >= 0", [-1, 0.5, 11]),
    "sample_interval": ("> 0", [0.0]),
    "tolerance": TOLERANCE,
    "method": ("one of: auto, explicit", ["radau", None]),
    "most_steps": ("a whole number >= 1", [0, 1.5, 1000000001]),
    "kept": ("a whole number >= 0", [-1, 1.5, 100001]),
}
LINE = ("routes", "lines", "chaos_in_epsilon")
PLACE = ("basins", "places", "three_cycles")
FAMILY = ("stability", "families", "growth")
MEASURED = ("work_precision", "cases", "stick")
MEASURED_SCENE = ("work_precision", "scenes", "torus")
REFERENCE = {
    "tolerance": ("[1e-22, 1e-16]", [9e-23, 1.1e-16]),
    "check_tolerance": ("[1e-21, 1e-14]", [9e-22, 1.1e-14]),
    "disturbance": ("[1e-18, 1e-12]", [9e-19, 1.1e-12]),
    "method": ("one of: auto, explicit", ["radau", None]),
}
SECONDS = ("[0, 10]", [-0.1, 10.1])
REPEATS = ("a whole number >= 1", [0, 2.5, 101])
RANGES = {
    **block("scenes", "torus"),
    **below(
        *("scenes", "torus"),
        t_end=POSITIVE,
        t_transient=(">= 0", [-1.0]),
        sample_interval=POSITIVE,
        tolerance=TOLERANCE,
        method=("auto, explicit", ["radau", "", None, 1, ["auto"]]),
        variables=("theta, u, v", [[], ["v", "v"], "v", None, {"v": 1}]),
    ),
    **below("scenes", "torus", "history", v=HISTORY_V),
    **below(
        *("scenes", "torus", "exponents"),
        count=("a whole number >= 2", [1, 65, 2.5]),
        t_end=("> t_transient", [0.0, -1.0]),
    ),
    **below("scenes", "torus", "attractors", histories=("a whole number >= 1", [0, 1.5, 1001])),
    **{
        ("figures", figure, key): ("> 0", [0.0])
        for figure, keys in {
            "figure_4": ("end_shown", "attractor_shown"),
            "figure_5": ("end_shown", "attractor_shown"),
            "figure_6": ("frequency_shown",),
            "figure_7": ("frequency_shown",),
            "true_torus": ("end_shown", "frequency_shown"),
        }.items()
        for key in keys
    },
    **below("figures", "figure_4", "rows", "a", time_shown=("> 0", [0.0])),
    **{
        ("figures", "figure_6", "rows", "a", key): ("", [None, 5, ["torus"]])
        for key in ("scene", "paper")
    },
    **below(
        "spectra",
        window=("hann, boxcar", ["hamming", None]),
        segments=("a whole number >= 1", [0, -1, 2.5, 8.0, 10**12]),
        overlap=("[0, 1)", [-0.1, 1.0]),
        peak_floor=("(0, 1]", [0.0, 1.1]),
        peak_prominence=(">= 1", [0.9]),
    ),
    **below(
        "exponents",
        t_turning=(">= 0", [-1.0]),
        interval=POSITIVE,
        blocks=("a whole number >= 2", [1, 1001, 2.5]),
        zero_level=(">= 0", [-1e-9]),
    ),
    **below("linear_stability", root_bound=("<= 0", [0.1, "low"]), tau_most=POSITIVE),
    **below("linear_stability", epsilon_most=("> 0", [0.0, -0.5])),
    **below(
        *("hopf_curves", "tau_of_epsilon"),
        fixed=(">= 0", [-1.0]),
        gamma=POSITIVE,
        cells=("a whole number >= 1", [0, 2.5, 2001]),
        ordinate=("tau, xi", ["gamma", 1]),
    ),
    **below(
        "velocity_step",
        mu0=(">= 0", [-0.1]),
        a=(">= 0", [-0.1]),
        b=(">= 0", [-0.1]),
        dc=POSITIVE,
        v0=POSITIVE,
        b_state=POSITIVE,
        delta_v=POSITIVE,
        slip_before=POSITIVE,
        slip_after=POSITIVE,
        samples=("a whole number >= 2", [1, 2.5]),
        tolerance=TOLERANCE,
    ),
    **below("dimensions", "fault", **dict.fromkeys(("length", "v0", "k", "a", "m"), POSITIVE)),
    **below("stability", tolerance=TOLERANCE, repeats=REPEATS, least_seconds=SECONDS),
    **below("stability", "reference", **REFERENCE),
    **below(
        *FAMILY,
        t_end=POSITIVE,
        samples=("a whole number >= 1", [0, 1.5, 10001]),
        most_steps=("a whole number >= 1", [0, 100000001]),
        reference=("quadruple", ["double", None]),
        tau=("at least one finite number >= 0", [[], 1.0, [1.0, 1.0]]),
        epsilon=("at least one finite number > -1", [[], 1.0]),
        xi=("at least one finite number > 0", [[], 1.0]),
        gamma=("at least one finite number > 0", [[], 1.0]),
        theta=("at least one finite number", [[], 1.0]),
        u=("at least one finite number", [[], 1.0]),
        v=("at least one finite number > 0", [[], 1.0]),
    ),
    **below(
        "work_precision",
        most_steps=("a whole number >= 1", [0, 1.5]),
        repeats=REPEATS,
        least_seconds=SECONDS,
        trusted_error=("(0, 1e-3]", [0.0, 1.1e-3]),
        methods=("rk4_cubic", [[], ["auto", "auto"], "auto"]),
        tolerances=("[1e-13, 1e-2]", [[], [1e-3, 1e-3]]),
        steps=("> 0", [[], 0.1]),
    ),
    **below("work_precision", "reference", **REFERENCE),
    **block(*MEASURED),
    **below(*MEASURED, t_end=POSITIVE, sample_interval=POSITIVE),
    **below(*MEASURED, "history", v=HISTORY_V),
    **below(*MEASURED_SCENE, t_end=POSITIVE, sample_interval=POSITIVE),
    **{(*place, key): rule for place in OBSERVATIONS for key, rule in OBSERVED.items()},
    **below("attractors", "histories", seed=("a whole number >= 0", [-1, 0.5, None])),
    **below("atlas", "history", v=HISTORY_V),
    **below("atlas", "planes", "xi_05", xi=POSITIVE, gamma=POSITIVE),
    **below("atlas", epsilon_count=ATLAS_COUNT, tau_count=ATLAS_COUNT, parts=COUNT),
    **below("atlas", refinements=("a whole number >= 0 and <= 4", [-1, 0.5, 5, True, None])),
    **below("routes", "histories", "slip", v=HISTORY_V),
    **below(*LINE, xi=POSITIVE, gamma=POSITIVE, tau=NOT_NEGATIVE, count=LINE_COUNT),
    **below(*LINE, along=("one of: tau, epsilon, xi, gamma, theta, u, v", ["w", None])),
    **below("routes", sweeps=("up, down", [["up", "up"], "up", None])),
    **block(*PLACE),
    **below("basins", count=("a whole number >= 1", [0, 1.5, 1001])),
    **below("basins", "histories", seed=("a whole number >= 0", [-1, 0.5, None])),
}
"""For each key: words of its range, and values out of range."""
ELEMENTS = {
    **below("scenes", "torus", variables=("theta, u, v", ["w", "V", 1, None])),
    **below(
        *FAMILY,
        tau=(">= 0", [-1.0, "much", None]),
        epsilon=("> -1", [-1.0]),
        xi=("> 0", [0.0]),
        gamma=("> 0", [0.0]),
        u=("a finite number", [float("nan")]),
        v=("> 0", [0.0]),
    ),
    **below("routes", sweeps=("one of: up, down", ["left"])),
    **below("stability", methods=("one of: auto, explicit", ["rk4_cubic"])),
    **below(
        "work_precision",
        methods=("one of: explicit", ["euler"]),
        tolerances=("[1e-13, 1e-2]", [9e-14, 0.1]),
        steps=("> 0", [0.0]),
    ),
}
"""The same for elements of lists."""
WINDOWS = {
    **{
        ("hopf_curves", plane, f"{axis}_window"): [1.5, 0.5]
        for plane in ("tau_of_epsilon", "xi_of_epsilon")
        for axis in ("epsilon", "ordinate")
    },
    **{
        (section, "histories", key): [0.6, 0.5]
        for section in ("attractors", "basins")
        for key in ("theta", "u", "ln_v")
    },
    ("atlas", "epsilon_window"): [0.6, 0.5],
    ("atlas", "planes", "xi_05", "tau_window"): [0.6, 0.5],
    (*LINE, "window"): [0.6, 0.5],
}
"""Windows, each with numbers that do not ascend."""
BEYOND = {
    ("hopf_curves", "tau_of_epsilon", "epsilon_window"): ("> -1", [[-1.0, 1.0], [-1.5, 1.0]]),
    ("hopf_curves", "tau_of_epsilon", "ordinate_window"): (">= 0", [[-0.1, 1.0]]),
    ("hopf_curves", "xi_of_epsilon", "epsilon_window"): ("> 0", [[-0.5, -0.1], [-0.5, 0.0]]),
    ("hopf_curves", "xi_of_epsilon", "ordinate_window"): ("> 0", [[0.0, 1.0]]),
    ("attractors", "histories", "theta"): ("two ascending numbers", [[1e308, -1e308]]),
    ("attractors", "histories", "ln_v"): (">= -700.0 and <= 700.0", [[-701.0, 0.0], [0.0, 701.0]]),
    ("atlas", "epsilon_window"): ("> -1.0", [[-1.0, 0.5]]),
    ("atlas", "planes", "xi_05", "tau_window"): (">= 0.0", [[-0.1, 5.0]]),
    (*LINE, "window"): ("> -1.0", [[-1.0, 0.5]]),
}
"""For each window: words of its bounds, and windows beyond them."""
SECTIONS = [
    *(("scenes",), ("figures",), ("spectra",), ("hopf_curves",), ("velocity_step",)),
    *(("stability",), ("work_precision",), ("attractors",), ("atlas",), ("routes",)),
    *(("basins",), ("dimensions",)),
]
MISSING = [
    *SECTIONS,
    *(("scenes", "torus", key) for key in ("tau", "epsilon", "xi", "gamma", "t_end")),
    ("stability", "families"),
    ("work_precision", "scenes"),
    *((*place, key) for place in (FAMILY, MEASURED) for key in ("tau", "xi", "t_end")),
    (*MEASURED_SCENE, "t_end"),
    ("attractors", "histories"),
    *(("attractors", "histories", key) for key in ("seed", "theta", "u", "ln_v")),
    *(("atlas", key) for key in ("epsilon_window", "epsilon_count", "tau_count", "parts")),
    ("atlas", "planes"),
    *(("atlas", "planes", "xi_05", key) for key in ("xi", "gamma", "tau_window")),
    *(("routes", key) for key in ("histories", "sweeps", "lines")),
    *((*LINE, key) for key in ("along", "window", "count")),
    *(("basins", key) for key in ("count", "histories", "places")),
    *((*PLACE, key) for key in ("tau", "epsilon", "xi", "gamma")),
]
"""Keys without a default."""
NAMED = {("atlas", "planes"), ("stability", "families"), ("routes", "histories")}
NAMED |= {("routes", "lines"), ("basins", "places")}
NAMED |= {("work_precision", "scenes"), ("work_precision", "cases")}
"""Sections whose keys are names of the user's choice."""


@pytest.fixture
def whole(config) -> dict:
    """A config in which every section with a default stands, to change."""
    config["atlas"]["history"] = {"v": 1.1}
    return checked(config)


def test_every_number_must_be_one(whole):
    """In place of any number text, truth, nothing, lists, NaN and infinity are refused."""
    places = list(numbers_in(whole))
    assert len(places) > 300
    for value in NO_NUMBERS:
        assert_refused(whole, dict.fromkeys(places, (value, "number")))


def test_values_out_of_range_are_refused(whole):
    """The line names section, key, value and range."""
    for spoiled in rounds(RANGES):
        assert_refused(copy.deepcopy(whole), spoiled)


def test_elements_of_lists_out_of_range_are_refused(whole):
    """The line names list, place, value and range."""
    for spoiled in rounds(ELEMENTS):
        config = copy.deepcopy(whole)
        for path in spoiled:
            put(config, path, [None])
        assert_refused(config, {(*path, 0): rule for path, rule in spoiled.items()})


@pytest.mark.parametrize("window", [[0.5], [0.1, 0.2, 0.3], 0.5, None])
def test_windows_that_are_no_pair_are_refused(whole, window):
    """The line names section, window and value."""
    assert_refused(whole, dict.fromkeys(WINDOWS, (window, "two ascending")))


def test_windows_that_do_not_ascend_are_refused(whole):
    """Nor may they be a point."""
    descending = {path: (window, "two ascending") for path, window in WINDOWS.items()}
    assert_refused(copy.deepcopy(whole), descending)
    assert_refused(whole, {path: ([0.5, 0.5], "two ascending") for path in WINDOWS})


def test_windows_beyond_their_bounds_are_refused(whole):
    """The line names section, window, value and bounds."""
    for spoiled in rounds(BEYOND):
        assert_refused(copy.deepcopy(whole), spoiled)


def test_missing_keys_are_refused(whole):
    """The line names section and key; nothing else is said."""
    for paths in apart(MISSING):
        config = copy.deepcopy(whole)
        for path in paths:
            take_out(config, path)
        expected = {f"{place_of(path[:-1])}: key ['{path[-1]}'] is missing" for path in paths}
        assert set(refusal(config).splitlines()[1:]) == expected


def test_unknown_keys_are_refused(whole):
    """In every section of fixed keys: the line names section and key, and lists what is known."""
    sections = {path[:-1] for path in [*RANGES, *WINDOWS, *MISSING]} - NAMED
    for path in sections:
        put(whole, (*path, "colour"), 1)
    lines = refusal(whole).splitlines()[1:]
    assert len(lines) == len(sections) > 30
    for path in sections:
        start = f"{place_of(path)}: unknown key ['colour']; allowed: "
        (line,) = [line for line in lines if line.startswith(start)]
        assert len(line) > len(start)

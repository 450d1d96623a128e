"""Chains of blocks: trajectories, synchrony and modes, and what is refused."""

import copy
import math

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from independent_chain import second_difference, solve_chain
from scipy.integrate import solve_ivp

from scripts.studies.event_sizes.claims import blocks_differ
from scripts.claims.claims_results import NOT_REPRODUCED, REPRODUCED, Results
from scripts.config.check_config import checked
from scripts.figures import chain_modes, synchrony
from scripts.files.read_config import ConfigError, read
from scripts.namelists.chains import (
    chain_groups,
    eigenvalues,
    histories_of,
    mode_groups,
    stiffness_of_modes,
    synchrony_groups,
)
from scripts.studies.chain_modes.table import mode_rows
from scripts.tables.chain_motions import moves_alike, powers_of, rests, strongest_mode
from scripts.studies.synchrony.ranges import (
    growing_ranges,
    largest_alike,
    undecided_blocks,
    undecided_range,
)

PLACE = {"tau": 5.0, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
ENDS = ["free", "ring", "plate"]


@pytest.fixture
def config(filled_config) -> dict:
    """The paper's configuration with its defaults, to change."""
    return copy.deepcopy(filled_config)


def a_chain(config: dict, **given) -> dict:
    """A chain with the defaults of the configuration."""
    config["chains"]["mine"] = {**PLACE, "blocks": 4, "t_end": 20.0, **given}
    return checked(config)["chains"]["mine"]


@pytest.mark.parametrize(
    ("blocks", "ends"), [(2, "free"), (3, "ring"), (3, "plate"), (5, "free"), (20, "ring")]
)
def test_trajectory_is_that_of_another_code(programs, config, blocks, ends):
    """Random histories; the other code's error is about 1e-11."""
    draw = np.random.default_rng(blocks).uniform
    history = {
        "theta": draw(-0.1, 0.1, blocks).tolist(),
        "u": draw(-0.1, 0.1, blocks).tolist(),
        "v": np.exp(draw(-0.3, 0.3, blocks)).tolist(),
    }
    how = {"kappa": 1.7, "ends": ends, "sample_interval": 0.5, "tolerance": 1e-11}
    a_chain(config, blocks=blocks, history=history, **how)
    found = programs.made_of("trajectory", chain_groups(config, "mine"))
    assert dict(found.sizes) == {"t": 41, "block": blocks}
    assert found.attrs.items() >= {"blocks": blocks, "kappa": 1.7, "ends": ends}.items()
    np.testing.assert_array_equal(found.history_theta, history["theta"])
    states = solve_chain({**PLACE, **how, **history}, 20.0, 0.005)[::100]
    for place, values in enumerate((found.theta, found.u, np.log(found.v))):
        np.testing.assert_allclose(values, states[:, place], rtol=0, atol=1e-9)


@pytest.mark.parametrize(("file", "name"), [("long_chains", "erickson"), ("config", "no_delay")])
def test_chain_without_delay_is_that_of_scipy(programs, config, file, name):
    """The chains of Erickson, Birnir and Lavallee."""
    chain = read(ROOT / "config" / f"{file}.yaml")["chains"][name]
    bump = 1.5 * np.exp(-((np.arange(0.0, 21.0, 2.0) - 10.0) ** 2))
    np.testing.assert_allclose(chain["history"]["u"], bump, rtol=0, atol=1e-6)
    own = {"t_end": 100.0, "t_transient": 0.0, "tolerance": 1e-11, "variables": ["theta", "u", "v"]}
    a_chain(config, **{**chain, **own, "disturbance": {"ln_v": 0.0}})
    found = programs.made_of("trajectory", chain_groups(config, "mine"))
    epsilon, xi, gamma, kappa = (chain[key] for key in ("epsilon", "xi", "gamma", "kappa"))

    def rates(_, y: np.ndarray) -> np.ndarray:
        theta, u, w = y.reshape(3, -1)
        v = np.exp(w)
        force = u - kappa * second_difference(u, "free") + (theta + w) / xi
        return np.concatenate([-v * (theta + (1 + epsilon) * w), v - 1, -(gamma**2) / v * force])

    start = np.concatenate([np.zeros(11), chain["history"]["u"], np.zeros(11)])
    options = {"method": "DOP853", "t_eval": found.t.values, "rtol": 1e-12, "atol": 1e-12}
    expected = solve_ivp(rates, (0.0, 100.0), start, **options)
    values = np.concatenate([found.theta, found.u, np.log(found.v)], axis=1)
    np.testing.assert_allclose(values, expected.y.T, rtol=0, atol=1e-8)


def measured(programs, config: dict, scene: str, window: list, count: int) -> xr.Dataset:
    """A short measurement of the growth of disturbances."""
    t_end = config["scenes"][scene]["t_transient"] + 4000.0
    config["synchrony"] |= {"s_window": window, "count": count, "t_end": t_end, "blocks": 10}
    return programs.made_of("synchrony", synchrony_groups(config, scene))


def test_disturbances_grow_as_between_two_blocks(programs, config):
    """kappa = 0.0875: s = 1.175, where disturbances grow along the paper's torus."""
    place = {key: config["scenes"]["torus"][key] for key in ("tau", "epsilon", "xi", "gamma")}
    apart = {"v": [1.1 + 1e-9, 1.1 - 1e-9]}
    a_chain(
        config,
        **{**place, "blocks": 2, "kappa": 0.0875, "history": apart, "t_end": 3000.0},
        **{"sample_interval": 0.1, "tolerance": 1e-13, "variables": ["u", "v"]},
    )
    two = programs.made_of("trajectory", chain_groups(config, "mine"))
    distance = abs(np.log(two.v).diff("block")) + abs(two.u.diff("block"))
    highest = distance.sel(t=slice(1000.0, None)).isel(block=0).coarsen(t=2000, boundary="trim")
    peaks = highest.max()
    slope = np.polyfit(peaks.t, np.log(peaks), 1)[0]
    found = measured(programs, config, "torus", [1.175, 2.0], 2)
    assert found.s.values.tolist() == pytest.approx([1.175, 2.0])
    assert found.exponent.values[0] == pytest.approx(slope, rel=0.02)
    assert found.exponent.values[0] > 0 > found.exponent.values[1]
    assert 1.175 < found.zero_s.item() < 2.0
    assert found.zero_rises.item() == 0


@pytest.mark.parametrize(
    ("scene", "window", "zero"),
    [("torus", [1.0, 1.4], 1.2549), ("oscillation", [1.012, 3.0], 1.0243)],
)
def test_multipliers_and_exponents_agree(programs, config, scene, window, zero):
    """Two ways to one exponent and to its zero, within three standard errors."""
    found = measured(programs, config, scene, window, 4)
    assert "no_multipliers" not in found.attrs
    np.testing.assert_allclose(found.floquet_s[::10], found.s, rtol=1e-14)
    assert (abs(found.floquet_exponent.values[::10] - found.exponent) <= 3 * found.error).all()
    assert found.floquet_error.max() < 1e-9
    if window[0] == 1:
        assert found.floquet_exponent[0] == 0
    assert found.floquet_zero_s.item() == pytest.approx(zero, abs=1e-4)
    distance = abs(found.floquet_zero_s.item() - found.zero_s.item())
    assert distance <= 3 * found.zero_error.item() < 1e-2
    assert growing_ranges(found) == [(1.0, found.floquet_zero_s.item())]
    assert f"zero at s = {zero}" in synchrony.zeros_in_words(found)


def test_motion_without_cycle_has_no_multipliers(programs, config):
    """Chaos: the ranges are those of the exponents."""
    found = measured(programs, config, "chaos", [1.0, 41.0], 3)
    assert "cycle" in found.attrs["no_multipliers"]
    assert found.sizes["floquet_s"] == found.sizes["floquet_zero"] == 0
    assert growing_ranges(found) == [(1.0, found.zero_s.item())]


@pytest.mark.parametrize(("blocks", "alike"), [(6, True), (7, False)])
def test_largest_chain_that_moves_as_one(programs, config, blocks, alike):
    """Along the paper's torus disturbances grow up to s = 1.255: seven blocks separate."""
    assert (largest_alike([(1.0, 1.25493)], 1.0) >= blocks) == alike
    place = {key: config["scenes"]["torus"][key] for key in ("tau", "epsilon", "xi", "gamma")}
    a_chain(
        config,
        **{**place, "blocks": blocks, "kappa": 1.0, "disturbance": {"ln_v": 1e-6}},
        **{"t_end": 8000.0, "sample_interval": 0.5, "tolerance": 1e-12},
    )
    chain = programs.made_of("trajectory", chain_groups(config, "mine"))
    spread = np.log(chain.v).std("block")
    early, late = (float(spread.sel(t=slice(t, t + 500)).max()) for t in (3000, 7500))
    assert (late < early) == alike


@pytest.mark.parametrize(
    "ranges", [[], [(1.0, 1.2)], [(1.0, math.inf)], [(1.5, 1.9)], [(1.1, 1.15), (2.0, 2.2)]]
)
@pytest.mark.parametrize("kappa", [0.01, 0.1, 1.0, 10.0])
def test_largest_number_of_blocks_without_a_growing_mode(ranges, kappa):
    """As by trying all up to 300."""
    tried = [
        blocks
        for blocks in range(1, 301)
        if not any(
            low < 1 + kappa * (2 - 2 * math.cos(math.pi * m / blocks)) < high
            for m in range(1, blocks)
            for low, high in ranges
        )
    ]
    assert (largest_alike(ranges, kappa) or 300) == tried[-1]


def test_ranges_of_growth_end_at_zeros():
    """By multipliers where there are any; signs follow from the direction of the first zero."""

    def growth(zeros: list, rises: list, exponents: list, multipliers: bool) -> xr.Dataset:
        kind = "floquet_" if multipliers else ""
        none = {"floquet_s": [], "floquet_zero_s": [], "zero_s": []}
        values = {
            f"{kind}s": np.arange(1.0, len(exponents) + 1.0),
            f"{kind}exponent": (f"{kind}s", exponents),
            f"{kind}zero_s": (f"{kind}zero", zeros),
            f"{kind}zero_rises": (f"{kind}zero", rises),
        }
        return xr.Dataset({**none, **values})

    for multipliers in (False, True):
        assert growing_ranges(growth([], [], [0.0, -1.0], multipliers)) == []
        assert growing_ranges(growth([], [], [0.0, 1.0], multipliers)) == [(1.0, math.inf)]
        assert growing_ranges(growth([2.0], [0], [0.0, -1.0], multipliers)) == [(1.0, 2.0)]
        two = growth([2.0, 3.0, 4.0], [1, 0, 1], [0.0, 1.0], multipliers)
        assert growing_ranges(two) == [(2.0, 3.0), (4.0, math.inf)]
    # the exponents at s = 3 and 4 are within three errors of 0; of two blocks s = 1 + 2 kappa
    unsure = growth([3.5], [0], [0.1, 0.05, 0.01, -0.01, -0.1], False)
    unsure["error"] = ("s", [0.01] * 5)
    assert undecided_range(unsure) == (3.0, 4.0)
    assert undecided_blocks(unsure, 1.2, 3) == [2]
    assert undecided_blocks(unsure, 2.0, 3) == [3]


@pytest.mark.parametrize("ends", ENDS)
def test_eigenvalues_are_those_of_the_matrix(ends):
    """Of the second difference of a chain, each once."""
    matrix = np.array([second_difference(row, ends) for row in np.eye(6)])
    expected = sorted({round(value, 9) for value in -np.linalg.eigvalsh((matrix + matrix.T) / 2)})
    np.testing.assert_allclose(eigenvalues(6, ends), expected, atol=1e-9)


def test_modes_are_blocks_at_other_parameters(config):
    """gamma sqrt(s) and xi s; the first mode is the block itself."""
    first, last = (
        mode_groups(config, "block", str(number))["hopf_curves"]["parameters"]
        for number in (0, config["chain_modes"]["blocks"] - 1)
    )
    assert (first["xi"], first["gamma"]) == (0.5, 0.8)
    s = 1 + 4 * math.sin(math.pi * 5 / 12) ** 2
    assert (last["xi"], last["gamma"]) == pytest.approx((0.5 * s, 0.8 * math.sqrt(s)))


def test_disturbance_is_drawn_or_of_one_block(config):
    """The same for the same seed; sizes are bounds."""
    drawn = a_chain(config, disturbance={"ln_v": 0.2, "seed": 3})
    histories = histories_of(drawn)
    assert histories == histories_of(drawn)
    assert histories["theta"] == [0.0] * 4
    changes = np.log(np.array(histories["v"]) / 1.1)
    assert len(set(changes)) == 4
    assert (abs(changes) <= 0.2).all()
    one = histories_of(a_chain(config, disturbance={"u": 0.5, "block": 2}))
    assert one["u"] == [0.0, 0.5, 0.0, 0.0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"blocks": 1}, "blocks = 1; expected number of blocks, a whole number >= 2"),
        ({"blocks": 2, "ends": "ring"}, "blocks = 2; expected a whole number >= 3 with ends"),
        ({"kappa": -1.0}, "kappa = -1.0; expected spring constant"),
        ({"ends": "open"}, "ends = 'open'; expected"),
        ({"history": {"u": [0.0, 1.0]}}, "u has 2 numbers; expected one number, or 4"),
        ({"history": {"v": [1.0, 0.0, 1.0, 1.0]}}, "expected"),
        ({"disturbance": {"block": 5}}, "block = 5; expected a whole number >= 0 and <= blocks"),
        ({"t_transient": 30.0}, "t_transient = 30.0; expected a finite number >= 0 and < t_end"),
        ({"sample_interval": 30.0}, "sample_interval = 30.0; expected"),
        ({"law": "quasistatic_slip_delayed_logarithm", "zeta": 0.1}, "a law with inertia"),
    ],
)
def test_bad_chains_are_refused(config, given, words):
    """In one line that names the chain, the value and the range."""
    with pytest.raises(ConfigError, match=r"config chains mine") as refusal:
        a_chain(config, **given)
    assert words in str(refusal.value)


@pytest.mark.parametrize(
    ("section", "given", "words"),
    [
        ("synchrony", {"scenes": ["nowhere"]}, "'nowhere'; expected one of"),
        ("synchrony", {"s_window": [0.5, 2.0]}, "s_window"),
        ("synchrony", {"t_end": 10.0}, "t_end = 10.0; expected a finite number > t_transient"),
        ("chain_modes", {"blocks": 2, "ends": "ring"}, "blocks = 2; expected"),
    ],
)
def test_bad_studies_of_chains_are_refused(config, section, given, words):
    """As above."""
    config[section] |= given
    with pytest.raises(ConfigError) as refusal:
        checked(config)
    assert words in str(refusal.value)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda groups: groups.pop("blocks"), "namelist group &blocks: "),
        (lambda groups: groups["blocks"]["v"].pop(), "block 4 of scene 'mine': v = NaN"),
        (lambda groups: groups["blocks"]["v"].append(1.0), "namelist group &blocks: "),
        (lambda groups: groups["scene"]["parameters"].update(ends="open"), "ends"),
        (lambda groups: groups["scene"]["parameters"].update(kappa=-1.0), "kappa"),
        (lambda groups: groups["scene"]["parameters"].update(blocks=0), "blocks = 0"),
        (
            lambda groups: groups["scene"]["parameters"].update(
                law="quasistatic_slip_delayed_logarithm", own=[0.1]
            ),
            "a chain: law",
        ),
    ],
)
def test_program_refuses_bad_chains(programs, config, change, words):
    """Without a file left behind."""
    a_chain(config)
    groups = chain_groups(config, "mine")
    change(groups)
    run = programs.run_groups("trajectory", groups)
    assert run.returncode == 1
    assert words in run.stderr
    assert programs.left_behind() == []


def made_up(values: np.ndarray, ends: str = "free") -> xr.Dataset:
    """A chain with these ln v, shape (t, block)."""
    return xr.Dataset(
        {"v": (("t", "block"), np.exp(values))},
        coords={"t": np.arange(len(values), dtype=float)},
        attrs={"t_transient": 0.0, "ends": ends, "blocks": values.shape[1]},
    )


@pytest.mark.parametrize("ends", ENDS)
def test_strongest_mode(ends):
    """A standing wave has all its power in its mode."""
    j, mode = np.arange(1, 9), 3
    shapes = {
        "free": np.cos(math.pi * mode * (j - 0.5) / 8),
        "ring": np.cos(2 * math.pi * mode * j / 8),
        "plate": np.sin(math.pi * mode * j / 9),
    }
    wave = np.outer(np.cos(np.linspace(0, 20, 50)), shapes[ends])
    number, share = strongest_mode(made_up(wave, ends))
    assert (number, share) == (mode, pytest.approx(1))
    assert powers_of(made_up(wave, ends)).max() > 0.1


def test_chains_that_move_alike_do_not_show_that_more_blocks_differ():
    """The verdict is what the chains do."""
    alike = made_up(np.outer(np.sin(np.arange(30.0)), np.ones(4)))
    still = made_up(np.zeros((30, 4)))
    differ = made_up(np.outer(np.sin(np.arange(30.0)), [1.0, -1.0, 0.5, 2.0]))
    assert moves_alike(alike)
    assert rests(still)
    for chains, verdict in (
        ({"a": alike, "b": still}, NOT_REPRODUCED),
        ({"a": alike, "b": differ}, REPRODUCED),
    ):
        assert blocks_differ(Results(chains=chains), chains=["a", "b"]).verdict == verdict


def curves_of(programs, config: dict, plane: str) -> list[xr.Dataset]:
    """Hopf curves of all modes in a plane."""
    modes = range(len(stiffness_of_modes(config["chain_modes"])))
    return [programs.made_of("hopf", mode_groups(config, plane, str(mode))) for mode in modes]


def test_first_mode_of_a_fault_is_the_uniform_one(programs, config):
    """At gamma = 1e8 mode s becomes unstable without delay, at epsilon = xi s (Ruina 1983)."""
    config["chain_modes"] |= {"blocks": 2, "kappa": 0.5, "cells": 20}
    stiffness = stiffness_of_modes(config["chain_modes"])
    rows = mode_rows("fault", curves_of(programs, config, "fault"), stiffness)
    assert [row["s"] for row in rows] == [1.0, 2.0]
    np.testing.assert_allclose([row["epsilon"] for row in rows], [0.5, 1.0], rtol=1e-6)
    np.testing.assert_allclose([row["tau"] for row in rows], 0.0, atol=1e-9)
    assert [row["critical"] for row in rows] == ["yes", "no"]


def test_plane_without_curves_has_no_critical_mode(programs, config):
    """Below the least epsilon no mode becomes unstable."""
    config["chain_modes"] |= {"blocks": 2, "cells": 10}
    config["chain_modes"]["planes"]["block"]["epsilon_window"] = [0.0, 0.1]
    modes = curves_of(programs, config, "block")
    stiffness = stiffness_of_modes(config["chain_modes"])
    assert {row["critical"] for row in mode_rows("block", modes, stiffness)} == {"no"}
    assert chain_modes.critical_of(modes, stiffness) == "no mode becomes unstable"


@pytest.mark.parametrize("ends", ENDS)
def test_roots_of_modes_are_those_of_the_chain(programs, config, ends):
    """At each root the characteristic matrix of all blocks, by NumPy, is singular."""
    blocks, kappa, place = 4, 0.7, {"tau": 3.0, "epsilon": 0.9, "xi": 0.5, "gamma": 0.8}
    one = np.eye(blocks)
    stiffness = one - kappa * np.array([second_difference(row, ends) for row in one])
    for mu in eigenvalues(blocks, ends):
        s = 1 + kappa * mu
        of_mode = {**place, "xi": s * place["xi"], "gamma": math.sqrt(s) * place["gamma"]}
        own = {"law": config["scenes"]["torus"]["law"], **config["linear_stability"]}
        own["root_bound"] = -1.0
        found = programs.made_by("linear_stability", {**of_mode, **own})
        roots = found.root_real.values + 1j * found.root_imag.values
        assert roots.size > 3
        for root in roots:
            delayed = (1 + place["epsilon"]) * np.exp(-root * place["tau"])
            square = place["gamma"] ** 2
            friction = square / place["xi"]
            matrix = np.block(
                [
                    [(root + 1) * one, 0 * one, delayed * one],
                    [0 * one, root * one, -one],
                    [friction * one, square * stiffness, (root + friction) * one],
                ]
            )
            assert np.linalg.svd(matrix, compute_uv=False)[-1] < 1e-9

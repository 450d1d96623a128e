"""Chains of blocks: trajectories, and what is refused."""

import copy

import numpy as np
import pytest
from independent_chain import second_difference, solve_chain
from scipy.integrate import solve_ivp

from conftest import ROOT
from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError, read
from scripts.plans.studies import studies
from scripts.requests.parameters import histories_of
from scripts.requests.program_groups import scene_groups

PLACE = {"tau": 5.0, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}


def a_chain(config: dict, **given) -> dict:
    """A chain with the defaults of the configuration."""
    config["scenes"]["mine"] = {**PLACE, "blocks": 4, "kappa": 1.0, "t_end": 20.0, **given}
    return checked(config)["scenes"]["mine"]


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
    found = programs.made_of("trajectory", scene_groups(config, "mine"))
    assert dict(found.sizes) == {"t": 41, "block": blocks}
    assert found.attrs.items() >= {"blocks": blocks, "kappa": 1.7, "ends": ends}.items()
    np.testing.assert_array_equal(found.history_theta, history["theta"])
    states = solve_chain({**PLACE, **how, **history}, 20.0, 0.005)[::100]
    for place, values in enumerate((found.theta, found.u, np.log(found.v))):
        np.testing.assert_allclose(values, states[:, place], rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", ["erickson", "chain_no_delay"])
def test_chain_without_delay_is_that_of_scipy(programs, config, name):
    """The chains of Erickson, Birnir and Lavallee."""
    others = read(ROOT / "config" / "long_chains.yaml")["scenes"]
    chain = {"exponents": {}, **(config["scenes"] | others)[name]}
    del chain["exponents"]
    bump = 1.5 * np.exp(-((np.arange(0.0, 21.0, 2.0) - 10.0) ** 2))
    np.testing.assert_allclose(chain["history"]["u"], bump, rtol=0, atol=1e-6)
    own = {"t_end": 100.0, "t_transient": 0.0, "tolerance": 1e-11, "variables": ["theta", "u", "v"]}
    a_chain(config, **{**chain, **own, "disturbance": {"ln_v": 0.0}})
    found = programs.made_of("trajectory", scene_groups(config, "mine"))
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


def test_disturbance_is_drawn_or_of_one_block(config):
    """The same for the same seed; sizes are bounds."""
    drawn = a_chain(copy.deepcopy(config), disturbance={"ln_v": 0.2, "seed": 3})
    histories = histories_of(drawn)
    assert histories == histories_of(drawn)
    assert [block["theta"] for block in histories] == [0.0] * 4
    changes = np.log(np.array([block["v"] for block in histories]) / 1.1)
    assert len(set(changes)) == 4
    assert (abs(changes) <= 0.2).all()
    one = histories_of(a_chain(config, disturbance={"u": 0.5, "block": 2}))
    assert [block["u"] for block in one] == [0.0, 0.5, 0.0, 0.0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"blocks": 1}, "kappa = 1.0; expected 0 with blocks = 1"),
        ({"blocks": 1, "kappa": 0.0, "history": {"u": [0.0]}}, "u has 1 numbers; expected one"),
        ({"blocks": 2, "ends": "ring"}, "blocks = 2; expected a whole number >= 3 with ends"),
        ({"history": {"u": [0.0, 1.0]}}, "u has 2 numbers; expected one number, or 4"),
        ({"history": {"v": [1.0, 0.0, 1.0, 1.0]}}, "expected"),
        ({"disturbance": {"w": 1.0}}, "unknown key ['w']; allowed: seed, block, theta, ln_theta"),
        ({"disturbance": {"block": 5}}, "block = 5; expected a whole number >= 0 and <= blocks"),
        ({"law": "quasistatic_slip_delayed_logarithm", "zeta": 0.1}, "a law with inertia"),
    ],
)
def test_bad_chains_are_refused(config, given, words):
    """In one line that names the chain, the value and the range."""
    with pytest.raises(ConfigError, match=r"scene 'mine'") as refusal:
        a_chain(config, **given)
    assert words in str(refusal.value)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda groups: groups.pop("histories"), "namelist group &histories: "),
        (lambda groups: groups["histories"]["values"].pop(), "values"),
        (lambda groups: groups["scene"]["model"].update(ends="open"), "ends"),
    ],
)
def test_program_refuses_bad_chains(programs, config, change, words):
    """Without a file left behind."""
    a_chain(config)
    changed = scene_groups(config, "mine")
    change(changed)
    run = programs.run_groups("trajectory", changed)
    assert run.returncode == 1
    assert words in run.stderr
    assert programs.left_behind() == []


@pytest.mark.parametrize("ends", ["free", "ring", "plate"])
def test_roots_of_modes_are_those_of_the_chain(programs, config, ends):
    """At each root the characteristic matrix of all blocks, by NumPy, is singular."""
    kappa, (tau, epsilon, xi, gamma) = 0.7, PLACE.values()
    a_chain(config, kappa=kappa, ends=ends)
    config["linear_stability"] = {"root_bound": -1.0}
    (stability,) = studies()["linear_stability"].runs
    found = programs.made_of("linear_stability", stability.groups(checked(config), "mine"))
    roots = found.root_real.values + 1j * found.root_imag.values
    assert roots.size > 3 * 4
    one, square = np.eye(4), gamma**2
    stiffness = one - kappa * np.array([second_difference(row, ends) for row in one])
    for root in roots:
        delayed = (1 + epsilon) * np.exp(-root * tau)
        matrix = np.block(
            [
                [(root + 1) * one, 0 * one, delayed * one],
                [0 * one, root * one, -one],
                [square / xi * one, square * stiffness, (root + square / xi) * one],
            ]
        )
        assert np.linalg.svd(matrix, compute_uv=False)[-1] < 1e-9

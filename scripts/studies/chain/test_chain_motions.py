"""Motions of chains: modes, the claim, the table and its figure."""

import numpy as np
import pytest
from independent_chain import made_up_chain
from made_up_results import NO, YES, assert_finding

from scripts.config.check_config import checked
from scripts.plans.studies import studies
from scripts.requests.program_groups import scene_groups
from scripts.studies.chain import exponents_figure
from scripts.studies.chain.finding import describe
from scripts.studies.chain.table import (
    exponents_of,
    motion_of,
    motion_row,
    moves_alike,
    powers_of,
    rests,
    strongest_mode,
)

(EXPONENTS,) = studies()["exponents"].runs


def row_of(programs, config: dict, **given) -> dict:
    """The row of a chain of two blocks of scene oscillation that the programs compute."""
    place = {"tau": 10.0, "epsilon": 0.35, "xi": 0.8, "gamma": 0.8, "blocks": 2}
    times = {"t_end": 6000.0, "t_transient": 3000.0, "sample_interval": 0.5, "tolerance": 1e-6}
    measured = {"variables": ["v"], "exponents": {"t_turning": 200.0}}
    disturbance = {"disturbance": {"ln_v": 0.01}}
    config["scenes"]["mine"] = {**place, **times, **measured, **disturbance, **given}
    checked(config)
    trajectory = programs.made_of("trajectory", scene_groups(config, "mine"))
    return motion_row(trajectory, programs.made_of("exponents", EXPONENTS.groups(config, "mine")))


@pytest.mark.parametrize("ends", ["free", "plate"])
def test_exponents_at_rest_are_those_of_the_linear_chain(programs, config, ends):
    """Without delay they are real parts of eigenvalues, by NumPy; all blocks come to rest."""
    place = {"tau": 0.0, "epsilon": 0.12, "xi": 0.5, "gamma": 0.5}
    row = row_of(programs, config, **place, kappa=0.25, ends=ends)
    epsilon, xi, gamma = place["epsilon"], place["xi"], place["gamma"]
    second = np.array([[-1.0, 1.0], [1.0, -1.0]]) - (ends == "plate") * np.eye(2)
    one, none = np.eye(2), np.zeros((2, 2))
    stretch = -(gamma**2) * (one - 0.25 * second)
    linear = np.block(
        [
            [-one, none, -(1 + epsilon) * one],
            [none, none, one],
            [-(gamma**2) / xi * one, stretch, -(gamma**2) / xi * one],
        ]
    )
    expected = sorted(np.linalg.eigvals(linear).real, reverse=True)[:4]
    assert row["motion"] == "rest"
    np.testing.assert_allclose(exponents_of(row), expected, atol=2e-3)


def test_motion_in_words():
    """Rest, blocks that move alike or not, chaos."""
    assert motion_of(True, True, ["negative"]) == "rest"
    assert motion_of(False, True, ["zero"]) == "synchronous"
    assert motion_of(False, True, ["positive", "zero"]) == "synchronous, chaotic"
    assert motion_of(False, False, ["positive"]) == "pattern, chaotic"


def test_exponents_of_a_chain_are_measured_once(filled_config):
    """Two more than it has blocks, up to its own end; one block is checked at other tolerances."""
    exponents = EXPONENTS.groups(filled_config, "chaos_5")["exponents"]
    assert (exponents["count"], exponents["t_end"], exponents["t_turning"]) == (7, 9000.0, 200.0)
    assert not [key for key in exponents if key.startswith("check")]
    assert "check_tolerances" in EXPONENTS.groups(filled_config, "torus")["exponents"]


PLACE = {"ends": "free", "tau": 7.0, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8, "law": "slip"}


ROWS = [
    {"chain": "a", "blocks": 2, "kappa": 1.0, "positive_exponents": 1, "exponents": "0.2 0.0 -0.1"},
    {"chain": "b", "blocks": 4, "kappa": 1.0, "positive_exponents": 3, "exponents": "0.3 0.2 0.1"},
    {
        "chain": "torus_2",
        "blocks": 2,
        "kappa": 9.0,
        "positive_exponents": 0,
        "exponents": "0.0 -0.1",
    },
]


def test_figure_has_a_line_for_each_chaotic_chain():
    """Over (number - 1/2)/blocks; the count of positive ones over the blocks."""
    rows = [{**PLACE, "motion": "pattern", "unclear_exponents": 2, **row} for row in ROWS]
    spectra, counts = exponents_figure.draw(rows).axes
    lines = [line.get_xdata().tolist() for line in spectra.lines[:2]]
    assert lines == [[0.25, 0.75, 1.25], [0.125, 0.375, 0.625]]
    ticks = [*counts.xaxis.get_majorticklocs(), *counts.yaxis.get_majorticklocs()]
    assert ticks == list(map(round, ticks))
    (line,) = counts.lines
    assert (list(line.get_xdata()), list(line.get_ydata())) == ([2, 4], [1, 3])
    (bars,) = counts.collections
    assert [bar[:, 1].tolist() for bar in bars.get_segments()] == [[1, 3], [3, 5]]
    (family,) = exponents_figure.numbers(rows)["families"]
    assert "1 and 2 unclear of 2 blocks" in family["counts"]
    assert exponents_figure.numbers(rows)["others"] == [
        r"torus (2 blocks, :math:`\kappa` = 9): pattern"
    ]


@pytest.mark.parametrize("holds", [True, False])
def test_finding_follows_the_table(holds):
    """The title says the opposite if the results do."""
    rows = [
        {"xi": 0.5, "gamma": 0.8, "epsilon": 0.5, "blocks": blocks, "tau": tau}
        | {"positive_exponents": count}
        for blocks, tau, count in ((2, 7.0, 1), (9, 7.0, 5), (11, 0.0, 2))
    ]
    found = describe({"chain_motions": rows if holds else rows[:1]})
    assert found["title"].startswith("In chains" if holds else "Chains of blocks are not")
    assert ("9 blocks with $tau = 7$ have at least 5 positive Lyapunov" in found["words"]) is holds
    assert ("Without delay 11 blocks have at least 2 positive" in found["words"]) is holds


def test_chains_that_move_alike_do_not_show_that_more_blocks_differ():
    """The verdict is what the chains do."""
    alike = made_up_chain(np.outer(np.sin(np.arange(30.0)), np.ones(4)))
    still = made_up_chain(np.zeros((30, 4)))
    differ = made_up_chain(np.outer(np.sin(np.arange(30.0)), [1.0, -1.0, 0.5, 2.0]))
    assert moves_alike(alike)
    assert rests(still)
    for other, verdict in ((still, NO), (differ, YES)):
        made = {"trajectories": {"a": alike, "b": other}}
        assert_finding("blocks_differ", {"scenes": ["a", "b"]}, made, verdict)


@pytest.mark.parametrize("ends", ["free", "ring", "plate"])
def test_strongest_mode(ends):
    """A standing wave has all its power in its mode."""
    j, mode = np.arange(1, 9), 3
    shapes = {
        "free": np.cos(np.pi * mode * (j - 0.5) / 8),
        "ring": np.cos(2 * np.pi * mode * j / 8),
        "plate": np.sin(np.pi * mode * j / 9),
    }
    chain = made_up_chain(np.outer(np.cos(np.linspace(0, 20, 50)), shapes[ends]), ends)
    assert strongest_mode(chain) == (mode, pytest.approx(1))
    assert powers_of(chain).max() > 0.1

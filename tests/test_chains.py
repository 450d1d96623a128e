"""Chains of blocks: their modes, which several studies use."""

import math

import numpy as np
import pytest
from independent_chain import made_up_chain, second_difference

from scripts.config.check_config import checked
from scripts.studies.linear_stability.plan import groups
from scripts.tables.chain_motions import powers_of, strongest_mode

ENDS = ["free", "ring", "plate"]


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
    number, share = strongest_mode(made_up_chain(wave, ends))
    assert (number, share) == (mode, pytest.approx(1))
    assert powers_of(made_up_chain(wave, ends)).max() > 0.1


@pytest.mark.parametrize("ends", ENDS)
def test_roots_of_modes_are_those_of_the_chain(programs, config, ends):
    """At each root the characteristic matrix of all blocks, by NumPy, is singular."""
    blocks, kappa, place = 4, 0.7, {"tau": 3.0, "epsilon": 0.9, "xi": 0.5, "gamma": 0.8}
    config["scenes"]["mine"] = {
        **place,
        "blocks": blocks,
        "kappa": kappa,
        "ends": ends,
        "t_end": 1.0,
    }
    config["linear_stability"] = {"root_bound": -1.0}
    found = programs.made_of("linear_stability", groups(checked(config), "mine"))
    roots = found.root_real.values + 1j * found.root_imag.values
    assert roots.size > 3 * blocks
    one = np.eye(blocks)
    stiffness = one - kappa * np.array([second_difference(row, ends) for row in one])
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

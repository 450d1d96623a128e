"""Modes of a chain: their Hopf curves."""

import copy
import math

import numpy as np
import pytest
import xarray as xr

from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError
from scripts.studies.chain_modes.figure import critical_of
from scripts.studies.chain_modes.plan import groups, stiffness_of_modes
from scripts.studies.chain_modes.table import mode_rows


@pytest.fixture
def config(filled_config) -> dict:
    """The paper's configuration with its defaults, to change."""
    return copy.deepcopy(filled_config)


def test_modes_are_blocks_at_other_parameters(config):
    """gamma sqrt(s) and xi s; the first mode is the block itself."""
    first, last = (
        groups(config, "block", str(number))["hopf_curves"]["parameters"]
        for number in (0, config["chain_modes"]["blocks"] - 1)
    )
    assert (first["xi"], first["gamma"]) == (0.5, 0.8)
    s = 1 + 4 * math.sin(math.pi * 5 / 12) ** 2
    assert (last["xi"], last["gamma"]) == pytest.approx((0.5 * s, 0.8 * math.sqrt(s)))


def test_ring_of_two_blocks_is_refused(config):
    config["chain_modes"] |= {"blocks": 2, "ends": "ring"}
    with pytest.raises(ConfigError, match="blocks = 2; expected"):
        checked(config)


def curves_of(programs, config: dict, plane: str) -> list[xr.Dataset]:
    """Hopf curves of all modes in a plane."""
    modes = range(len(stiffness_of_modes(config["chain_modes"])))
    return [programs.made_of("hopf", groups(config, plane, str(mode))) for mode in modes]


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
    assert critical_of(modes, stiffness) == "no mode becomes unstable"

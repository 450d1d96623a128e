"""Modes of a chain: their Hopf curves."""

import copy
import math

import numpy as np
import pytest
import xarray as xr

from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError
from scripts.requests.parameters import plane_group
from scripts.studies.chain_modes.figure import critical_of
from scripts.studies.chain_modes.plan import groups, modes_of
from scripts.studies.chain_modes.table import mode_rows, stiffness_of


@pytest.fixture
def config(filled_config) -> dict:
    """The paper's configuration with its defaults, to change."""
    return copy.deepcopy(filled_config)


@pytest.mark.parametrize(
    ("ends", "mode", "mu"),
    [
        ("free", 2, 2 - 3**0.5),
        ("ring", 4, 4.0),
        ("plate", 0, 0.0),
        ("plate", 1, 2 - 2 * math.cos(math.pi / 7)),
    ],
)
def test_modes_are_blocks_at_other_parameters(programs, config, ends, mode, mu):
    """gamma sqrt(s) and xi s, where s = 1 + kappa mu; six blocks, kappa = 1."""
    config["chain_modes"] |= {"ends": ends, "cells": 10}
    found = programs.made_of("hopf", groups(config, "block", str(mode)))
    s = stiffness_of(found)
    assert s == pytest.approx(1 + mu)
    alone = copy.deepcopy(config["chain_modes"]["planes"]["block"])
    windows = {
        "abscissa_window": alone.pop("epsilon_window"),
        "ordinate_window": alone.pop("tau_window"),
    }
    alone |= {"abscissa": "epsilon", "ordinate": "tau", "cells": 10, **windows}
    alone |= {"xi": s * alone["xi"], "gamma": math.sqrt(s) * alone["gamma"]}
    block = programs.made_of("hopf", {"hopf_curves": plane_group(config, alone)})
    for name in ("epsilon", "tau", "omega", "map_unstable_roots"):
        np.testing.assert_allclose(found[name], block[name], rtol=0, atol=1e-12)


def test_modes_of_a_chain(config):
    """Of a ring each frequency once; that of a block alone first, also between plates."""
    counts = {}
    for ends in ("free", "ring", "plate"):
        config["chain_modes"]["ends"] = ends
        counts[ends] = list(modes_of(config))
    assert counts["free"] == [1, 2, 3, 4, 5, 6]
    assert counts["ring"] == [1, 2, 3, 4]
    assert counts["plate"] == [0, 1, 2, 3, 4, 5, 6]


def test_ring_of_two_blocks_is_refused(config):
    config["chain_modes"] |= {"blocks": 2, "ends": "ring"}
    with pytest.raises(ConfigError, match="blocks = 2; expected"):
        checked(config)


def curves_of(programs, config: dict, plane: str) -> list[xr.Dataset]:
    """Hopf curves of all modes in a plane."""
    return [programs.made_of("hopf", groups(config, plane, str(mode))) for mode in modes_of(config)]


def test_first_mode_of_a_fault_is_the_uniform_one(programs, config):
    """At gamma = 1e8 mode s becomes unstable without delay, at epsilon = xi s (Ruina 1983)."""
    config["chain_modes"] |= {"blocks": 2, "kappa": 0.5, "cells": 20}
    rows = mode_rows("fault", curves_of(programs, config, "fault"))
    assert [row["s"] for row in rows] == pytest.approx([1.0, 2.0])
    np.testing.assert_allclose([row["epsilon"] for row in rows], [0.5, 1.0], rtol=1e-6)
    np.testing.assert_allclose([row["tau"] for row in rows], 0.0, atol=1e-9)
    assert [row["critical"] for row in rows] == ["yes", "no"]


def test_plane_without_curves_has_no_critical_mode(programs, config):
    """Below the least epsilon no mode becomes unstable."""
    config["chain_modes"] |= {"blocks": 2, "cells": 10}
    config["chain_modes"]["planes"]["block"]["epsilon_window"] = [0.0, 0.1]
    modes = curves_of(programs, config, "block")
    assert {row["critical"] for row in mode_rows("block", modes)} == {"no"}
    assert critical_of(modes) == "no mode becomes unstable"

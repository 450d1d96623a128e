"""Synchrony: growth of disturbances along the motion of one block."""

import copy
import math

import numpy as np
import pytest
import xarray as xr

from scripts.requests.program_groups import scene_groups
from scripts.studies.synchrony.figure import growing_ranges, largest_alike
from scripts.studies.synchrony.plan import groups


@pytest.fixture
def config(filled_config) -> dict:
    """The paper's configuration with its defaults, to change."""
    return copy.deepcopy(filled_config)


def measured(programs, config: dict, scene: str, window: list, count: int) -> xr.Dataset:
    """A short measurement of the growth of disturbances."""
    t_end = config["scenes"][scene]["t_transient"] + 4000.0
    config["synchrony"] |= {"s_window": window, "count": count, "t_end": t_end, "batches": 10}
    return programs.made_of("synchrony", groups(config, scene))


def test_disturbances_grow_as_between_two_blocks(programs, config):
    """kappa = 0.0875: s = 1.175, where disturbances grow along the paper's torus."""
    config["scenes"]["two"] = {
        **{**config["scenes"]["torus"], "blocks": 2, "kappa": 0.0875, "t_end": 3000.0},
        **{"history": {"theta": 0.0, "u": 0.0, "v": [1.1 + 1e-9, 1.1 - 1e-9]}},
        **{"sample_interval": 0.1, "tolerance": 1e-13, "variables": ["u", "v"]},
    }
    two = programs.made_of("trajectory", scene_groups(config, "two"))
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

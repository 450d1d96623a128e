# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the package share."""

import delaykit as dk
import matplotlib
import pytest
from matplotlib import pyplot

matplotlib.use("agg")

MACKEY_GLASS = "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y"
NUMBERS = {"beta": 0.2, "n": 10, "rate": 0.1, "tau": 17}


@pytest.fixture(scope="session", autouse=True)
def cache(tmp_path_factory):
    """A cache of these tests alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("DELAYKIT_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(autouse=True)
def _closed_figures():
    yield
    pyplot.close("all")


@pytest.fixture(scope="session")
def mackey_glass(cache) -> dk.Model:
    """The model of Mackey and Glass (1977)."""
    return dk.Model({"y": MACKEY_GLASS}, NUMBERS, name="mackey_glass")


@pytest.fixture(scope="session")
def sine(cache) -> dk.Model:
    """y' = -y(t - pi/2), of which sin t is a solution."""
    return dk.Model({"y": "-y(t - lag)"}, {"lag": 1.5707963267948966}, name="sine")

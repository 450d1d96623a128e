# SPDX-License-Identifier: BSD-3-Clause
"""What the files of the gallery share when they are run."""

import sys
from collections.abc import Callable, Mapping


def show(numbers: Callable, published: Mapping[str, tuple], plot: Callable) -> None:
    """Print numbers beside the published ones, pairs (value, within), and plot after --plot."""
    for name, value in numbers().items():
        known, within = published[name]
        print(f"{name}: {float(value):.10g}; published: {known:.10g} within {within:g}")
    if "--plot" in sys.argv[1:]:
        from matplotlib import pyplot

        plot()
        pyplot.show()

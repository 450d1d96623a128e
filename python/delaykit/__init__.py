# SPDX-License-Identifier: BSD-3-Clause
"""Models with constant delays: runs, exponents, Hopf points, cycles and scans."""

from delaykit.errors import CompilerError, DelaykitError, ModelError, RunError, RunInterruptedError
from delaykit.events import Event
from delaykit.model import Model
from delaykit.plots import plot
from delaykit.spectra import spectrum
from delaykit.version import __version__

__all__ = [
    "CompilerError",
    "DelaykitError",
    "Event",
    "Model",
    "ModelError",
    "RunError",
    "RunInterruptedError",
    "__version__",
    "plot",
    "spectrum",
]

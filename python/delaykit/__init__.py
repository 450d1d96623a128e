"""Models with constant delays: runs, exponents, Hopf points, cycles and scans."""

from delaykit.errors import CompilerError, DelaykitError, InterruptedRun, ModelError, RunError
from delaykit.events import Event
from delaykit.model import Model
from delaykit.plots import plot
from delaykit.spectra import spectrum
from delaykit.version import __version__

__all__ = [
    "CompilerError",
    "DelaykitError",
    "Event",
    "InterruptedRun",
    "Model",
    "ModelError",
    "RunError",
    "__version__",
    "plot",
    "spectrum",
]

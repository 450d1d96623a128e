"""What all figures share: the style, the way they are saved, and the log of a script."""

import contextlib
import traceback
from collections.abc import Iterator
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

STYLE = Path(__file__).parent / "paper.mplstyle"
INK = "0.15"
FAINT = "0.7"
"""Greys for drawing and for what stays in the background."""


def save(figure: Figure, pdf: str | Path, png: str | Path) -> None:
    """Write a figure as vector and as picture, the same bytes each time."""
    figure.savefig(pdf, metadata={"CreationDate": None})
    figure.savefig(png)
    plt.close(figure)


@contextlib.contextmanager
def logged(path: str | Path) -> Iterator[None]:
    """Use the style; write warnings and the reason of a failure to a log file."""
    with (
        open(path, "w") as log,
        contextlib.redirect_stderr(log),
        plt.style.context(STYLE),
    ):
        try:
            yield
        except Exception:
            traceback.print_exc()
            raise

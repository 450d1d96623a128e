"""What all figures share: the style, the way they are saved, and the log of a script."""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import outputs
from matplotlib.figure import Figure

STYLE = Path(__file__).parent / "paper.mplstyle"
INK = "0.15"
FAINT = "0.7"
"""Greys for drawing and for what stays in the background."""


def save(figure: Figure, pdf: str | Path, png: str | Path) -> None:
    """Write a figure as vector and as picture, the same bytes each time."""
    for final, ending, metadata in ((pdf, "pdf", {"CreationDate": None}), (png, "png", None)):
        # to memory first: matplotlib hides that a disk is full
        drawn = io.BytesIO()
        figure.savefig(drawn, format=ending, metadata=metadata)
        with outputs.written(final) as path:
            path.write_bytes(drawn.getvalue())
    plt.close(figure)


@contextlib.contextmanager
def logged(path: str | Path) -> Iterator[None]:
    """Use the style; write warnings and the reason of a failure to a log file."""
    with outputs.logged(path), plt.style.context(STYLE):
        yield

"""What all figures share: the style, the way they are saved, and the log of a script."""

import contextlib
import io
import re
from collections.abc import Iterator
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.text import Text

from scripts.files import outputs

STYLE = Path(__file__).parent / "paper.mplstyle"
INK = "0.15"
FAINT = "0.7"
"""Greys for drawing and for what stays in the background."""


METADATA = {"pdf": {"CreationDate": None}, "png": None, "svg": {"Date": None}}
"""For each ending that a figure is saved with: what keeps its bytes the same each time."""


def break_titles(figure: Figure) -> None:
    """Break titles wider than the page between words: formulas, parted by dollars, lose blanks."""
    titles = {axes.get_title("left") for axes in figure.axes}
    titles |= {part.get_suptitle() for part in (figure, *figure.subfigs)}
    for text in figure.findobj(Text):
        if text.get_text() in titles:
            parts = text.get_text().split("$")
            parts[1::2] = [re.sub(" (?=[A-Za-z])", "{}", x).replace(" ", "") for x in parts[1::2]]
            text.set(text="$".join(parts), wrap=True)


def save(figure: Figure, output) -> None:
    """Write a figure for print, as picture and for the page; `output` names the three files."""
    break_titles(figure)
    # the layout once for all three: without an engine none of them draws twice
    figure.draw_without_rendering()
    with plt.rc_context({"figure.constrained_layout.use": False}):
        figure.set_layout_engine(None)
        for ending, metadata in METADATA.items():
            final = getattr(output, ending)
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

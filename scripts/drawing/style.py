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
from matplotlib.ticker import FixedLocator

from scripts.files import outputs

STYLE = Path(__file__).parent / "paper.mplstyle"
PAGE = (6.7, 9.2)
"""Width of a printed text, and the greatest height of a figure, in inches."""
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
        if text.get_text() and text.get_text() in titles:
            parts = text.get_text().split("$")
            parts[1::2] = [re.sub(" (?=[A-Za-z])", "{}", x).replace(" ", "") for x in parts[1::2]]
            text.set(text="$".join(parts), wrap=True)


def columns_of(panels: int, height: float) -> int:
    """One column for panels of this height, or two if they were higher than a page."""
    return 1 if panels * height <= PAGE[1] - 1 else 2


def move_offsets(figure: Figure) -> bool:
    """Factor and offset of an axis into its label, once drawn: else they lie over it or a title."""
    each = [axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    found = [axis for axis in each if axis.offsetText.get_visible() and axis.offsetText.get_text()]
    for axis in found:
        # other ticks could have another factor
        axis.set_major_locator(FixedLocator(axis.get_majorticklocs()))
        axis.label.set_text(f"{axis.label.get_text()}\n({axis.offsetText.get_text()})".strip())
        axis.offsetText.set_visible(False)
    return bool(found)


def save(figure: Figure, output) -> None:
    """Write a figure for print, as picture and for the page; `output` names the files."""
    break_titles(figure)
    # the layout once for all three: without an engine none of them draws twice
    figure.draw_without_rendering()
    if move_offsets(figure):
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

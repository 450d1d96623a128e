"""What the tests of figures read off them."""

import re

from matplotlib.figure import Figure
from matplotlib.text import Text

from scripts.drawing.style import PAGE


def words_in(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def hyphens_before_numbers(figure: Figure) -> list[str]:
    """Texts, without their formulas, that have a hyphen in the place of a minus sign."""
    plain = ["".join(text.get_text().split("$")[::2]) for text in figure.findobj(Text)]
    return [text for text in plain if re.search(r"(?<!\w)-\d", text)]


def title_of(axes) -> str:
    return "".join(axes.get_title(loc=place) for place in ("left", "center", "right"))


def points_in(axes) -> list[tuple[float, float, str]]:
    """Single points drawn in axes, with their filling."""
    lines = [line for line in axes.lines if line.get_marker() == "o" and len(line.get_xdata()) == 1]
    return [(line.get_xdata()[0], line.get_ydata()[0], line.get_mfc()) for line in lines]


LEAST_SIZE, LARGEST_SIZE = 7, 12
"""Of letters in points. The least is 9 px high on a phone, where the page scrolls wide figures."""


def assert_on_page(figure: Figure) -> None:
    """At printed size it is on one page, nothing is cut off, and all words can be read."""
    figure.canvas.draw()
    box, (width, height) = figure.get_tightbbox(), figure.get_size_inches()
    assert width <= PAGE[0]
    assert height <= PAGE[1]
    assert min(box.x0, box.y0) >= -0.02
    assert box.x1 <= width + 0.02
    assert box.y1 <= height + 0.02
    sizes = [text.get_fontsize() for text in figure.findobj(Text) if text.get_text()]
    assert min(sizes) >= LEAST_SIZE
    assert max(sizes) <= LARGEST_SIZE

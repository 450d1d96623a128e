"""The drawing of block and spring (Figure 1)."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

from scripts.drawing.style import FAINT, INK

BLOCK = (2.6, 0.9, 2.2, 1.2)
"""Left, bottom, width and height of the block."""
PLATE = (0.6, 3.1, 9.4, 0.42)
"""Left, bottom, width and height of the loader plate."""
ARM = 8.9
"""Where the arm of the loader plate hangs: in front of the block, which it pulls."""


def rough_surface(*, left: float, right: float, height: float, bumps: int) -> np.ndarray:
    """Vertices of a rough line, shape (2 bumps + 1, 2), in units of the drawing."""
    x = np.linspace(left, right, 2 * bumps + 1)
    wave = 0.45 + 0.35 * np.sin(2.3 * np.arange(x.size)) + 0.2 * np.sin(5.1 * np.arange(x.size))
    return np.column_stack([x, height * np.where(np.arange(x.size) % 2, wave, -wave)])


def spring(*, left: float, right: float, y: float, turns: int, width: float) -> np.ndarray:
    """Vertices of a coil spring with straight ends, shape (2 turns + 4, 2)."""
    coil = np.linspace(left + 0.35, right - 0.35, 2 * turns + 2)
    zigzag = np.where(np.arange(coil.size) % 2, width, -width)
    zigzag[[0, -1]] = 0.0
    x = np.concatenate([[left], coil, [right]])
    return np.column_stack([x, y + np.concatenate([[0.0], zigzag, [0.0]])])


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float]) -> None:
    """An arrow between two points of the drawing."""
    axes.add_patch(
        FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=9, lw=1.0, color=INK)
    )


def draw() -> Figure:
    """The drawing."""
    figure, axes = plt.subplots(figsize=(3.6, 1.5))
    surface = rough_surface(left=0.2, right=10.4, height=0.14, bumps=34)
    surface[:, 1] += BLOCK[1] - 0.14
    ground = np.vstack([surface, [[10.4, 0.1], [0.2, 0.1]]])
    axes.add_patch(Polygon(ground, closed=True, facecolor="0.85", edgecolor="none"))
    axes.plot(*surface.T, color=INK, lw=1.2)

    left, bottom, width, height = BLOCK
    axes.add_patch(Rectangle((left, bottom), width, height, facecolor="#cfe3f2", edgecolor=INK))
    middle = bottom + height / 2
    axes.text(left + width / 2, middle, "block\nmass $M$", ha="center", va="center")

    axes.add_patch(Rectangle(PLATE[:2], *PLATE[2:], facecolor=FAINT, edgecolor=INK))
    axes.text(
        PLATE[0] + PLATE[2] / 2, PLATE[1] + PLATE[3] / 2, "loader plate", ha="center", va="center"
    )
    axes.plot([ARM, ARM], [PLATE[1], middle - 0.25], color=INK, lw=3, solid_capstyle="butt")
    coil = spring(left=left + width, right=ARM, y=middle, turns=9, width=0.24)
    axes.plot(*coil.T, color=INK, lw=1.1)
    axes.text(
        (left + width + ARM) / 2, middle + 0.42, "spring, stiffness $k$", ha="center", va="bottom"
    )

    arrow(axes, (8.3, 3.85), (9.9, 3.85))
    axes.text(8.15, 3.85, "velocity $v_0$", ha="right", va="center")
    arrow(axes, (left + width - 0.8, 2.45), (left + width + 0.4, 2.45))
    axes.text(left + width - 0.95, 2.45, "velocity $v$", ha="right", va="center")
    arrow(axes, (left - 0.1, 0.42), (left - 1.2, 0.42))
    axes.text(left, 0.42, r"friction $\mu(v, \theta)$ on the rough surface", ha="left", va="center")

    axes.set(xlim=(0.1, 10.5), ylim=(0.05, 4.15), aspect="equal")
    axes.axis("off")
    return figure

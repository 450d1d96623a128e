"""Labels beside points where nothing is in the way."""

import itertools
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

from scripts.drawing.style import INK

Place = tuple[float, float]
"""A point of the data."""
DISTANCES = (5.0, 11.0, 18.0, 26.0, 36.0)
"""Of a label from its point, in points of print."""
DIRECTIONS = np.radians([0, 180, 90, 270, 45, 135, 315, 225, 22, 158, 338, 202, 67, 113, 247, 293])
CLEAR = 1.5
"""Free space around a label, in points of print."""
BESIDE = 6.0
"""A label nearer to its point than this needs no line to it."""
NEAR, NEAR_TIED = 2.5, 0.7
"""Other points are farther from such a label by at least this factor, or from one with a line."""
LEADER = {"arrowstyle": "-", "lw": 0.5, "color": INK, "shrinkA": 0.5, "shrinkB": 2.5}


@dataclass
class Obstacles:
    """What is drawn in axes, in pixels."""

    lines: list[Path]
    boxes: list[Bbox]
    """Markers and labels."""
    frame: Bbox
    """Where the axes end."""

    def leave_free(self, box: Bbox) -> bool:
        """Whether a label fits here."""
        inside = all(self.frame.contains(*corner) for corner in (box.min, box.max))
        return inside and not (
            any(path.intersects_bbox(box, filled=False) for path in self.lines)
            or any(box.overlaps(other) for other in self.boxes)
        )

    def cross(self, leader: Path) -> bool:
        """Whether a line from a point to its label meets anything but the point's own marker."""
        start = leader.vertices[0]
        return any(leader.intersects_path(path, filled=False) for path in self.lines) or any(
            leader.intersects_bbox(box, filled=False)
            for box in self.boxes
            if not box.contains(*start)
        )


def label_points(axes: Axes, names: dict[Place, str]) -> None:
    """Write each name near its point, over no line, marker or other name.

    A thin line ties it to its point where it is farther away. Whatever else is in the figure must
    be there already, because it decides where axes end. A name that finds no place is placed first
    in another attempt.
    """
    axes.figure.draw_without_rendering()
    order = list(names)
    for _ in names:
        labels = {}
        obstacles = obstacles_in(axes)
        for place in order:
            labels[place] = placed(axes, place, names, obstacles)
        lost = [place for place in order if labels[place] is None]
        if not lost:
            return
        for label in filter(None, labels.values()):
            label.remove()
        order = [*lost, *(place for place in order if place not in lost)]
    obstacles = obstacles_in(axes)
    for place in order:
        if placed(axes, place, names, obstacles) is None:
            written(axes, names[place], place, DISTANCES[0], DIRECTIONS[0])


def placed(
    axes: Axes, place: Place, names: dict[Place, str], obstacles: Obstacles
) -> Annotation | None:
    """The label of a place where it is free, from then on an obstacle; None where nothing is."""
    scale = axes.figure.dpi / 72
    here = axes.transData.transform(place)
    others = [axes.transData.transform(other) for other in names if other != place]
    for distance, direction in itertools.product(DISTANCES, DIRECTIONS):
        label = written(axes, names[place], place, distance, direction)
        box = label.get_window_extent().padded(CLEAR * scale)
        tied = distance > BESIDE
        least = (NEAR_TIED if tied else NEAR) * gap(box, here)
        leader = Path([here, nearest(box, here)])
        if (
            obstacles.leave_free(box)
            and all(gap(box, there) > least for there in others)
            and not (tied and obstacles.cross(leader))
        ):
            if tied:
                label.remove()
                label = written(axes, names[place], place, distance, direction, arrowprops=LEADER)
            obstacles.boxes.append(box)
            return label
        label.remove()
    return None


def obstacles_in(axes: Axes) -> Obstacles:
    """Lines and markers of axes."""
    radius = 2.5 * axes.figure.dpi / 72
    paths = [line.get_path().transformed(line.get_transform()) for line in axes.lines]
    dots = [
        vertex
        for line, path in zip(axes.lines, paths, strict=True)
        for vertex in path.vertices
        if line.get_marker() not in ("None", None, "")
    ]
    return Obstacles(
        lines=[path for path in paths if len(path.vertices) > 1],
        boxes=[Bbox.from_bounds(x, y, 0, 0).padded(radius) for x, y in dots],
        frame=axes.bbox,
    )


def written(
    axes: Axes, name: str, place: Place, distance: float, direction: float, **given
) -> Annotation:
    """A name at this distance from its place, growing away from it."""
    x, y = np.cos(direction), np.sin(direction)
    label = axes.annotate(
        name,
        place,
        xytext=(distance * x, distance * y),
        textcoords="offset points",
        ha="left" if x > 0.3 else "right" if x < -0.3 else "center",
        va="bottom" if y > 0.3 else "top" if y < -0.3 else "center",
        fontsize=7,
        zorder=6,
        **given,
    )
    label.set_in_layout(False)
    return label


def nearest(box: Bbox, point: np.ndarray) -> np.ndarray:
    """The point of a box that is nearest to another point."""
    return np.clip(point, box.min, box.max)


def gap(box: Bbox, point: np.ndarray) -> float:
    """Distance of a point from a box."""
    return float(np.hypot(*(nearest(box, point) - point)))

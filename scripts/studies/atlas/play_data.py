"""Data of the view in which a reader moves the parameters: class and path of points of the atlas.

The file is a script, because a page that is opened as a file may load no other data.
"""

import base64
import json
import math
from collections.abc import Iterable

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table
from scripts.models.models import PAPER
from scripts.models.records import is_of_block, law_of
from scripts.page.page_views import exponents, motion
from scripts.tables.motion_rows import (
    COLOURS,
    axes_of,
    is_computed,
    kind_of,
    nearest_alike,
    plane_of,
)

KINDS = list(COLOURS)
"""A kind of motion is stored as its place here."""
STEPS = 1000
"""Steps of time along a path. With `LEVELS` it is the resolution of the plot in pixels."""
LEVELS = 255
"""Levels of u and of ln v between the least and the largest value of a path, in one byte."""
LONGEST_GAP = 255
"""Most steps of time between two points, in one byte."""


def list_planes(points: Iterable[tuple[dict, np.ndarray | None, float]]) -> list[dict]:
    """Planes of the atlas in the order of the rows, each with the motions of its points.

    A point is its row, its path and the length of the path in time.
    """
    of_plane: dict[tuple, list] = {}
    for point in points:
        # the view moves epsilon and tau of the block
        if axes_of(point[0]) == ("epsilon", "tau") and is_of_block(point[0]):
            of_plane.setdefault(plane_of(point[0]), []).append(point)
    return list(map(describe_plane, of_plane.values()))


def describe_plane(points: list[tuple[dict, np.ndarray | None, float]]) -> dict:
    """Axes, kinds and paths of a plane: points along epsilon, from the least tau upwards."""
    points = sorted(points, key=lambda point: (point[0]["tau"], point[0]["epsilon"]))
    rows, paths, times = zip(*points, strict=True)
    columns, lines = (sorted({row[key] for row in rows}) for key in ("epsilon", "tau"))
    shape = len(lines), len(columns)
    kinds = [KINDS.index(kind_of(row)) for row in rows]
    alike = np.array(kinds) + len(KINDS) * np.array(list(map(period_of, rows)))
    computed = np.array(list(map(is_computed, rows)))
    across, along = nearest_alike(alike.reshape(shape), computed.reshape(shape))
    packed = [pack_path(i, path, times[i]) for i, path in enumerate(paths) if path is not None]
    return {
        "xi": rows[0]["xi"],
        "gamma": rows[0]["gamma"],
        "law": "" if law_of(rows[0]) == PAPER else law_of(rows[0]),
        "epsilon": columns,
        "tau": lines,
        "time": float(max(times)),
        "kinds": "".join(map(str, kinds)),
        "shown": (across * len(columns) + along).ravel().tolist(),
        "words": {
            i: [motion(row), exponents(row), frequencies(row)]
            for i, row in enumerate(rows)
            if is_computed(row)
        },
        "paths": base64.b64encode(b"".join(packed)).decode(),
    }


def period_of(row: dict) -> int:
    """Points of a cycle in the section, 0 for other motions."""
    return int(row["period"]) if row["class"] == "cycle" and row["period"] > 0 else 0


def frequencies(row: dict) -> str:
    """The period of a cycle, or the fundamental frequencies of a torus, if they are known."""
    if row["class"] == "cycle" and not math.isnan(row["f1"]):
        return f"period {1 / row['f1']:.4g} (units of L/v₀)"
    if row["class"] in ("torus", "3-torus") and not math.isnan(row["f2"]):
        keys = ["f1", "f2", "f3"] if row["class"] == "3-torus" else ["f1", "f2"]
        known = [f"{row[key]:.4g}" for key in keys]
        return f"fundamental frequencies {', '.join(known[:-1])} and {known[-1]} (units of v₀/L)"
    return ""


def paths_of(run: xr.Dataset) -> list[np.ndarray | None]:
    """The path of each point, shape (3, its length): time, u and ln v; None where there is none."""
    if "path_u" not in run:
        return [None] * run.sizes["point"]
    columns = np.array([run[key].values for key in ("path_time", "path_u", "path_ln_v")])
    paths = np.split(columns, np.cumsum(run.path_length.values)[:-1], axis=1)
    return [path if path.size else None for path in paths]


def pack_path(number: int, path: np.ndarray, time: float) -> bytes:
    """A path as bytes, the lowest first, for a path of this length in time.

    - number of the point and of points along the path, 4 bytes each;
    - least and largest u, least and largest ln v, real numbers of 4 bytes;
    - for each point along the path 3 bytes: steps of time from the point before, u and ln v.
    """
    steps = np.rint(path[0] / time * STEPS).astype(int)
    where = [0, *np.cumsum([max(1, -(-gap // LONGEST_GAP)) for gap in np.diff(steps)])]
    fine = np.arange(where[-1] + 1)
    steps = np.rint(np.interp(fine, where, steps)).astype(int)
    values = np.array([np.interp(fine, where, column) for column in path[1:]]).astype("<f4")
    least, largest = values.min(axis=1), values.max(axis=1)
    extent = np.where(largest > least, largest - least, 1)
    levels = np.rint((values - least[:, None]) / extent[:, None] * LEVELS)
    columns = np.array([np.diff(steps, prepend=0), *levels]).astype(np.uint8)
    head = np.array([number, fine.size], dtype="<u4").tobytes()
    ranges = np.array([least, largest]).T.astype("<f4").tobytes()
    return head + ranges + columns.T.tobytes()


def write_script(rows: list[dict], runs: list[xr.Dataset], scenes: dict[str, dict]) -> str:
    """The whole file: planes of the atlas, and the scenes on them by name."""
    of_runs = [(path, run.attrs.get("t_path", 0.0)) for run in runs for path in paths_of(run)]
    found = list_planes((row, *of_run) for row, of_run in zip(rows, of_runs, strict=True))
    places = {plane_of({**one, "law": one["law"] or PAPER}): i for i, one in enumerate(found)}
    on_planes = [
        {
            "name": name.replace("_", " "),
            "plane": places[at],
            **{key: scene[key] for key in ("epsilon", "tau")},
        }
        for name, scene in scenes.items()
        if (at := plane_of(scene)) in places
    ]
    data = {"steps": STEPS, "levels": LEVELS, "planes": found, "scenes": on_planes}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return f'"use strict";\nconst playData = {text};\n'


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        text = write_script(
            [row for path in snakemake.input.tables for row in read_table(path)],
            [read(path) for path in snakemake.input.runs],
            snakemake.params.scenes,
        )
        with written(snakemake.output[0]) as path:
            path.write_text(text)

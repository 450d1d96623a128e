"""Numbers in captions of figures over parameters: Hopf curves, the atlas, routes and cycles."""

from collections import Counter
from itertools import groupby
from string import ascii_lowercase

import numpy as np
import xarray as xr

from scripts.captions.wording import count, joined, short
from scripts.drawing.parameters import SYMBOLS
from scripts.drawing.special_points import in_words, words_of
from scripts.files.inputs import read
from scripts.files.tsv import read_table
from scripts.tables.cycle_branches import branch_of
from scripts.tables.fault_limit_table import FAULTS, PAPER
from scripts.tables.motion_rows import UNDECIDED, parameter_of, planes_of


def of_hopf_curves(given: dict, params: dict) -> dict:
    """Counts along the curves, and the scenes in the plane."""
    curves = read(given["curves"])
    ordinate = curves.attrs["ordinate"]
    boundary = curves.isel(point=curves.unstable_pairs.values == 0)
    kinds = Counter(words_of(curves.special_kind))
    return {
        "branches": np.unique(curves.branch).size,
        "points": curves.sizes["point"],
        "subcritical": int((curves.l1 > 0).sum()),
        "stabilising": int((curves.crossing < 0).sum()),
        "boundary": ends_of(boundary.epsilon),
        "ordinates": ends_of(boundary[ordinate]),
        "without_delay": [
            float(epsilon)
            for kind, epsilon in zip(
                words_of(curves.special_kind), curves.special_epsilon.values, strict=True
            )
            if kind == "hopf_without_delay"
        ],
        "generalised": kinds["generalised_hopf"],
        "double": kinds["double_hopf"],
        "inside": [name.replace("_", " ") for name in params["scenes"]],
    }


def ends_of(values: xr.DataArray) -> tuple[str, str]:
    """The least and the largest of values that may be none."""
    return (short(values.min()), short(values.max())) if values.size else ("none", "none")


def of_atlas(given: dict, _params: dict) -> dict:
    """Shares of the classes in each plane."""
    planes = []
    for number, ((gamma, xi), rows) in enumerate(planes_of(read_table(given["table"])).items()):
        met = Counter(row["class"] for row in rows)
        shares = [f"{kind} {short(100 * n / len(rows), 2)} %" for kind, n in met.most_common()]
        panels = ascii_lowercase[2 * number : 2 * number + 2]
        words = f":math:`\\xi` = {short(xi)} and :math:`\\gamma` = {short(gamma)}"
        planes.append({"panels": ", ".join(panels), "place": words, "shares": ", ".join(shares)})
    return {"planes": planes}


def of_fault_limit(given: dict, _params: dict) -> dict:
    """Rows at the paper's gamma and at the least one of real faults."""
    rows = {row["gamma"]: row for row in read_table(given["table"])}
    return {"paper": rows[PAPER], "fault": rows[FAULTS[0]]}


def of_routes(given: dict, _params: dict) -> dict:
    """Where each class first appears along each route, in the run that begins near sliding."""
    rows = [row for path in given["tables"] for row in read_table(path)]
    routes = []
    for letter, (_, of_route) in zip(
        ascii_lowercase, groupby(rows, lambda row: row["route"]), strict=False
    ):
        of_route = list(of_route)
        along = parameter_of(of_route)
        run = sorted(
            (row for row in of_route if row["run"] == of_route[0]["run"]),
            key=lambda row: row[along],
        )
        stretches = [
            (kind, [row[along] for row in stretch])
            for kind, stretch in groupby(run, key=lambda row: row["class"])
        ]
        first = {kind: places[0] for kind, places in reversed(stretches) if kind != UNDECIDED}
        words = [
            f"{kind} {place:g}" for kind, place in sorted(first.items(), key=lambda item: item[1])
        ]
        routes.append({"letter": letter, "symbol": SYMBOLS[along], "first": joined(words)})
    return {"routes": routes, "points": len(rows)}


def of_cycles(given: dict, _params: dict) -> dict:
    """Branches and special points, and where stable cycles are."""
    lines = []
    for letter, path in zip(ascii_lowercase, given["cycles"], strict=False):
        cycles = read(path)
        kinds = Counter(words_of(cycles.special_kind))
        along = cycles.attrs["along"]
        lines.append(
            {
                "letter": letter,
                "symbol": SYMBOLS[along],
                "branches": cycles.sizes["branches"],
                "points": [count(number, in_words(kind)) for kind, number in kinds.items()],
                "stable": stable_stretches(cycles, along),
            }
        )
    return {"lines": lines}


def stable_stretches(cycles: xr.Dataset, along: str) -> list[str]:
    """Intervals of the parameter with stable cycles, branch by branch."""
    found = set()
    for number in range(1, cycles.sizes["branches"] + 1):
        x, _, unstable = branch_of(cycles, number, along)
        for multipliers, parts in groupby(range(unstable.size), key=unstable.__getitem__):
            pieces = list(parts)
            if multipliers == 0:
                values = x[pieces[0] : pieces[-1] + 2]
                found.add((float(values.min()), float(values.max())))
    words = [(short(first), short(last)) for first, last in sorted(found)]
    return [first if first == last else f"{first} to {last}" for first, last in words]


NUMBERS = {
    "figure_2": of_hopf_curves,
    "figure_3": of_hopf_curves,
    "fault_limit": of_fault_limit,
    "atlas": of_atlas,
    "routes": of_routes,
    "cycles": of_cycles,
}

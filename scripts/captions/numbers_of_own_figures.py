"""Numbers in captions of figures of what the user's file adds."""

import math
from itertools import groupby

import numpy as np

from scripts.captions.numbers_of_motions import end_in_words, of_exponents, with_error
from scripts.captions.numbers_of_planes import of_atlas, of_cycles, of_hopf_curves
from scripts.captions.wording import as_formulas, count, joined, listed, short
from scripts.drawing import hopf_plane, parameters
from scripts.drawing.special_points import in_words, words_of
from scripts.drawing.spectrum_rows import lines_in_words
from scripts.drawing.trajectory_rows import MOST_MISSED, WORDS, share_missed
from scripts.figures.scene import end_shown, roots_in_words
from scripts.files.inputs import read
from scripts.files.tsv import read_table
from scripts.tables.attractor_tables import rows_of, same_attractor
from scripts.tables.motion_rows import UNDECIDED, has_problem, kind_of, parameter_of

MOST_STRETCHES = 12
"""Most stretches of one class that are listed along a route; of more, how often it is met."""


def place_of(given: dict, *left_out: str) -> str:
    """The parameters of a place, without some of them."""
    return as_formulas(parameters.in_words(given, *left_out))


def symbol_of(parameter: str) -> str:
    """The symbol of a parameter or of a value of the history."""
    return f":math:`{(parameters.SYMBOLS | parameters.OF_HISTORY)[parameter]}`"


def of_scene(given: dict, _params: dict) -> dict:
    """Class, end of v, exponents, spectrum and the roots of steady sliding."""
    names = ("trajectory", "spectrum", "attractors", "roots")
    trajectory, spectrum, attractors, roots = (read(given[name]) for name in names)
    row = rows_of(attractors)[0]
    last = float(trajectory.t[-1])
    v = trajectory.v.sel(t=slice(max(0.0, last - end_shown(spectrum, last)), None))
    numbers = range(1, attractors.sizes["exponent"] + 1)
    exponents = [with_error(row[f"exponent_{i}"], row[f"error_{i}"]) for i in numbers]
    missed = share_missed(trajectory)
    return {
        "place": place_of(trajectory.attrs),
        "met": motion_of(row),
        "end": end_in_words(v, row),
        "missed": short(100 * missed, 2) if missed > MOST_MISSED else "",
        "exponents": [value for value in exponents if value != "not measured"],
        "lines": as_formulas(lines_in_words(spectrum)),
        "roots": as_formulas(roots_in_words(roots)),
    }


def motion_of(row: dict) -> str:
    """The class of a motion, or why it has none."""
    if has_problem(row):
        return f"without a class ({row['problem']})"
    if row["class"] == UNDECIDED:
        return f"of no class that can be decided ({row['reason']})"
    if row["class"] == "chaos":
        return "chaotic"
    several = f" with {row['period']:g} points in its section"
    word = WORDS.get(row["class"], row["class"])
    return f"a {word}" + several * (kind_of(row) != row["class"])


def of_exponents_of_scene(given: dict, params: dict) -> dict:
    """The exponents of the scene that is drawn."""
    (scene,) = of_exponents(given, params)["scenes"]
    return scene


def of_plane(given: dict, params: dict) -> dict:
    """Counts along the Hopf curves, and where their special points are."""
    curves = read(given["curves"])
    ordinate = curves.attrs["ordinate"]
    kinds = np.array(words_of(curves.special_kind))
    special = []
    for kind, (_, name) in hopf_plane.MARKERS.items():
        at = curves.isel(special=kinds == kind)
        values = zip(at.special_epsilon.values, at[f"special_{ordinate}"].values, strict=True)
        places = [f"({short(epsilon)}, {short(other)})" for epsilon, other in sorted(values)]
        if places:
            special.append(f"{count(len(places), name)} at {listed(places)}")
    return {
        **of_hopf_curves(given, params),
        "place": place_of(curves.attrs, "epsilon", ordinate),
        "ordinate": symbol_of(ordinate),
        "stable": short(100 * float((curves.map_unstable_pairs == 0).mean()), 2),
        "special": special,
    }


def of_route(given: dict, _params: dict) -> dict:
    """Classes along the parameter, run by run, and where motions coexist."""
    (table,) = given["tables"]
    rows = read_table(table)
    along = parameter_of(rows)
    runs: dict[str, list[str]] = {}
    for run in dict.fromkeys(row["run"] for row in rows):
        of_run = sorted((r for r in rows if r["run"] == run), key=lambda row: row[along])
        runs.setdefault(sequence(of_run, along), []).append(run)
    places = [
        (place, list(there))
        for place, there in groupby(sorted(rows, key=lambda row: row[along]), lambda r: r[along])
    ]
    several = [short(place) for place, there in places if coexist(there)]
    return {
        "symbol": symbol_of(along),
        "place": place_of(rows[0], along),
        "runs": [
            {"names": f"run{'s' * (len(names) > 1)} {joined(names)}", "classes": words}
            for words, names in runs.items()
        ],
        "places": len(places),
        "several": several,
    }


def sequence(rows: list[dict], along: str) -> str:
    """The classes of a run as the parameter grows, with the values where each is met."""
    stretches = [
        (kind, [row[along] for row in stretch]) for kind, stretch in groupby(rows, key=kind_of)
    ]
    words = [
        f"{kind} at {short(at[0])}" + (f" to {short(at[-1])}" if len(at) > 1 else "")
        for kind, at in stretches
    ]
    if len(words) <= MOST_STRETCHES:
        return joined(words)
    places: dict[str, list[float]] = {}
    for kind, at in stretches:
        places.setdefault(kind, []).extend(at)
    counts = [f"{kind} at {len(at)} ({ends_of(at)})" for kind, at in places.items()]
    return f"among {len(rows)} values, {joined(counts)}, with {len(words) - 1} changes"


def ends_of(places: list[float]) -> str:
    """The first and the last of some ascending values."""
    first, last = short(places[0]), short(places[-1])
    return f"first {first}, last {last}" if len(places) > 1 else first


def coexist(rows: list[dict]) -> bool:
    """Whether runs at the same parameters reached different motions."""
    decided = [row for row in rows if row["class"] != UNDECIDED and not has_problem(row)]
    return any(not same_attractor(decided[0], row) for row in decided[1:])


def of_atlas_plane(given: dict, params: dict) -> dict:
    """Shares of the classes, and where the largest exponent is."""
    (plane,) = of_atlas(given, params)["planes"]
    rows = [row for row in read_table(given["table"]) if not math.isnan(row["exponent_1"])]
    most = max(rows, key=lambda row: row["exponent_1"], default=None)
    return {
        **plane,
        "largest": with_error(most["exponent_1"], most["error_1"]) if most else "",
        "there": place_of(most, "xi", "gamma") if most else "",
    }


def of_line(given: dict, params: dict) -> dict:
    """Branches of cycles, their stable stretches, and where their special points are."""
    (line,) = of_cycles(given, params)["lines"]
    (path,) = given["cycles"]
    cycles = read(path)
    along = cycles.attrs["along"]
    kinds = np.array(words_of(cycles.special_kind))
    places = {
        kind: np.sort(cycles[f"special_{along}"].values[kinds == kind])
        for kind in dict.fromkeys(kinds)
    }
    return {
        **line,
        "place": place_of(cycles.attrs, along),
        "hopf": listed([short(value, 4) for value in np.sort(cycles[f"hopf_{along}"].values)]),
        "special": [
            f"{count(len(at), in_words(kind))} at {listed([short(value, 4) for value in at])}"
            for kind, at in places.items()
        ],
    }


NUMBERS = {
    "own/scene": of_scene,
    "own/exponents": of_exponents_of_scene,
    "own/plane": of_plane,
    "own/route": of_route,
    "own/atlas": of_atlas_plane,
    "own/cycles": of_line,
}

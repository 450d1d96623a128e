"""Cycles followed at a scene's parameters, for claims about them."""

from collections.abc import Iterable

from scripts.claims.filters import fixed, torus_points
from scripts.files.inputs import Dataset
from scripts.studies.cycles.branches import CycleThere, cycles_there
from scripts.tables.attractor_tables import SAME_MAXIMUM


def lines_through(place: dict, lines: Iterable[Dataset]) -> list[Dataset]:
    """Cycles followed along lines that pass a place."""
    return [
        line
        for line in lines
        if fixed(place, line.attrs["along"]) == fixed(line.attrs, line.attrs["along"])
    ]


def cycles_at(place: dict, lines: Iterable[Dataset]) -> list[CycleThere]:
    """Cycles followed at a place, by their size; each once if lines cross there."""
    found: list[CycleThere] = []
    for line in lines_through(place, lines):
        for cycle in cycles_there(line, place[line.attrs["along"]]):
            if not any(abs(other.most / cycle.most - 1) < SAME_MAXIMUM for other in found):
                found.append(cycle)
    return sorted(found, key=lambda cycle: cycle.most)


def bifurcations_at(place: dict, lines: Iterable[Dataset], cycle_points: list[dict]) -> list[dict]:
    """What is fixed on lines through a place, and where stable cycles have torus bifurcations."""
    names = [line.attrs["along"] for line in lines_through(place, lines)]
    return [
        {"along": name, "fixed": fixed(place, name), "at": torus_points(place, name, cycle_points)}
        for name in names
    ]

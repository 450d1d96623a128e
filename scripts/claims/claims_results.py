"""What verdicts rest on: files in results/, and how a finding is put in words."""

import re
from dataclasses import dataclass
from pathlib import Path

import xarray as xr

from scripts.files.tsv import read_table

REPRODUCED = "reproduced"
CORRECTED = "reproduced with a correction"
NOT_REPRODUCED = "not reproduced"
NOT_TESTABLE = "not testable"
VERDICTS = [REPRODUCED, CORRECTED, NOT_REPRODUCED, NOT_TESTABLE]


@dataclass
class Finding:
    """What a test says of a claim, and the numbers it rests on, in a sentence."""

    verdict: str
    evidence: str
    instead: str = ""
    """What is true instead, in one sentence, where the claim does not hold as printed."""

    def __post_init__(self) -> None:
        if bool(self.instead) != (self.verdict in (CORRECTED, NOT_REPRODUCED)):
            raise ValueError(f"verdict '{self.verdict}' with this on what is true: {self.instead}")


@dataclass
class Results:
    """Contents of the files that verdicts rest on: rows of tables and data sets."""

    curves: dict[str, xr.Dataset]
    friction: xr.Dataset | None
    hopf_points: list[dict]
    fault_limit: list[dict]
    linear_stability: list[dict]
    stability: list[dict]
    attractors: list[dict]
    exponents: list[dict]
    atlas: list[dict]
    basins: list[dict]
    routes: list[dict]
    cycle_points: list[dict]
    cycles: dict[str, xr.Dataset]
    spectra: dict[str, xr.Dataset]
    slip_events: dict[str, xr.Dataset]

    def stability_of(self, scene: str) -> dict:
        """The scene's row of linear stability."""
        (row,) = rows_about(self.linear_stability, "linear-stability.tsv", scene)
        return row

    def spectrum_of(self, scene: str) -> xr.Dataset:
        """The spectrum of the scene's v."""
        return data_about(self.spectra, "results/spectra", scene)

    def events_of(self, scene: str) -> xr.Dataset:
        """The scene's slip events."""
        return data_about(self.slip_events, "results/slip_events", scene)

    def attractors_of(self, scene: str) -> list[dict]:
        """The scene's attractors, that of its own history first."""
        rows = rows_about(self.attractors, "attractors.tsv", scene)
        return sorted(rows, key=lambda row: row["history"])

    def exponents_of(self, scene: str) -> list[tuple[float, float]]:
        """The exponents of the scene's long run with their errors, largest first, if it has one."""
        rows = [row for row in self.exponents if row["scene"] == scene]
        # the other runs of a scene check tolerance and step size
        own = [row for row in rows if row["mean_step"] == rows[0]["mean_step"]]
        return [(row["exponent"], row["error"]) for row in own]

    def route(self, name: str) -> list[dict]:
        """Points of a route, of all runs; to have none is an error."""
        return rows_about(self.routes, f"routes/{name}.tsv", name, "route")


DATA_SETS = ("curves", "cycles", "spectra", "slip_events")
"""Data sets, one for each plane or scene."""


def read_results(files: dict[str, str | list[str]]) -> Results:
    """Read the files, one or several of each kind, by the names of `Results`."""
    data = {name: paths for name, paths in files.items() if name in DATA_SETS}
    tables = {name: paths for name, paths in files.items() if name not in (*DATA_SETS, "friction")}
    return Results(
        friction=xr.load_dataset(files["friction"]) if files["friction"] else None,
        **{
            name: {Path(path).stem: xr.load_dataset(path) for path in paths}
            for name, paths in data.items()
        },
        **{name: rows_in(paths) for name, paths in tables.items()},
    )


def rows_in(paths: str | list[str]) -> list[dict]:
    """Rows of one table, or of several one after the other."""
    if isinstance(paths, str):
        return read_table(paths)
    return [row for path in paths for row in read_table(path)]


def rows_about(rows: list[dict], table: str, name: str, kind: str = "scene") -> list[dict]:
    """Rows of a scene or a route; to have none is an error."""
    found = [row for row in rows if row[kind] == name]
    if not found:
        known = sorted({row[kind] for row in rows})
        raise ValueError(f"{table}: no row of {kind} '{name}'; there are: {', '.join(known)}")
    return found


def data_about(data: dict[str, xr.Dataset], folder: str, scene: str) -> xr.Dataset:
    """The file of a scene; to have none is an error."""
    if scene not in data:
        raise ValueError(f"{folder}: no file of scene '{scene}'; there are: {', '.join(data)}")
    return data[scene]


def changes(cell: str | float) -> list[tuple[float, int, int]]:
    """Places at which a pair crosses the axis, with the unstable pairs before and after."""
    found = re.findall(r"(\S+) \((\d+) -> (\d+)\)", cell if isinstance(cell, str) else "")
    return [(float(place), int(before), int(after)) for place, before, after in found]


def short(value: float, digits: int = 4) -> str:
    """A number for a sentence."""
    return f"{value:.{digits}g}"


def listed(words: list[str]) -> str:
    """Words joined by commas, or that there are none."""
    return ", ".join(words) if words else "none"


def decided(holds: bool, evidence: str, instead: str) -> Finding:
    """A claim that holds or does not."""
    return Finding(REPRODUCED, evidence) if holds else Finding(NOT_REPRODUCED, evidence, instead)


def decided_after_correction(
    printed: bool, corrected: bool, evidence: str, instead: str
) -> Finding:
    """A claim that may hold as printed, or only as corrected, or not at all."""
    if printed:
        return Finding(REPRODUCED, evidence)
    if corrected:
        return Finding(CORRECTED, evidence, instead)
    return Finding(NOT_REPRODUCED, evidence, "It does not hold after the known correction either.")

"""What verdicts rest on: files in results/, and how a finding is put in words."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from scripts.files.inputs import Dataset, read
from scripts.files.tsv import read_table
from scripts.namelists.laws import law_of
from scripts.plans import studies

REPRODUCED = "reproduced"
CORRECTED = "reproduced with a correction"
NOT_REPRODUCED = "not reproduced"
NOT_TESTABLE = "not testable"
VERDICTS = [REPRODUCED, CORRECTED, NOT_REPRODUCED, NOT_TESTABLE]
ANSWERS = {REPRODUCED: "yes", CORRECTED: "in part", NOT_REPRODUCED: "no"}
"""What a verdict is as the answer to a question of ours."""


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


def decided(holds: bool, evidence: str, instead: str, partly: bool = False) -> Finding:
    """A claim that holds as printed, or in part or after a correction, or not at all."""
    if holds:
        return Finding(REPRODUCED, evidence)
    return Finding(CORRECTED if partly else NOT_REPRODUCED, evidence, instead)


def decided_after_correction(
    printed: bool, corrected: bool, evidence: str, instead: str
) -> Finding:
    """A claim that may hold as printed, or only as corrected, or not at all."""
    neither = "It does not hold after the known correction either."
    return decided(printed, evidence, instead if corrected else neither, partly=corrected)


class Results:
    """Data of the studies by name: rows of tables, data sets by the names of their files.

    Data that are not given are empty.
    """

    def __init__(self, **given) -> None:
        known = studies.data()
        for name, maker in known.items():
            setattr(self, name, given.pop(name, {} if maker.output.endswith(".nc") else []))
        if given:
            raise ValueError(f"results: {', '.join(given)}; expected some of: {', '.join(known)}")

    def stability_of(self, scene: str) -> dict:
        """The scene's row of linear stability."""
        (row,) = rows_about(self.linear_stability, "linear-stability.tsv", "scene", scene)
        return row

    def attractors_of(self, scene: str) -> list[dict]:
        """The scene's attractors, that of its own history first."""
        rows = rows_about(self.attractors, "attractors.tsv", "scene", scene)
        return sorted(rows, key=lambda row: row["history"])

    def exponents_of(self, scene: str) -> list[tuple[float, float]]:
        """The exponents of the scene's long run with their errors, largest first, if it has one."""
        rows = [row for row in self.exponents if row["scene"] == scene]
        # the other runs of a scene check tolerance and step size
        own = [row for row in rows if row["mean_step"] == rows[0]["mean_step"]]
        return [(row["exponent"], row["error"]) for row in own]

    def spectrum_of(self, scene: str) -> Dataset:
        """The spectrum of the scene's v; to have none is an error."""
        return _data_about(self.spectra, "results/spectra", scene)

    def events_of(self, scene: str) -> Dataset:
        """The scene's slip events; to have none is an error."""
        return _data_about(self.slip_events, "results/slip_events", scene)

    def route(self, name: str) -> list[dict]:
        """Points of a route, of all runs; to have none is an error."""
        return rows_about(self.routes, f"routes/{name}.tsv", "route", name)


def read_results(files: Mapping[str, str | list[str]], law: str | None = None) -> Results:
    """Read the files, one or several of each kind, by the names of the data.

    Of a law alone if it is given: claims about it do not take results of another one.
    """
    given = {}
    for name, listed in files.items():
        paths = [listed] if isinstance(listed, str) else listed
        maker = studies.data()[name]
        if maker.output.endswith(".tsv"):
            rows = [row for path in paths for row in read_table(path)]
            one_law = None if maker.of_all_laws else law
            given[name] = [row for row in rows if one_law in (None, law_of(row))]
        else:
            data = {Path(path).stem: read(path) for path in paths}
            given[name] = {
                key: one for key, one in data.items() if law in (None, law_of(one.attrs))
            }
    return Results(**given)


def rows_about(rows: list[dict], table: str, kind: str, name: str) -> list[dict]:
    """Rows of a scene or a route; to have none is an error."""
    found = [row for row in rows if row[kind] == name]
    if not found:
        known = sorted({row[kind] for row in rows})
        raise ValueError(f"{table}: no row of {kind} '{name}'; there are: {', '.join(known)}")
    return found


def _data_about(data: dict[str, Dataset], folder: str, scene: str) -> Dataset:
    """The file of a scene; to have none is an error."""
    if scene not in data:
        raise ValueError(f"{folder}: no file of scene '{scene}'; there are: {', '.join(data)}")
    return data[scene]


def changes(cell: str | float) -> list[tuple[float, int, int]]:
    """Places at which a pair crosses the axis, with the unstable roots before and after."""
    if str(cell).startswith("not computed"):
        raise ValueError(f"linear-stability.tsv: changes of stability {cell}")
    found = re.findall(r"(\S+) \((\d+) -> (\d+)\)", cell if isinstance(cell, str) else "")
    return [(float(place), int(before), int(after)) for place, before, after in found]


def short(value: float, digits: int = 4) -> str:
    """A number for a sentence."""
    return f"{value:.{digits}g}"


def equations(values: Mapping[str, float], names: Iterable[str]) -> str:
    """Values of variables in a sentence."""
    known = {name: values.get(name, math.nan) for name in names}
    return ", ".join(f"${key} = {short(one)}$" for key, one in known.items() if not math.isnan(one))


def join(words: list[str]) -> str:
    """Words joined by commas, or that there are none."""
    return ", ".join(words) if words else "none"

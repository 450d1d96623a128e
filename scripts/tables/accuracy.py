"""Measured runs beside their references, and the norm in which they differ."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scripts.files.inputs import read
from scripts.files.tsv import read_table, rows_by
from scripts.models.records import law_of

BEFORE, BEHIND = "time", "uncertainty"
"""Columns of a reference beside those of the state."""
ENDS = ("least", "most")
WORDS = ["case", "method", "status", "reason", "model"]


@dataclass(kw_only=True)
class Reference:
    """A case in quadruple precision, by sample."""

    status: str
    time: np.ndarray
    state: np.ndarray
    uncertainty: np.ndarray
    amplification: np.ndarray


def read_references(paths: list[str] | list[Path]) -> dict[str, Reference]:
    """References of several files by case."""
    by_case = rows_by((row for path in paths for row in read_table(path)), "case")
    return {
        case: Reference(
            status=rows[0]["status"],
            time=np.array([row["time"] for row in rows]),
            state=np.array([[row[name] for row in rows] for name in states_of(rows[0])]),
            uncertainty=np.array([row["uncertainty"] for row in rows]),
            amplification=np.array([row["amplification"] for row in rows]),
        )
        for case, rows in by_case.items()
    }


def states_of(row: dict) -> list[str]:
    """Names of the states in a row of a reference."""
    names = list(row)
    return names[names.index(BEFORE) + 1 : names.index(BEHIND)]


def read_runs(path: str | Path) -> list[dict]:
    """Runs of a file: words, numbers, samples as `time` and `state`, shape (states, samples)."""
    data = read(path)
    states = [name for name in data.data_vars if data[name].dims == data.time.dims]
    numbers = [name for name, values in data.variables.items() if values.dims == ("run",)]
    runs = []
    for i in range(data.sizes["run"]):
        row = data.isel(run=i)
        reached = np.isfinite(row.time.values)
        runs.append(
            {name: str(row[name].values) for name in WORDS}
            | {name: float(row[name]) for name in numbers if name not in WORDS}
            | {"time": row.time.values[reached]}
            | {"state": np.array([row[name].values[reached] for name in states])}
        )
    for run in runs:
        run["law"] = law_of({**data.attrs, **run})
        run["least"], run["most"] = (run[f"{end}_{data.attrs['signal']}"] for end in ENDS)
    return runs


def read_runs_with_references(
    measurements: list[str], references: list[str]
) -> list[tuple[dict, Reference]]:
    """Runs of several files, each with the reference of its case."""
    by_case = read_references(references)
    return [(run, by_case[run["case"]]) for path in measurements for run in read_runs(path)]


def distances(state: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Largest error of a state at each sample, relative to the state where above 1."""
    return np.max(np.abs(state - reference) / np.maximum(1.0, np.abs(reference)), axis=0)


def errors_of(run: dict, reference: Reference) -> np.ndarray:
    """Error at each sample of a run; NaN at samples that the run or its reference did not reach."""
    samples = run["time"].size
    if not np.array_equal(run["time"], reference.time[:samples]):
        raise ValueError(f"case '{run['case']}': samples of run and reference at different times")
    return distances(run["state"], reference.state[:, :samples])


def largest(values: np.ndarray) -> float:
    """The largest finite value after the first sample, which is the history; NaN if none is."""
    values = values[1:][np.isfinite(values[1:])]
    return float(values.max()) if values.size else np.nan

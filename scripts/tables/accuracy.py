"""Measured runs beside their references, and the norm in which they differ."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scripts.files.inputs import read
from scripts.files.tsv import read_table

STATE = ["theta", "u", "ln_v"]
WORDS = ["case", "method", "status", "reason"]


@dataclass(kw_only=True)
class Reference:
    """A case in quadruple precision, by sample."""

    status: str
    time: np.ndarray
    state: np.ndarray
    uncertainty: np.ndarray
    amplification: np.ndarray


def read_references(path: str | Path) -> dict[str, Reference]:
    """References of a file by case."""
    by_case: dict[str, list[dict]] = {}
    for row in read_table(path):
        by_case.setdefault(row["case"], []).append(row)
    return {
        case: Reference(
            status=rows[0]["status"],
            time=np.array([row["time"] for row in rows]),
            state=np.array([[row[name] for row in rows] for name in STATE]),
            uncertainty=np.array([row["uncertainty"] for row in rows]),
            amplification=np.array([row["amplification"] for row in rows]),
        )
        for case, rows in by_case.items()
    }


def read_runs(path: str | Path) -> list[dict]:
    """Runs of a file: words, numbers, and samples as `time` and `state`."""
    data = read(path)
    runs = []
    for i in range(data.sizes["run"]):
        row = data.isel(run=i)
        run = {name: str(row[name].values) for name in WORDS}
        run |= {
            name: float(row[name])
            for name, values in data.variables.items()
            if values.dims == ("run",) and name not in WORDS
        }
        there = np.isfinite(row.time.values)
        run["time"] = row.time.values[there]
        run["state"] = np.array([row[name].values[there] for name in STATE])
        runs.append(run)
    return runs


def distances(state: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Largest error of theta, u, ln v at each sample, relative to the component where above 1."""
    return np.max(np.abs(state - reference) / np.maximum(1.0, np.abs(reference)), axis=0)


def errors_of(run: dict, reference: Reference) -> np.ndarray:
    """Error at each sample of a run; NaN where either did not come."""
    samples = run["time"].size
    if not np.array_equal(run["time"], reference.time[:samples]):
        raise ValueError(f"case '{run['case']}': samples of run and reference at different times")
    return distances(run["state"], reference.state[:, :samples])


def largest(values: np.ndarray) -> float:
    """The largest value after the first sample, at which nothing has happened; NaN if none."""
    values = values[1:][np.isfinite(values[1:])]
    return float(values.max()) if values.size else np.nan

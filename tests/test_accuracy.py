"""Errors of runs against references."""

import math

import numpy as np
import pytest

from scripts.files.tsv import read_table, write_table
from scripts.tables.accuracy import (
    Reference,
    distances,
    errors_of,
    largest,
)


@pytest.fixture
def reference() -> Reference:
    time = np.arange(5.0)
    uncertainty = np.full(5, 1e-17)
    return Reference(
        status="ok",
        time=time,
        state=np.zeros((3, 5)),
        uncertainty=uncertainty,
        amplification=10.0**time,
    )


def made_up_run(errors: list[float]) -> dict:
    state = np.zeros((3, len(errors)))
    state[1] = errors
    time = np.arange(float(len(errors)))
    return {"case": "made up", "setting": 1e-13, "t_end": 4.0, "time": time, "state": state}


def test_table_is_read_as_written(tmp_path):
    rows = [{"a": "word", "b": 1.5e-9, "c": math.nan}, {"a": "two words", "b": 3.0, "c": 0.0}]
    write_table(tmp_path / "table.tsv", rows)
    assert (tmp_path / "table.tsv").read_text() == "a\tb\tc\nword\t1.5e-09\t\ntwo words\t3\t0\n"
    read = read_table(tmp_path / "table.tsv")
    assert read[0]["b"] == 1.5e-9
    assert math.isnan(read[0]["c"])
    assert read[1] == {"a": "two words", "b": 3.0, "c": 0.0}


def test_errors_are_relative_above_one():
    """The largest over theta, u, ln v; the first sample of a run, its history, does not count."""
    state, known = np.array([[0.2], [50.0], [0.0]]), np.array([[0.1], [40.0], [0.0]])
    assert distances(state, known) == pytest.approx([0.25])
    assert largest(np.array([9.0, 1.0, np.nan, 2.0])) == 2.0
    assert math.isnan(largest(np.array([0.0, np.nan])))


def test_samples_at_other_times_are_refused(reference):
    """Two states at different times cannot be compared."""
    run = made_up_run([0.0, 0.0])
    run["time"] = np.array([0.0, 0.9])
    with pytest.raises(ValueError, match=r"case 'made up'.*different times"):
        errors_of(run, reference)

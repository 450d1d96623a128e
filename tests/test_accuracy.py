"""Errors of runs against references."""

import math

import numpy as np
import pytest

from scripts.files.tsv import read_table, write_table
from scripts.tables.accuracy import Reference, distances, errors_of, largest


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


def test_samples_at_other_times_are_refused():
    """Two states at different times cannot be compared."""
    state, time = np.zeros((3, 2)), np.arange(2.0)
    reference = Reference(status="ok", time=time, state=state, uncertainty=time, amplification=time)
    run = {"case": "made up", "setting": 1e-13, "t_end": 1.0, "time": 0.9 * time, "state": state}
    with pytest.raises(ValueError, match=r"case 'made up'.*different times"):
        errors_of(run, reference)

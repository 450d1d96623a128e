"""Exponents: the table of a run."""

from scripts.studies.exponents import table as exponents_table
from scripts.tables.exponent_signs import SIGNS


def test_rows_hold_the_values_of_their_run(programs, good_groups):
    made = programs.made_of("exponents", good_groups["exponents"])
    rows = exponents_table.rows_of(made)
    count = made.sizes["exponent"]
    assert len(rows) == made.value.size
    for n, row in enumerate(rows):
        at, i = made.isel(run=n // count), n % count
        assert (row["scene"], row["i"]) == ("torus", i + 1)
        assert (row["exponent"], row["error"]) == (at.value[i], at.error[i])
        assert row["sign"] == SIGNS[int(at.sign[i])]
        assert row["t"] == made.attrs["t_end"] - made.attrs["t_begin"]
        assert (row["tolerance"], row["mean_step"]) == (at.tolerance, at.mean_step)

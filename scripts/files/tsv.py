"""Tables as text with tabs between columns, or commas in .csv; a cell without a value is empty."""

import csv
import math
from collections.abc import Iterable
from pathlib import Path

from scripts.files.outputs import written


def write_table(path: str | Path, rows: list[dict], first: Iterable[str] = ()) -> None:
    """Write rows; the file appears only when complete.

    Columns are the first ones, then all other keys of the rows. What a row lacks is an empty cell.
    """
    with written(path) as unfinished, open(unfinished, "w", newline="") as file:
        columns = list(dict.fromkeys([*first, *(key for row in rows for key in row)]))
        delimiter = "," if Path(path).suffix == ".csv" else "\t"
        writer = csv.DictWriter(file, columns, delimiter=delimiter, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: as_text(value) for key, value in row.items()})


def as_text(value) -> str:
    """A cell: numbers with six digits, NaN as nothing."""
    if isinstance(value, float):
        if math.isnan(value):
            return ""
        return str(int(value)) if value.is_integer() and abs(value) < 1e6 else f"{value:.6g}"
    return str(value)


def as_digits(value, digits: int = 15, *, zero: float = 1e-12) -> str:
    """A number with a number of digits; NaN is nothing, and up to `zero` in modulus it is 0."""
    value = float(value)
    if math.isnan(value):
        return ""
    return f"{value:.{digits}g}" if abs(value) > zero else "0"


def read_table(path: str | Path) -> list[dict]:
    """Rows of a table with numbers as float, NaN where a cell is empty; # begins a comment line."""
    with open(path, newline="") as file:
        lines = (line for line in file if not line.startswith("#"))
        return [
            {key: as_value(text) for key, text in row.items()}
            for row in csv.DictReader(lines, delimiter="\t")
        ]


def as_value(text: str) -> float | str:
    """A number, NaN for nothing, or the text."""
    if text == "":
        return math.nan
    try:
        return float(text)
    except ValueError:
        return text


def rows_by(rows: Iterable[dict], *keys: str) -> dict:
    """Rows by their value of a column, or by those of several, in the order of the first rows."""
    found: dict = {}
    for row in rows:
        place = tuple(row[key] for key in keys)
        found.setdefault(place if len(keys) > 1 else place[0], []).append(row)
    return found

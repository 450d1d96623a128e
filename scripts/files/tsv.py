"""Tables as text with tabs between columns: empty where there is no value."""

import csv
import math
from pathlib import Path

from scripts.files.outputs import written


def write_table(path: str | Path, rows: list[dict], columns: list[str] | None = None) -> None:
    """Write rows that all have the same keys; the file is whole or absent."""
    with written(path) as unfinished, open(unfinished, "w", newline="") as file:
        writer = csv.DictWriter(file, columns or list(rows[0]), delimiter="\t", lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: as_text(value) for key, value in row.items()})


def as_text(value) -> str:
    """Numbers with the digits that matter; no number is empty."""
    if isinstance(value, float):
        if math.isnan(value):
            return ""
        return str(int(value)) if value == int(value) and abs(value) < 1e6 else f"{value:.6g}"
    return str(value)


def read_table(path: str | Path) -> list[dict]:
    """Rows of a table, numbers as numbers and NaN where a cell is empty.

    Lines above it that begin with # are left out.
    """
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

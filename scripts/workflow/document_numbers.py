"""Numbers in the documents, taken from results: no one types them.

A number has its source behind it, a comment that a reader of the page does not see:

    26<!-- claims; whose = the paper; verdict = reproduced; count -->
    0.0184<!-- exponents; scene = chaos; index = 1; exponent .3g -->

These are the table, conditions on columns (`gamma = 0.8`, `gamma from 1e4`), and what is taken:
`count`, a column of the one row, or `least` or `largest` of a column; then a format.
`docs/numbers.json` keeps what the results said.

    python -m scripts.workflow.document_numbers [results/run-times.tsv]

takes them from the results of a finished run; with a file of times also docs/measured-times.tsv.
"""

import json
import re
import shutil
import sys
from pathlib import Path

from scripts.files.tsv import as_text, read_table

PROJECT = Path(__file__).parents[2]
RECORD = PROJECT / "docs" / "numbers.json"
MEASURED = PROJECT / "docs" / "measured-times.tsv"
"""Times of a whole run of `./reproduce` from a fresh clone, its set-up included."""
FOLDERS = [PROJECT / folder for folder in ("results/tables", "docs", "benchmarks")]
RELATIONS = {
    "=": lambda cell, value: as_text(cell) == value,
    "from": lambda cell, value: cell >= float(value),
}
MARK = re.compile(r"(?P<number>[\w.+%-]+)(?P<mark><!-- (?P<source>[^;>]+;[^>]+) -->)")


def documents() -> list[Path]:
    """README and the pages in docs/."""
    return [PROJECT / "README.md", *sorted((PROJECT / "docs").glob("*.md"))]


def sources_in(text: str) -> list[str]:
    """Sources of the numbers of a document."""
    return [" ".join(found["source"].split()) for found in MARK.finditer(text)]


def fill(text: str, numbers: dict[str, str]) -> str:
    """A document with the numbers of its sources."""
    return MARK.sub(lambda found: numbers[" ".join(found["source"].split())] + found["mark"], text)


def look_up(source: str) -> str:
    """The number of a source, from its table.

    Raises ValueError if a condition leaves no row, or several where one is meant.
    """
    table, *conditions, taken = (part.strip() for part in source.split(";"))
    path = next(p for folder in FOLDERS if (p := folder / f"{table}.tsv").exists())
    rows = read_table(path)
    for condition in conditions:
        column, relation, value = condition.split(maxsplit=2)
        rows = [row for row in rows if RELATIONS[relation](row[column], value)]
    if taken == "count":
        return str(len(rows))
    *choice, column, form = taken.split()
    if not rows or (len(rows) > 1 and not choice):
        raise ValueError(f"{source}: {len(rows)} rows of {path.name}; expected one")
    pick = {"least": min, "largest": max}[choice[0] if choice else "least"]
    return format(pick(row[column] for row in rows), form)


if __name__ == "__main__":
    if sys.argv[1:]:
        shutil.copy(sys.argv[1], MEASURED)
    sources = dict.fromkeys(s for page in documents() for s in sources_in(page.read_text()))
    numbers = {source: look_up(source) for source in sources}
    RECORD.write_text(json.dumps(numbers, indent=1) + "\n")
    for page in documents():
        page.write_text(fill(page.read_text(), numbers))

"""Figure of work against precision: one panel a scene, one line a solver."""

import re
from pathlib import Path

OTHERS = "benchmarks/measured.tsv"


def inputs(_config: dict) -> dict:
    """Errors and run times of all methods, and of other solvers, which were measured before."""
    return {"table": "<results>/tables/work-precision.tsv", "others": OTHERS}


def params(_config: dict) -> dict:
    """The date on which other solvers were measured, from the first lines of their table."""
    measured = Path(__file__).parents[2] / OTHERS
    return {"date": re.search(r"^# date: (\S+)$", measured.read_text(), re.MULTILINE)[1]}

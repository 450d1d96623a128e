"""Numbers in captions of the solver's own figures."""

from collections import Counter

from scripts.captions.wording import count, short
from scripts.figures.work_precision import AUTO_AGAIN, date_of
from scripts.files.tsv import read_table

FACTOR = 100
"""An error up to this multiple of what is expected is within it, as the ledger has it."""
LEVEL = 1e-6
"""Of the error at which run times are compared."""


def of_stability(given: dict, _params: dict) -> dict:
    """Runs that are completed by each method, and errors that are within what is expected."""
    table = read_table(given["table"])
    methods = []
    for method in dict.fromkeys(row["method"] for row in table):
        rows = [row for row in table if row["method"] == method]
        ended = [row for row in rows if row["status"] == "ok"]
        measured = [row for row in ended if row["error"] >= 0 and row["error_expected"] > 0]
        methods.append(
            {
                "name": method,
                "runs": len(rows),
                "completed": len(ended),
                "measured": len(measured),
                "within": sum(row["error"] <= FACTOR * row["error_expected"] for row in measured),
            }
        )
    tolerances = sorted({row["tolerance"] for row in table})
    return {"methods": methods, "tolerance": ", ".join(map(short, tolerances))}


def of_work_precision(given: dict, _params: dict) -> dict:
    """The fastest solver of each scene at one level of the error, and how much others need."""
    table = read_table(given["table"])
    others = [row for row in read_table(given["others"]) if row["solver"] != AUTO_AGAIN]
    fastest, ratios = Counter(), []
    for scene, until in {row["scene"]: row["t_end"] for row in table}.items():
        ours, theirs = (
            [
                (row["seconds"], row["solver"])
                for row in rows
                if (row["scene"], row["t_end"]) == (scene, until)
                and row["error_max"] <= LEVEL
                and row["seconds"] > 0
            ]
            for rows in (table, others)
        )
        if ours:
            fastest[min(ours)[1]] += 1
        if ours and theirs:
            ratios.append(min(theirs)[0] / min(ours)[0])
    # methods with fixed steps have these in the place of a tolerance
    tolerances = [row["tolerance"] for row in table if not row["solver"].startswith("rk4")]
    return {
        "loosest": short(max(tolerances)),
        "tightest": short(min(tolerances)),
        "level": short(LEVEL),
        "fastest": [
            f"{solver} (in {count(number, 'scene')})" for solver, number in fastest.most_common()
        ],
        "ratios": [short(f(ratios), 2) for f in (min, max)] if ratios else [],
        "date": date_of(given["others"]),
    }


NUMBERS = {"stability": of_stability, "work_precision": of_work_precision}

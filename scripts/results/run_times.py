"""How long a run took: written by the run, and said in README by the same numbers.

    python -m scripts.results.run_times results/run-times.tsv

takes the file of a whole run for docs/measured-times.tsv and puts its sentence into README.md.
"""

import re
import resource
import shutil
import sys
import time
from pathlib import Path

import psutil

from scripts.files.tsv import read_table, write_table

TIMES, FIRST_PAGE = "run-times.tsv", "figures.html"
PROJECT = Path(__file__).parents[2]
MEASURED = PROJECT / "docs" / "measured-times.tsv"
"""Times of a whole run of `./reproduce` from a fresh clone, its set-up included."""


def record_times(folder: str | Path) -> None:
    """Write the times of the run that ends now, with the CPU time of all its jobs."""
    began = psutil.Process().create_time()
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    page = Path(folder, FIRST_PAGE)
    drawn = page.stat().st_mtime - began if page.exists() else float("nan")
    row = {
        "seconds": round(time.time() - began, 1),
        "seconds_to_figures": round(drawn, 1) if drawn > 0 else float("nan"),
        "cpu_seconds": round(sum(each.ru_utime + each.ru_stime for each in used), 1),
        "cores": psutil.cpu_count(),
    }
    write_table(Path(folder, TIMES), [row])


def sentence_of(path: Path) -> str:
    """What README says of these times."""
    (row,) = read_table(path)
    return (
        f"On {row['cores']:.0f} cores, the set-up included, Figures 1 to 8 were there after"
        f" {row['seconds_to_figures']:.0f} s, and everything\nafter"
        f" {row['seconds']:.0f} s ({row['cpu_seconds']:.0f} s of CPU time;"
        " `docs/measured-times.tsv`)."
    )


def put_sentence(text: str) -> str:
    """README with the sentence of the measured times between its marks."""
    marks = r"(?<=<!-- measured times -->\n).*?(?=\n<!-- end -->)"
    return re.sub(marks, lambda _: sentence_of(MEASURED), text, flags=re.DOTALL)


if __name__ == "__main__":
    shutil.copy(sys.argv[1], MEASURED)
    readme = PROJECT / "README.md"
    readme.write_text(put_sentence(readme.read_text()))

"""How long a run took, written by the run at its end."""

import resource
import time
from pathlib import Path

import psutil

from scripts.files.tsv import write_table

TIMES, FIRST_PAGE = "run-times.tsv", "figures.html"


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

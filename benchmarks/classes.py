"""Classes of motion at several tolerances: from which one on they stay the same, and their cost."""

import argparse
import copy
import os
import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import xarray as xr
from compare import machine, write_table
from scenes import ROOT
from workers import BUILD

from scripts.config.check_config import checked
from scripts.config.read_config import read
from scripts.namelists.attractor_surveys import atlas_groups
from scripts.namelists.write_namelist import write_namelist

PLANE = "xi_05"
POINTS = {"epsilon_count": 18, "tau_count": 16, "parts": 1, "refinements": 0}
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
"""The last one is what the others are compared with."""
LEAST_MAXIMUM = 0.01
"""Maxima of v in motion are larger than this; smaller ones are spurious."""
COLUMNS = ("tolerance", "seconds_per_point", "undecided", "other_class", "spurious_maxima")


def classified(tolerance: float, folder: Path) -> tuple[float, xr.Dataset]:
    """CPU seconds, and the attractors of the points."""
    config = copy.deepcopy(checked(read(ROOT / "config" / "config.yaml")))
    config["atlas"] |= POINTS
    config["atlas"]["observation"]["tolerance"] = tolerance
    namelist, output = folder / f"{tolerance}.nml", folder / f"{tolerance}.nc"
    write_namelist(namelist, atlas_groups(config, PLANE, 1))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(
        [BUILD / "bin" / "attractors", namelist, output],
        capture_output=True,
        text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    if run.returncode != 0:
        raise SystemExit(f"benchmarks: {run.stderr.strip()}")
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    with xr.open_dataset(output) as found:
        return seconds, found.load()


def row_of(tolerance: float, seconds: float, found: xr.Dataset, best: xr.Dataset) -> dict:
    """A line of the table: how the classes compare with the best ones."""
    names = found["class"].attrs["flag_meanings"].split()
    undecided, rest = names.index("undecided"), names.index("fixed_point")
    known = (found["class"] != undecided) & (best["class"] != undecided)
    moving = found["class"] != rest
    return {
        "tolerance": tolerance,
        "seconds_per_point": seconds / found["class"].size,
        "undecided": int(np.sum(found["class"] == undecided)),
        "other_class": int(np.sum(known & (found["class"] != best["class"]))),
        "spurious_maxima": int(np.sum(moving & (found["smallest_maximum"] < LEAST_MAXIMUM))),
    }


def main() -> None:
    """Measure and write the table."""
    parser = argparse.ArgumentParser(prog="benchmarks/run classes", allow_abbrev=False)
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "tables")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runs = {tolerance: classified(tolerance, Path(folder)) for tolerance in TOLERANCES}
    _, best = runs[TOLERANCES[-1]]
    rows = [row_of(tolerance, *run, best) for tolerance, run in runs.items()]
    points = best["class"].size
    meaning = f"points: {points}; other_class: unlike at {TOLERANCES[-1]}, where both are known"
    write_table(
        options.output / "classes-by-tolerance.tsv", list(COLUMNS), rows, [*machine()[:2], meaning]
    )


if __name__ == "__main__":
    main()

"""Error and time of this project's solver and of others on the same scenes (benchmarks/run)."""

import argparse
import csv
import datetime
import math
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from long_runs import COLUMNS as LONG_RUN_COLUMNS
from long_runs import rows_of_long_runs
from ratios import ratio_rows
from scenes import (
    HORIZONS,
    ROOT,
    Scene,
    error_max,
    read_horizons,
    read_study,
    reference_of,
    reference_path,
    scene_of,
)
from workers import SOLVERS, SolverError, TimeLimitError, Worker

from scripts.tables.accuracy import Reference

OURS = "ours"
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 14))
BATCH_SECONDS = 0.1
"""A measurement repeats short integrations for about this time."""
LONG_SECONDS = 5.0
"""An integration longer than this is measured once."""
LONG_RUN_SCENE = "torus"
COLUMNS = (
    "scene",
    "solver",
    "version",
    "tolerance",
    "t_end",
    "status",
    "error_max",
    "seconds",
)


def names_of(known: tuple[str, ...]):
    """A reader of names with commas between, each known."""

    def read(text: str) -> list[str]:
        names = text.split(",")
        for name in names:
            if name not in known:
                raise argparse.ArgumentTypeError(f"{name!r}; expected some of {', '.join(known)}")
        return [name for name in known if name in names]

    return read


def positive(text: str) -> float:
    """A finite number > 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (value > 0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text!r}; expected a finite number > 0")
    return value


def whole(text: str) -> int:
    """A whole number >= 1."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r}; expected a whole number >= 1")
    return int(text)


def arguments(given: list[str], known_scenes: tuple[str, ...]) -> argparse.Namespace:
    """The options of benchmarks/run."""
    known_solvers = tuple(SOLVERS)
    parser = argparse.ArgumentParser(prog="benchmarks/run", allow_abbrev=False)
    parser.add_argument("--scenes", type=names_of(known_scenes), default=list(known_scenes))
    parser.add_argument("--solvers", type=names_of(known_solvers), default=list(known_solvers))
    parser.add_argument("--time-limit", type=positive, default=60.0)
    parser.add_argument("--repeats", type=whole, default=5)
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "tables")
    return parser.parse_args(given)


def error_of(worker: Worker, tolerance: float, reference: Reference, limit: float) -> float:
    """Largest error of one run over the samples."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "samples.tsv"
        worker.sample(tolerance, path, limit)
        error = error_max(np.loadtxt(path, ndmin=2), worker.scene, reference)
    if not math.isfinite(error):
        raise SolverError("the result is not a number, and no error was reported")
    return error


def errors(worker: Worker, reference: Reference, limit: float) -> list[dict]:
    """A row for each tolerance, with its error or why there is none.

    After a run that took too long no tighter tolerance is tried.
    """
    rows, too_long = [], None
    for tolerance in TOLERANCES:
        row = {"tolerance": tolerance, "status": "ok", "error_max": None}
        if too_long:
            row["status"] = f"not tried: {too_long:g} took too long"
        else:
            try:
                row["error_max"] = error_of(worker, tolerance, reference, limit)
            except SolverError as failure:
                row["status"] = str(failure)
                if isinstance(failure, TimeLimitError):
                    too_long = tolerance
        rows.append(row)
    return rows


def measure(rows: list[dict], workers: dict[str, Worker], repeats: int, limit: float) -> None:
    """Add the seconds to the rows of one scene: solvers take turns, the median counts."""
    measured = {index: [] for index, row in enumerate(rows) if row["status"] == "ok"}
    runs = {}
    for repeat in range(repeats + 1):
        for index, seconds in measured.items():
            row = rows[index]
            if row["status"] != "ok" or runs.get(index) == 0:
                continue
            try:
                found = workers[row["solver"]].seconds(
                    row["tolerance"], runs.get(index, 1), limit + BATCH_SECONDS
                )
            except SolverError as failure:
                row["status"], row["error_max"] = str(failure), None
                continue
            if repeat == 0:
                runs[index] = runs_of(found)
            if repeat > 0 or runs[index] == 0:
                seconds.append(found)
    for index, seconds in measured.items():
        if rows[index]["status"] == "ok":
            rows[index]["seconds"] = statistics.median(seconds)


def runs_of(seconds: float) -> int:
    """How many integrations make one measurement; none where the first one is enough."""
    if seconds > LONG_SECONDS:
        return 0
    return max(1, math.ceil(BATCH_SECONDS / max(seconds, 1e-3)))


def rows_of_scene(scene: Scene, options: argparse.Namespace) -> list[dict]:
    """All solvers and tolerances on one scene."""
    reference = reference_of(scene)
    workers = {name: Worker(SOLVERS[name], scene) for name in options.solvers}
    rows = []
    try:
        for name, worker in workers.items():
            print(f"benchmarks: {scene.name}: errors of {name}", file=sys.stderr)
            for row in errors(worker, reference, options.time_limit):
                rows.append({"scene": scene.name, "solver": name, **row})
        print(f"benchmarks: {scene.name}: times", file=sys.stderr)
        rows.sort(key=lambda row: -row["tolerance"])
        measure(rows, workers, options.repeats, options.time_limit)
        for row in rows:
            row["version"] = workers[row["solver"]].version
            row["t_end"] = scene.t_end
    finally:
        for worker in workers.values():
            worker.stop()
    return sorted(rows, key=lambda row: list(SOLVERS).index(row["solver"]))


def text_of(value) -> str:
    """A cell: numbers with four digits, nothing for nothing."""
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else " ".join(str(value).split())


def write_table(path: Path, columns: list[str], rows: list[dict], header: list[str]) -> None:
    """Tab-separated, below lines of header that begin with #."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        file.writelines(f"# {line}\n" for line in header)
        writer = csv.writer(file, delimiter="\t", lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([text_of(row.get(column)) for column in columns] for row in rows)


def machine() -> list[str]:
    """What the measurements were made on and with."""
    cpu = "unknown"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            cpu = line.partition(":")[2].strip()
            break
    return [
        f"date: {datetime.date.today()}",
        f"machine: {cpu}, {platform.system()} {platform.release()}",
        f"compilers: {first_line('gfortran', '--version')}; {first_line('gcc', '--version')}",
        f"{first_line('R', '--version')}; Python {platform.python_version()}",
        "seconds: CPU time of the solver alone, median of repeats in one process",
        "error_max: largest error of theta, u, ln v over the samples, relative where above 1",
    ]


def first_line(*command: str) -> str:
    """The first line that a command says."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0]


def printed(rows: list[dict], solvers: list[str]) -> str:
    """The table of ratios for people."""
    lines = [f"{'scene':<12} {'error':>7} {'our ms':>8}" + "".join(f" {s:>19}" for s in solvers)]
    for row in rows:
        ours = "" if row["our_seconds"] is None else f"{1000 * row['our_seconds']:.3g}"
        line = f"{row['scene']:<12} {row['error']:>7.0e} {ours:>8}"
        for solver in solvers:
            line += " " + ("" if row[solver] is None else f"{row[solver]:.3g}").rjust(19)
        lines.append(line)
    return "\n".join(lines)


def compute_references(names: tuple[str, ...]) -> None:
    """Let the project's workflow make the references of the scenes and the table of horizons."""
    files = [path.relative_to(ROOT) for path in (HORIZONS, *map(reference_path, names))]
    subprocess.run([ROOT / "reproduce", *files, "--quiet", "all"], stdout=sys.stderr, check=True)


def main(given: list[str]) -> None:
    """Measure, write the tables, print the ratios."""
    study = read_study()
    names = tuple(study["cases"])
    options = arguments(given, names)
    try:
        compute_references(names)
        horizons = read_horizons()
        rows = [
            row
            for name in options.scenes
            for row in rows_of_scene(scene_of(study, horizons, name), options)
        ]
        long_runs = rows_of_long_runs(scene_of(study, horizons, LONG_RUN_SCENE))
    except (subprocess.CalledProcessError, SolverError) as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    header = machine()
    write_table(options.output / "benchmarks.tsv", list(COLUMNS), rows, header)
    others = [name for name in options.solvers if name != OURS]
    ratios = ratio_rows(rows, OURS, others)
    meaning = "columns of solvers: their time over ours, at equal error; empty where not reached"
    columns = ["scene", "error", "our_seconds", *others]
    write_table(options.output / "benchmark-ratios.tsv", columns, ratios, [*header, meaning])
    write_table(options.output / "long-runs.tsv", list(LONG_RUN_COLUMNS), long_runs, header[:3])
    print(printed(ratios, others))


if __name__ == "__main__":
    main(sys.argv[1:])

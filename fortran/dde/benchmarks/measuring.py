# SPDX-License-Identifier: BSD-3-Clause
"""What all benchmarks share: CPU seconds of a command, and tables."""

import argparse
import csv
import datetime
import os
import platform
import resource
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILD = HERE / "build"


def options_of(command: str, output: Path = BUILD) -> argparse.ArgumentParser:
    """The options of a benchmark, whose tables go to a folder."""
    parser = argparse.ArgumentParser(prog=command, allow_abbrev=False)
    parser.add_argument("--output", type=Path, default=output)
    return parser


def add_limits(parser: argparse.ArgumentParser, time_limit: float = 60.0) -> None:
    """Options of what integrates again and again."""
    parser.add_argument("--time-limit", type=float, default=time_limit)
    parser.add_argument("--repeats", type=int, default=5)


def measure_command(command: list, request: str = "") -> tuple[float, str]:
    """CPU seconds of a command on one core, and its output; SystemExit if it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    # without the packages of those who call this, which stand in PYTHONPATH
    environment = {key: word for key, word in os.environ.items() if key != "PYTHONPATH"}
    run = subprocess.run(
        [str(word) for word in command],
        input=request,
        capture_output=True,
        text=True,
        env={**environment, "OMP_NUM_THREADS": "1"},
    )
    if run.returncode != 0:
        raise SystemExit(f"benchmarks: {command[0]}: {run.stderr.strip()}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, run.stdout


def describe_machine() -> list[str]:
    """Date, machine and compilers of a measurement, a line each."""
    models = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    return [
        f"date: {datetime.date.today()}",
        f"machine: {models[0] if models else 'unknown'}, {platform.system()} {platform.release()}",
        f"compilers: {first_line('gfortran', '--version')}; {first_line('gcc', '--version')}",
    ]


def first_line(*command: str) -> str:
    """The first line of a command's output, if there is the command."""
    if not shutil.which(command[0]):
        return f"no {command[0]}"
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0]


def write_table(path: Path, rows: list[dict], header: list[str]) -> None:
    """Write rows with the columns of the first one, below lines of header that begin with #."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        file.writelines(f"# {line}\n" for line in header)
        writer = csv.writer(file, delimiter="\t", lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([text_of(value) for value in row.values()] for row in rows)


def text_of(value) -> str:
    """A cell: numbers with four digits, an empty one for None, no line ends."""
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else " ".join(str(value).split())

"""Cost and memory of long runs of the project's own solver, each in a process of its own."""

import dataclasses
import subprocess

from scenes import Scene
from workers import BUILD, SolverError

LAST_TIMES = (1e3, 1e4, 1e5, 1e6)
TOLERANCE = 1e-8
COLUMNS = ("scene", "t_end", "tolerance", "steps", "seconds", "seconds_per_time", "peak_memory_mb")


def rows_of_long_runs(scene: Scene) -> list[dict]:
    """A row for each last time."""
    return [row_of_long_run(dataclasses.replace(scene, t_end=t_end)) for t_end in LAST_TIMES]


def row_of_long_run(scene: Scene) -> dict:
    """One run by method auto, without samples."""
    run = subprocess.run(
        [BUILD / "long_run"],
        input=f"{scene.line()} {TOLERANCE:g}\n",
        capture_output=True,
        text=True,
    )
    if run.returncode != 0:
        raise SolverError(run.stderr.strip())
    seconds, steps, memory = run.stdout.split()
    return {
        "scene": scene.name,
        "t_end": f"{scene.t_end:.0f}",
        "tolerance": TOLERANCE,
        "steps": int(steps),
        "seconds": float(seconds),
        "seconds_per_time": float(seconds) / scene.t_end,
        "peak_memory_mb": int(memory) * 1024 / 1e6,
    }

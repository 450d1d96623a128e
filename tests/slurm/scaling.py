"""What the runs of ./test slurm say of speed, and of the time a large atlas would take."""

from dataclasses import dataclass

SIDE = 1000
"""Points along each side of the large atlas."""
PARTS = 500
"""Parts it is cut into."""
THREADS = 2
"""Threads of the rule that computes a part."""
WORKERS = [1, 10, 100]
"""Jobs at once."""


@dataclass
class Run:
    """A run of the workflow through Slurm."""

    workers: int
    points: int
    parts: int
    seconds: float
    """From the first job's start to the last one's end."""
    seconds_in_programs: float
    """Of all programs together."""


def start_up(run: Run) -> float:
    """Seconds that a part costs beside its program, with one worker."""
    return (run.seconds * run.workers - run.seconds_in_programs) / run.parts


def projected_hours(cpu_seconds: float, extra: float, workers: int) -> float:
    """Hours for the large atlas, where a point costs so much and a part so much more."""
    one_part = SIDE * SIDE / PARTS * cpu_seconds / THREADS + extra
    return -(-PARTS // workers) * one_part / 3600


def row(run: Run, first: Run) -> str:
    """A line of the scaling table; `first` is the run with one worker."""
    rate, first_rate = run.points / run.seconds, first.points / first.seconds
    slower = run.seconds_in_programs / first.seconds_in_programs
    return (
        f"{run.workers:7}  {run.points:6}  {run.parts:5}  {run.seconds:7.1f}"
        f"  {run.seconds_in_programs / run.points:9.2f}  {rate:8.2f}  {rate / first_rate:5.2f}"
        f"  {rate / first_rate * slower:23.2f}"
    )


def report(runs: list[Run], cpu_seconds: float, memory: float) -> list[str]:
    """Lines of the scaling table and of the projection with its arithmetic.

    The last column of the table leaves out that programs run slower beside others.
    """
    first = runs[0]
    extra = start_up(first)
    points = SIDE * SIDE
    one_part = points / PARTS * cpu_seconds / THREADS
    return [
        "workers  points  parts  seconds  s a point  points/s  ratio  ratio at the same speed",
        *(row(run, first) for run in runs),
        f"a point of the atlas: {cpu_seconds:.3f} s of CPU time ({first.points} points)",
        f"a part, beside its program: {extra:.1f} s with one worker",
        f"memory of a job: {memory:.0f} MB at most",
        f"{SIDE} x {SIDE}: {points} x {cpu_seconds:.3f} s / 3600 = "
        f"{points * cpu_seconds / 3600:.0f} core hours",
        f"in {PARTS} parts of {points // PARTS} points on {THREADS} cores: "
        f"{points // PARTS} x {cpu_seconds:.3f} s / {THREADS} + {extra:.1f} s = "
        f"{one_part + extra:.0f} s a part",
        *(
            f"with {workers} jobs at once: {-(-PARTS // workers)} x {one_part + extra:.0f} s = "
            f"{projected_hours(cpu_seconds, extra, workers):.1f} hours"
            for workers in WORKERS
        ),
    ]

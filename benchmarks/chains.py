"""Chains of blocks by this project's program and by JiTCDDE (benchmarks/run chains)."""

import math
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import xarray as xr
from measuring import add_limits, describe_machine, options_of, write_table
from project import PROGRAM, TABLES, configuration
from workers import SOLVERS, Scene, SolverError, TimeLimitError, Worker, peak_memory_of

from scripts.config.check_config import checked
from scripts.requests.parameters import histories_of
from scripts.requests.program_groups import scene_groups
from scripts.requests.write_namelist import write_namelist

PLACES = {
    0.8: {"tau": 10.0, "epsilon": 0.5, "xi": 0.8, "kappa": 1.0},
    1e8: {"tau": 12.0, "epsilon": 0.62, "xi": 0.5, "kappa": 1.0},
}
"""Parameters by gamma, at which blocks do not come to rest."""
TOLERANCES = (1e-6, 1e-8)
APART = {"ln_v": 0.5}
"""How far blocks are apart for t <= 0, where v = 1.1 exp(-0.5 to 0.5), theta = u = 0."""
T_SAMPLED, SAMPLE_INTERVAL = 40.0, 0.5
"""Errors and differences are the largest of theta, u, ln v over samples up to this time."""
T_ENDS = {1: 100000.0, 10: 20000.0, 100: 2000.0, 1000: 200.0, 10000: 100.0}
"""Ends of runs of the program by number of blocks; costs are those from T_SAMPLED to there."""
THEIR_T_ENDS = {1: 20000.0, 10: 2000.0, 100: 200.0, 1000: 40.0, 10000: 40.0}
"""Ends of runs of JiTCDDE, whose costs are those from the start."""
REFERENCE_TOLERANCE = 1e-12
LONG_SECONDS = 5.0
"""A run longer than this is measured once."""
COMPARED = {"free": (2, 3, 5, 20), "ring": (3, 5, 20), "plate": (2, 3, 5, 20)}
"""Numbers of blocks whose trajectories are compared, by ends."""
COMPARED_APART = {"theta": 0.1, "u": 0.1, "ln_v": 0.3}
COMPARED_TOLERANCES = (1e-8, 1e-10, 1e-12)
THEIR_TOLERANCE = 1e-11
"""Tolerance of JiTCDDE in comparisons."""


def settings_of(blocks: int, gamma: float, **given) -> dict:
    """A chain with the defaults of the configuration; one block alone is one, too."""
    own = {"t_end": T_SAMPLED, "sample_interval": SAMPLE_INTERVAL, "blocks": max(blocks, 2)}
    config = configuration()
    config["scenes"]["chain"] = {**PLACES[gamma], "gamma": gamma, **own, **given}
    return {**checked(config)["scenes"]["chain"], "blocks": blocks}


def groups_of(chain: dict, tolerance: float, **times: float) -> dict[str, dict]:
    """The namelist groups of the program."""
    scenes = {"chain": {**chain, "tolerance": tolerance, **times}}
    return scene_groups({**configuration(), "scenes": scenes}, "chain")


def jitcdde_worker(chain: dict, t_end: float = T_SAMPLED) -> Worker:
    """JiTCDDE on a chain."""
    past = np.array([[one["theta"], one["u"], np.log(one["v"])] for one in histories_of(chain)])
    scene = Scene(
        **{key: chain[key] for key in ("tau", "epsilon", "xi", "gamma", "sample_interval")},
        past=tuple(past.ravel()),
        t_end=t_end,
    )
    beside = [str(chain["kappa"]), chain["ends"], str(T_SAMPLED)]
    return Worker([*SOLVERS["jitcdde"].command, *beside], scene)


def run_program(groups: dict[str, dict], folder: Path) -> tuple[float, float]:
    """CPU seconds and the most memory in MB of the program; its result is in the folder."""
    namelist, output = folder / "chain.nml", folder / "chain.nc"
    write_namelist(namelist, groups)
    output.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    memory = 0.0
    with subprocess.Popen(
        [PROGRAM, "trajectory", namelist, output], stderr=subprocess.DEVNULL
    ) as process:
        while process.poll() is None:
            memory = max(memory, peak_memory_of(process))
            time.sleep(0.002)
    if process.returncode != 0:
        raise SolverError(f"{PROGRAM.name} ended with status {process.returncode}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, memory


def our_cost(chain: dict, tolerance: float, folder: Path) -> tuple[float, float]:
    """CPU seconds per unit of time and block, without start and output, and memory."""
    t_end = T_ENDS[chain["blocks"]]
    (long, memory), (short, _) = (
        run_program(groups_of(chain, tolerance, t_end=end, sample_interval=end), folder)
        for end in (t_end, T_SAMPLED)
    )
    return (long - short) / (t_end - T_SAMPLED) / chain["blocks"], memory


def our_samples(chain: dict, tolerance: float, folder: Path) -> np.ndarray:
    """Samples up to T_SAMPLED: an array (t, quantity, block)."""
    run_program(groups_of(chain, tolerance), folder)
    times = SAMPLE_INTERVAL * np.arange(round(T_SAMPLED / SAMPLE_INTERVAL) + 1)
    # the program adds samples where v varies fast
    found = xr.load_dataset(folder / "chain.nc").sel(t=times)
    values = [found.theta.values, found.u.values, np.log(found.v.values)]
    return np.stack(values, axis=1).reshape(len(found.t), 3, -1)


def their_samples(worker: Worker, tolerance: float, limit: float) -> np.ndarray:
    """The same by JiTCDDE."""
    samples = worker.samples(tolerance, limit)[:, 1:]
    return samples.reshape(len(samples), -1, 3).transpose(0, 2, 1)


def difference(samples: np.ndarray, others: np.ndarray) -> float:
    """The largest one."""
    found = float(abs(samples - others).max())
    if not math.isfinite(found):
        raise SolverError("the result is not a number, and no error was reported")
    return found


def cost_rows(blocks: int, gamma: float, repeats: int, limit: float, folder: Path) -> list[dict]:
    """Rows of both solvers at all tolerances.

    After a run of JiTCDDE that took too long no tighter tolerance is tried.
    """
    chain = settings_of(blocks, gamma, disturbance=APART)
    reference = our_samples(chain, REFERENCE_TOLERANCE, folder)
    rows, too_long = [], ""
    with jitcdde_worker(chain, THEIR_T_ENDS[blocks]) as worker:
        for tolerance in TOLERANCES:
            print(f"benchmarks: {blocks} blocks, {gamma:g}, {tolerance:g}", file=sys.stderr)
            place = {"blocks": blocks, "gamma": gamma, "tolerance": tolerance}
            ours, theirs = (
                {**place, "solver": name, "status": "ok"} for name in ("ours", "jitcdde")
            )
            ours["error_max"] = difference(our_samples(chain, tolerance, folder), reference)
            theirs["error_max"] = None
            try:
                if too_long:
                    raise SolverError(too_long)
                found = their_samples(worker, tolerance, limit)
                theirs["error_max"] = difference(found, reference)
            except SolverError as failure:
                theirs["status"] = str(failure)
                if isinstance(failure, TimeLimitError):
                    too_long = f"not tried: {tolerance:g} took too long"
            measure_costs(chain, ours, theirs, worker, repeats, limit, folder)
            rows += [ours, theirs]
    return rows


def measure_costs(
    chain: dict,
    ours: dict,
    theirs: dict,
    worker: Worker,
    repeats: int,
    limit: float,
    folder: Path,
) -> None:
    """Add costs to the rows of both solvers, which take turns; the median counts."""
    our_seconds, their_seconds = [], []
    for _ in range(repeats):
        seconds, memory = our_cost(chain, ours["tolerance"], folder)
        our_seconds.append(seconds)
        if theirs["status"] == "ok" and sum(their_seconds) < LONG_SECONDS:
            try:
                their_seconds.append(worker.seconds(theirs["tolerance"], 1, limit))
            except SolverError as failure:
                theirs["status"] = str(failure)
    ours |= {
        "seconds_per_time_and_block": statistics.median(our_seconds),
        "set_up_seconds": None,
        "peak_memory_mb": memory,
    }
    done = theirs["status"] == "ok"
    scale = worker.scene.t_end * chain["blocks"]
    theirs |= {
        "seconds_per_time_and_block": statistics.median(their_seconds) / scale if done else None,
        "set_up_seconds": worker.set_up_seconds,
        "peak_memory_mb": peak_memory_of(worker.process) if done else None,
    }


def difference_row(ends: str, blocks: int, limit: float, folder: Path) -> dict:
    """Differences of trajectories from the one by JiTCDDE at its tightest tolerance."""
    chain = settings_of(blocks, 0.8, ends=ends, disturbance=COMPARED_APART)
    with jitcdde_worker(chain) as worker:
        others = their_samples(worker, THEIR_TOLERANCE, limit)
    differences = {
        f"at {tolerance:g}": difference(our_samples(chain, tolerance, folder), others)
        for tolerance in COMPARED_TOLERANCES
    }
    return {"ends": ends, "blocks": blocks, **differences}


def main() -> None:
    """Measure, compare and write the tables."""
    parser = options_of("benchmarks/run chains", TABLES)
    parser.add_argument("--blocks", nargs="+", type=int, choices=list(T_ENDS), default=list(T_ENDS))
    add_limits(parser, time_limit=100.0)
    options = parser.parse_args()
    machine = describe_machine()
    try:
        with tempfile.TemporaryDirectory() as name:
            limit, folder = options.time_limit, Path(name)
            differences = [
                difference_row(ends, blocks, limit, folder)
                for ends, numbers in COMPARED.items()
                for blocks in numbers
            ]
            costs = [
                row
                for blocks in options.blocks
                for gamma in PLACES
                for row in cost_rows(blocks, gamma, options.repeats, limit, folder)
            ]
    except SolverError as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    header = [
        *machine,
        f"at {THEIR_TOLERANCE:g} by JiTCDDE, at other tolerances by this project's program:",
        f"largest differences of theta, u, ln v over samples up to t = {T_SAMPLED:g}",
    ]
    write_table(options.output / "chain-differences.tsv", differences, header)
    header = [
        *machine,
        "seconds_per_time_and_block: CPU time without start and output, median of repeats",
        f"error_max: largest error of theta, u, ln v over samples up to t = {T_SAMPLED:g}; the",
        f"reference is this project's at {REFERENCE_TOLERANCE:g}",
        "set_up_seconds: CPU time in which JiTCDDE makes and compiles the equations",
    ]
    write_table(options.output / "chain-costs.tsv", costs, header)


if __name__ == "__main__":
    main()

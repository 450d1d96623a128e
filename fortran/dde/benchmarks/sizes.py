# SPDX-License-Identifier: BSD-3-Clause
"""Cost of a step with many equations and many delays (run sizes)."""

import itertools
import re
import subprocess

from measuring import BUILD, describe_machine, measure_command, options_of, write_table

FAMILIES = {
    "equations": lambda size: (size, size, 0),
    "delays": lambda size: (1, size, 1),
    "both": lambda size: (size, size, 1),
}
"""Numbers of equations and delays, and the longest delay less the shortest: n equations with one
delay, one equation with n delays, and n equations each with its own."""
SIZES = (1, 10, 100, 1000, 10_000)
METHODS = {
    "bs5": ("f",),
    "dop853": ("f",),
    "taylor": ("series",),
    "radau5": ("f", "jacobian"),
    "radau13": ("f", "jacobian"),
}
"""Each with what the problem gives."""
T_END = 20.0
ALL_STEPS = 100_000_000


def run(family: str, size: int, given: str, method: str, steps: int) -> list:
    """The command of the worker."""
    return [BUILD / "sizes_worker", *FAMILIES[family](size), given, method, T_END, steps]


def numbers_of(command: list) -> list[float]:
    """What the worker prints."""
    return [float(word) for word in measure_command(command)[1].split()]


def instructions_of(command: list) -> int:
    """Instructions of a command."""
    counting = [
        "valgrind",
        "--tool=cachegrind",
        "--cache-sim=no",
        "--cachegrind-out-file=/dev/null",
    ]
    answer = subprocess.run(
        [*counting, *map(str, command)], capture_output=True, text=True, check=True
    )
    return int(re.search(r"I +refs: +([\d,]+)", answer.stderr)[1].replace(",", ""))


def row_of(family: str, size: int, method: str, given: str, least: float, count: bool) -> dict:
    """A row of the table; `least` is the memory of a run that needs hardly any."""
    whole = run(family, size, given, method, ALL_STEPS)
    accepted, steps, evaluations, seconds, memory = numbers_of(whole)
    calls = max(100, 1_000_000 // size)
    of_f = run(family, size, given, "f", calls)
    step_time, f_time = seconds / steps, numbers_of(of_f)[3] / calls
    row = {"family": family, "size": size, "method": method, "given": given}
    row |= {"accepted": int(accepted), "steps": int(steps), "evaluations": int(evaluations)}
    row |= {"microseconds": 1e6 * step_time, "over_f": step_time / f_time}
    row |= {"instructions": None, "instructions_over_f": None, "memory": memory - least}
    if count:
        of_start = instructions_of(run(family, size, given, method, 1))
        row["instructions"] = (instructions_of(whole) - of_start) / (steps - 1)
        calls = max(2, calls // 1000)
        of_calls = instructions_of(run(family, size, given, "f", calls))
        of_one = (of_calls - instructions_of(run(family, size, given, "f", 1))) / (calls - 1)
        row["instructions_over_f"] = row["instructions"] / of_one
    return row


def main() -> None:
    """Measure, print and write the table."""
    parser = options_of("run sizes")
    parser.add_argument("--count", action="store_true")
    options = parser.parse_args()
    least = numbers_of(run("equations", 1, "f", "bs5", 1))[4]
    rows = []
    for family, size in itertools.product(FAMILIES, SIZES):
        for method, all_given in METHODS.items():
            for given in all_given:
                rows.append(row_of(family, size, method, given, least, options.count))
                print(*rows[-1].values(), sep="\t", flush=True)
    header = [
        *describe_machine(),
        "family: equations with one delay, delays of one equation, or both, each with its own",
        "given: what the problem gives besides f; differences are banded where only f is given",
        f"tolerance 1e-6, t = 0 to {T_END:g}; steps: with rejected ones",
        "microseconds: CPU time of a step, over_f: over that of one evaluation of f",
        "instructions: of a step, after the first",
        "memory: peak in MB, over that of one step of one equation",
    ]
    write_table(options.output / "sizes.tsv", rows, header)


if __name__ == "__main__":
    main()

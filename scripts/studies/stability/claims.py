"""Claims about stiffness and the stationary state, by runs of stability.tsv."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, short
from scripts.claims.declare import Gamma, among, claim, number, reads, says, tested_with
from scripts.namelists.methods import METHODS

Method = Annotated[str, among("method of a run", METHODS)]
Distance = Annotated[float, number("distance from (0, 0, 1) up to which a run has settled there")]

SMALL = 1e-3
"""An error that a figure does not show."""
WITHIN_EXPECTED = 100.0
"""Largest error that is expected, over tolerance times amplification."""


@claim(24, "very_stiff_at_real_gamma", "section 3, below (10)", look_at="stability")
@says("The equations are very stiff at $gamma = 1e4$ to 1e12, the values of real faults.")
@tested_with(method="explicit", least=1e4, most=1e12)
@reads("stability")
def out_of_reach(results: Results, *, method: Method, least: Gamma, most: Gamma) -> Finding:
    """Whether no run of this method with gamma in this range is completed."""
    runs = runs_between(results.stability, method, least, most)
    done = sum(row["status"] == "ok" for row in runs)
    return decided(
        bool(runs) and not done,
        f"{done} of {len(runs)} runs by the method {method} with $gamma$ from {least:g} to {most:g}"
        " are completed.",
        f"{done} of {len(runs)} such runs are completed.",
    )


@claim(25, "real_gamma_left_out", "section 3, below (10)", look_at="stability")
@says(
    "$gamma = 0.8$ is taken in the place of 1e4 to 1e12 because the equations are very stiff there."
)
@tested_with(method="auto", least=1e4, most=1e12)
@reads("stability")
def stiffness_forbids(results: Results, *, method: Method, least: Gamma, most: Gamma) -> Finding:
    """Whether stiffness is a reason to leave these gammas out: for all runs, for some, or for none.

    A run is solved if it reaches its end with an error within what its tolerance lets expect.
    """
    runs = runs_between(results.stability, method, least, most)
    done = [row for row in runs if row["status"] == "ok"]
    compared = [row for row in done if row["error_expected"] > 0]
    solved = sum(row["error"] <= WITHIN_EXPECTED * row["error_expected"] for row in compared)
    large = [row for row in compared if row["error"] > SMALL]
    small = len(compared) - len(large)
    most_steps = max((row["steps"] for row in done), default=0)
    evidence = (
        f"{len(done)} of {len(runs)} runs by the method {method} with $gamma$ from {least:g} to"
        f" {most:g} reach their end. They take at most {most_steps:.0f} steps each. {solved} have"
        f" an error within what is expected: {WITHIN_EXPECTED:g} times tolerance times"
        f" amplification. {small} have an error of at most {SMALL:g}.{in_words(large)}"
        " References are in quadruple precision."
    )
    all_solved = bool(runs) and solved == len(runs)
    instead = "Stiffness does not prevent a solution." if all_solved else "Some are solved."
    return decided(not solved, evidence, instead, partly=not all_solved)


def in_words(rows: list[dict]) -> str:
    """Runs whose errors a figure shows, with what magnifies them."""
    parts = [
        f" {row['case']} has an error of {short(row['error'], 2)} at $t = {short(row['t_end'])}$:"
        f" it magnifies a disturbance of its history {short(row['amplification'], 2)} times."
        for row in rows
    ]
    return "".join(parts)


def runs_between(table: list[dict], method: str, least: float, most: float) -> list[dict]:
    """Runs of a method with gamma in a range."""
    return [row for row in table if row["method"] == method and least <= row["gamma"] <= most]


@claim(16, "stationary_state", "section 2, below (3)", look_at="stability.tsv")
@says("Steady sliding, $(theta, u, v) = (0, 0, 1)$, is the only stationary state.")
@tested_with(within=1e-06)
@reads("stability")
def stationary_state(results: Results, *, within: Distance) -> Finding:
    """Whether runs over long times that decay end at (0, 0, 1), and nothing else is stationary."""
    runs = [row for row in results.stability if str(row["reference"]).startswith("exact")]
    ends = [row["error"] for row in runs if row["status"] == "ok"]
    there = sum(end <= within for end in ends)
    return decided(
        there == len(runs) > 0,
        "$du/dt = 0$ gives $v = 1$. Then $d theta/dt = 0$ gives $theta = 0$, and $dv/dt = 0$ gives"
        f" $u = 0$. {len(ends)} of {len(runs)} long runs that decay are completed. They end at most"
        f" {short(max(ends, default=np.nan))} from this state.",
        f"{there} of {len(runs)} long runs end within {short(within)} of it.",
    )

"""Claims about stiffness and the stationary state, by runs of stability.tsv."""

import numpy as np

from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    decided,
    short,
)

SMALL = 1e-3
"""An error that a figure does not show."""
WITHIN_EXPECTED = 100.0
"""Largest error that is expected, over tolerance times amplification."""


def out_of_reach(results: Results, *, method: str, least: float, most: float) -> Finding:
    """Whether no run of this method with gamma in this range is completed."""
    runs = runs_between(results, method, least, most)
    done = sum(row["status"] == "ok" for row in runs)
    return decided(
        bool(runs) and not done,
        f"{done} of {len(runs)} runs by the method {method} with gamma from {least:g} to {most:g}"
        " are completed.",
        f"{done} of {len(runs)} such runs are completed.",
    )


def stiffness_forbids(results: Results, *, method: str, least: float, most: float) -> Finding:
    """Whether stiffness is a reason to leave these gammas out: for all runs, for some, or for none.

    A run is solved if it reaches its end with an error within what its tolerance lets expect.
    """
    runs = runs_between(results, method, least, most)
    done = [row for row in runs if row["status"] == "ok"]
    compared = [row for row in done if row["error_expected"] > 0]
    solved = sum(row["error"] <= WITHIN_EXPECTED * row["error_expected"] for row in compared)
    small = sum(row["error"] <= SMALL for row in compared)
    most_steps = max((row["steps"] for row in done), default=0)
    evidence = (
        f"{len(done)} of {len(runs)} runs by the method {method} with gamma from {least:g} to"
        f" {most:g} reach their end. They take at most {most_steps:.0f} steps each. {solved} have"
        f" an error within what is expected: {WITHIN_EXPECTED:g} times tolerance times"
        f" amplification. {small} have an error of at most {SMALL:g}. References are in quadruple"
        " precision."
    )
    if runs and solved == len(runs):
        return Finding(NOT_REPRODUCED, evidence, "Stiffness does not prevent a solution.")
    return (
        Finding(CORRECTED, evidence, "Some are solved.")
        if solved
        else Finding(REPRODUCED, evidence)
    )


def runs_between(results: Results, method: str, least: float, most: float) -> list[dict]:
    """Runs of a method with gamma in a range."""
    return [
        row
        for row in results.stability
        if row["method"] == method and least <= row["gamma"] <= most
    ]


def stationary_state(results: Results, *, within: float) -> Finding:
    """Whether runs over long times that decay end at (0, 0, 1), and nothing else is stationary."""
    runs = [row for row in results.stability if str(row["reference"]).startswith("exact")]
    ends = [row["error"] for row in runs if row["status"] == "ok"]
    there = sum(end <= within for end in ends)
    return decided(
        there == len(runs) > 0,
        "du/dt = 0 gives v = 1. Then d theta/dt = 0 gives theta = 0, and dv/dt = 0 gives u = 0."
        f" {len(ends)} of {len(runs)} long runs that decay are completed. They end at most"
        f" {short(max(ends, default=np.nan))} from this state.",
        f"{there} of {len(runs)} long runs end within {short(within)} of it.",
    )


TESTS = {
    "out_of_reach": out_of_reach,
    "stiffness_forbids": stiffness_forbids,
    "stationary_state": stationary_state,
}

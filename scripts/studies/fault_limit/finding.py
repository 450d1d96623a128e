"""The finding about the limit of real faults."""

import math

from scripts.claims.filters import short
from scripts.studies.fault_limit.table import STIFFEST, leading_order
from scripts.tables.ranges_of_gamma import FAULTS, PAPER

PLACE = 1
READS = ("fault_limit", "hopf_points")
CLAIMS = (
    "hopf_by_delay_at_faults",
    "hopf_only_by_delay",
    "hopf_is_supercritical",
    "both_kinds_of_hopf",
)


def describe(tables: dict[str, list[dict]]) -> dict:
    """Where steady sliding becomes unstable without delay, and how much a delay changes that."""
    limit = {row["gamma"]: row for row in tables["fault_limit"]}
    paper, fault = limit[PAPER], limit[FAULTS[0]]
    kinds = [(row["of"], row["kind"]) for row in tables["hopf_points"]]
    turns = sum(kind == "generalised_hopf" for _, kind in kinds)
    planes = len({of for of, kind in kinds if not kind.startswith("amplitude_death")})
    stiffest = leading_order(STIFFEST, fault["gamma"])
    bound = 10.0 ** math.ceil(math.log10(max(fault["depth"], stiffest)))
    return {
        "title": "At the $gamma$ of real faults the interval of $epsilon$ in which a delay makes"
        f" stable sliding unstable is at most {short(fault['depth'], 2)} wide for $xi ="
        f" {short(fault['xi'])}$, and narrower than {bound:.0e} up to $xi = {short(STIFFEST)}$.",
        "words": f"Without delay steady sliding becomes unstable at"
        f" $epsilon = {short(paper['without_delay'])}$ for $xi = {short(paper['xi'])}$ and"
        f" $gamma = {short(paper['gamma'])}$. Delays lower this least $epsilon$ by"
        f" {short(paper['depth'], 2)}. At large $gamma$ they lower it by"
        f" $xi^3 (1 + xi)/(2 gamma^4)$: at $gamma = {fault['gamma']:.0e}$ this is"
        f" {short(fault['depth'], 2)} for $xi = {short(fault['xi'])}$ and {short(stiffest, 2)} for"
        f" $xi = {short(STIFFEST)}$. Along the Hopf curves of {planes} planes the bifurcation"
        " changes between supercritical and subcritical at"
        f" {turns} point{'' if turns == 1 else 's'}.",
    }

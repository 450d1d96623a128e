"""Whether a delay matters for the stability of sliding at the gamma of real faults."""

from typing import Annotated

from scripts.claims.claims_results import Finding, Results, decided, equations, short
from scripts.claims.declare import Gamma, number, question, reads, says, tested_with
from scripts.studies.fault_limit.table import leading_order

STIFFEST = 10.0
"""A xi beyond that of any fault: steady sliding is unstable there if b is 11 a or more."""
Share = Annotated[float, number("interval of epsilon, over its end, up to which it counts as none")]


@question(3, "hopf_by_delay_at_faults", look_at="fault_limit")
@says(
    "Does a delay make stable steady sliding unstable at the $gamma$ of real faults, 1e4 to 1e12,"
    " in an interval of $epsilon$ wider than a millionth?"
)
@tested_with(least=1e4, most=1e12, limit=1e-06)
@reads("fault_limit")
def hopf_by_delay_at_faults(
    results: Results, *, least: Gamma, most: Gamma, limit: Share
) -> Finding:
    """Whether a delay makes steady sliding unstable at an epsilon where it is stable without."""
    rows = [row for row in results.fault_limit if least <= row["gamma"] <= most]
    if not rows:
        raise ValueError(f"fault-limit.tsv: no gamma from {short(least)} to {short(most)}")
    widest = max(rows, key=lambda row: row["depth"] / row["without_delay"])
    stiffest = leading_order(STIFFEST, least)
    return decided(
        widest["depth"] > limit * widest["without_delay"],
        f"The least $epsilon$ of all Hopf curves is computed at {equations(widest, ['xi'])} and"
        f" {len(rows)} values of $gamma$ from {short(least)} to {short(most)}. It lies below the"
        f" Hopf point without delay by at most {short(widest['depth'], 2)}, at"
        f" {equations(widest, ['gamma'])}, where that point has"
        f" $epsilon = {short(widest['without_delay'])}$. To leading order the difference is"
        f" $xi^3 (1 + xi)/(2 gamma^4)$. At the same $gamma$ and $xi = {short(STIFFEST)}$ it is"
        f" {short(stiffest, 2)}; there $b = {short(1 + STIFFEST)} a$ is the limit of stability.",
        f"The interval is at most {short(widest['depth'], 2)} wide at {equations(widest, ['xi'])}."
        " Below it, for a spring stiffer than $k_c = (B - A)/L$, steady sliding is stable at every"
        " delay. Above it is unstable without delay.",
    )

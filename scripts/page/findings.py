"""The findings at the top of the page, with numbers from the tables."""

import math
from collections.abc import Callable

from scripts.claims.claims_of_bifurcations import STIFFEST
from scripts.claims.claims_of_laws import CHAOTIC, PERIODIC
from scripts.claims.claims_of_runs import SMALL
from scripts.claims.claims_results import short
from scripts.figures.wording import count
from scripts.tables.fault_limit_table import FAULTS, PAPER
from scripts.tables.friction_laws_table import shares_of
from scripts.tables.motion_rows import class_in_words, own_rows

TABLES = ("chain_motions", "fault_limit", "friction_laws", "hopf_points", "stability")
"""Tables that findings read beside that of the attractors."""
TORUS, TRUE_TORUS = "torus", "true_torus"
"""The scene that the paper calls a torus, and one that has a longer delay."""
MAIN_CLAIMS = ("delay_alone_makes_chaos", "quasiperiodic_route")
"""Claims of the abstract that stand below the findings."""


def list_findings(claims: list[dict], tables: dict[str, list[dict]]) -> list[dict]:
    """Findings, each with its title, a sentence or two, and the claims that it is about."""
    by_id = {claim["id"]: claim for claim in claims}
    return [
        {**find(tables), "claims": [by_id[name] for name in names if name in by_id]}
        for find, names in FINDINGS.items()
    ]


def describe_torus(tables: dict[str, list[dict]]) -> dict:
    """The motion at the paper's torus, and at a longer delay."""
    motions = own_rows(tables["attractors"])
    paper, longer = motions[TORUS], motions[TRUE_TORUS]
    return {
        "title": f"The paper's torus is a {class_in_words(paper)}.",
        "words": f"At $tau = {short(paper['tau'])}$ it has {describe_motion(paper)}. At"
        f" $tau = {short(longer['tau'])}$, with all else the same, the motion is a"
        f" {class_in_words(longer)}: it has {describe_motion(longer)}.",
    }


def describe_fault_limit(tables: dict[str, list[dict]]) -> dict:
    """Where steady sliding becomes unstable without delay, and how much a delay changes that."""
    limit = {row["gamma"]: row for row in tables["fault_limit"]}
    paper, fault = limit[PAPER], limit[FAULTS[0]]
    kinds = [(row["of"], row["kind"]) for row in tables["hopf_points"]]
    turns = sum(kind == "generalised_hopf" for _, kind in kinds)
    planes = len({of for of, kind in kinds if not kind.startswith("amplitude_death")})
    stiffest = STIFFEST**3 * (1 + STIFFEST) / (2 * fault["gamma"] ** 4)
    bound = 10.0 ** math.ceil(math.log10(max(fault["depth"], stiffest)))
    return {
        "title": "At the $gamma$ of real faults the interval of $epsilon$ in which a delay makes"
        f" stable sliding unstable is narrower than {bound:.0e}.",
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


def describe_real_faults(tables: dict[str, list[dict]]) -> dict:
    """Whether the equations can be solved at the gamma of real faults."""
    least, most = FAULTS
    runs = [row for row in tables["stability"] if least <= row["gamma"] <= most]
    done = {
        method: [row for row in runs if row["method"] == method and row["status"] == "ok"]
        for method in ("auto", "explicit")
    }
    started = sum(row["method"] == "auto" for row in runs)
    steps = max((row["steps"] for row in done["auto"]), default=0)
    large = sum(row["error"] > SMALL for row in done["auto"])
    magnified = f" In {large} of them the problem magnifies errors beyond {SMALL:g}." * (large > 0)
    share = "All" if len(done["auto"]) == started else f"{len(done['auto'])} of"
    return {
        "title": "The paper's range of $gamma$ is accessible."
        if done["auto"]
        else "The paper's range of $gamma$ is not accessible.",
        "words": f"The paper leaves out $gamma = {least:.0e}$ to {most:.0e}. {share} {started} runs"
        f" there reach their end, each in at most {steps:.0f} steps. With explicit steps alone"
        f" {len(done['explicit']) or 'none'} do.{magnified}",
    }


def describe_laws(tables: dict[str, list[dict]]) -> dict:
    """How many points of a plane are chaotic, by the place of the delay in the law."""
    shares = shares_of(tables["friction_laws"])
    counts = {}
    for share in shares:
        place = CHAOTIC if share["law"].endswith(CHAOTIC) else PERIODIC
        counts.setdefault(share["gamma"], {CHAOTIC: [], PERIODIC: []})
        counts[share["gamma"]][place].append(share["kinds"]["chaos"])
    decides = all(counts[PAPER][CHAOTIC]) and not any(counts[PAPER][PERIODIC])
    words = [
        f"At $gamma = {short(gamma)}$ a plane has {span(of[CHAOTIC])} chaotic points if the delay"
        f" stands in the logarithm, and {span(of[PERIODIC])} if the velocity itself is delayed."
        for gamma, of in counts.items()
    ]
    return {
        "title": f"At $gamma = {short(PAPER)}$ whether there is chaos depends on where the delay"
        f" stands, {'not' if decides else 'and'} on the law of friction.",
        "words": f"All laws have the linear stability of the paper's. Planes have"
        f" {span([share['points'] for share in shares])} points, each with one history."
        f" {' '.join(words)} A delayed velocity weakens slip only as far as the block was fast one"
        " delay before: hence cycles.",
    }


def span(numbers: list[int]) -> str:
    """The least and the largest of some numbers."""
    return " to ".join(map(str, sorted({min(numbers), max(numbers)})))


def describe_chains(tables: dict[str, list[dict]]) -> dict:
    """How many exponents of a chain are positive, with a delay and without."""
    chaotic = [row for row in tables["chain_motions"] if row["positive_exponents"] > 0]
    delayed = [row for row in chaotic if row["tau"] > 0]
    most = max(delayed, key=lambda row: row["positive_exponents"], default=None)
    words = [
        f"Without delay {row['blocks']:g} blocks have at least {row['positive_exponents']:g}"
        f" positive exponents at $epsilon = {short(row['epsilon'])}$, $xi = {short(row['xi'])}$ and"
        f" $gamma = {short(row['gamma'])}$: chaos in a chain needs no delay."
        for row in chaotic
        if row["tau"] == 0
    ]
    if most:
        words = [
            f"{most['blocks']:g} blocks with $tau = {short(most['tau'])}$ have"
            f" at least {most['positive_exponents']:g} positive Lyapunov exponents.",
            *words,
        ]
    return {
        "title": "In chains of blocks chaos has many dimensions."
        if most and most["positive_exponents"] > 1
        else "Chains of blocks are not more chaotic than one.",
        "words": " ".join(words),
    }


def describe_motion(row: dict) -> str:
    """How many exponents are zero, and the fundamental frequencies."""
    bases = [f"$f{i} = {short(row[f'f{i}'])}$" for i in (1, 2) if row[f"f{i}"] > 0]
    frequency = "fundamental frequency" if len(bases) == 1 else "fundamental frequencies"
    found = count(int(row["zero_exponents"]), "zero Lyapunov exponent")
    return f"{found} and the {frequency} {' and '.join(bases)}" if bases else found


FINDINGS: dict[Callable, list[str]] = {
    describe_fault_limit: [
        *("hopf_by_delay_at_faults", "hopf_only_by_delay"),
        *("hopf_is_supercritical", "both_kinds_of_hopf"),
    ],
    describe_torus: ["figure_5a", "figure_6b", "second_hopf"],
    describe_real_faults: ["real_gamma_left_out", "very_stiff_at_real_gamma"],
    describe_laws: ["chaos_depends_on_place_of_delay"],
    describe_chains: ["more_blocks", "gutenberg_richter", "omori_utsu"],
}
"""Functions that describe the findings, each with its claims."""

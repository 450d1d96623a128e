"""The finding about chaos in chains."""

from scripts.claims.filters import short

PLACE = 5
READS = ("chain_motions",)
CLAIMS = ("more_blocks", "gutenberg_richter", "omori_utsu")


def describe(tables: dict[str, list[dict]]) -> dict:
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

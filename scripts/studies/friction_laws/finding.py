"""The finding about other laws of friction."""

from scripts.claims.filters import short
from scripts.files.tsv import rows_by
from scripts.studies.friction_laws.table import CHAOTIC, PERIODIC, chaotic_points, shares_of
from scripts.tables.ranges_of_gamma import PAPER

PLACE = 4
READS = ("friction_laws",)
CLAIMS = ("chaos_depends_on_place_of_delay",)


def describe(tables: dict[str, list[dict]]) -> dict:
    """How many points of a plane are chaotic, by the place of the delay in the law."""
    shares = shares_of(tables["friction_laws"])
    counts = {gamma: chaotic_points(shares, gamma) for gamma in rows_by(shares, "gamma")}
    decides = all(counts[PAPER][CHAOTIC]) and not any(counts[PAPER][PERIODIC])
    words = [
        f"At $gamma = {short(gamma)}$ a plane has {span(of[CHAOTIC])} chaotic points if the delay"
        f" stands in the logarithm, and {span(of[PERIODIC])} if the velocity itself is delayed."
        for gamma, of in counts.items()
    ]
    return {
        "title": f"At $gamma = {short(PAPER)}$, on {span([share['points'] for share in shares])}"
        " points a plane and from one history, whether there is chaos depends on where the delay"
        f" stands, {'not' if decides else 'and'} on the law of friction.",
        "words": f"All laws have the linear stability of the paper's. {' '.join(words)} A delayed"
        " velocity weakens slip only as far as the block was fast one delay before: hence cycles.",
    }


def span(numbers: list[int]) -> str:
    """The least and the largest of some numbers."""
    return " to ".join(map(str, sorted({min(numbers), max(numbers)})))

"""The finding about the paper's torus."""

from scripts.claims.filters import short
from scripts.drawing.wording import count
from scripts.tables.motion_rows import class_in_words, own_rows

TORUS, TRUE_TORUS = "torus", "true_torus"
"""The scene that the paper calls a torus, and one that has a longer delay."""
PLACE = 2
READS = ("attractors",)
CLAIMS = ("figure_5a", "figure_6b", "second_hopf")


def describe(tables: dict[str, list[dict]]) -> dict:
    """The motion at the paper's torus, and at a longer delay."""
    motions = own_rows(tables["attractors"])
    paper, longer = motions[TORUS], motions[TRUE_TORUS]
    return {
        "title": f"The paper's torus is a {class_in_words(paper)}.",
        "words": f"At $tau = {short(paper['tau'])}$ it has {describe_motion(paper)}. At"
        f" $tau = {short(longer['tau'])}$, with all else the same, the motion is a"
        f" {class_in_words(longer)}: it has {describe_motion(longer)}.",
    }


def describe_motion(row: dict) -> str:
    """How many exponents are zero, and the fundamental frequencies."""
    bases = [f"$f{i} = {short(row[f'f{i}'])}$" for i in (1, 2) if row[f"f{i}"] > 0]
    frequency = "fundamental frequency" if len(bases) == 1 else "fundamental frequencies"
    found = count(int(row["zero_exponents"]), "zero Lyapunov exponent")
    return f"{found} and the {frequency} {' and '.join(bases)}" if bases else found

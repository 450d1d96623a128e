"""Signs of exponents, in files and in words."""

SIGNS = {1: "positive", 0: "zero", -1: "negative", 2: "unclear"}
"""Of exponents in files, with their words; unclear are those that may be zero."""


def count_in_words(counts: dict[str, float]) -> str:
    """How many exponents are positive and zero, and of how many the sign is unclear, if any."""
    said = [word for word in ("positive", "zero", "unclear") if counts[word] or word != "unclear"]
    return ", ".join(f"{counts[word]:g} {word}" for word in said)

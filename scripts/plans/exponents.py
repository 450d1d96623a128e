"""Figure of exponents: running averages; values by tolerance and by resolution of the history."""

from scripts.results.paths import exponents_of_scenes


def inputs(config: dict) -> dict:
    """Exponents of all scenes that ask for them."""
    return {"runs": exponents_of_scenes(config), "table": "<results>/tables/exponents.tsv"}

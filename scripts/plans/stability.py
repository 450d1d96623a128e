"""Figure of stability: the grid of frequency and delay by two methods, and all other cases."""


def inputs(_config: dict) -> dict:
    """Measured runs of all families of cases."""
    return {"table": "<results>/tables/stability.tsv"}

"""Figure of the fault limit: where Hopf bifurcations begin over gamma, with and without delay."""


def inputs(_config: dict) -> dict:
    """The least epsilon of all Hopf curves over gamma."""
    return {"table": "<results>/tables/fault-limit.tsv"}

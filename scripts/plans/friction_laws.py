"""Figure of other laws of friction: classes of motion over epsilon and tau, and fastest slip."""


def inputs(_config: dict) -> dict:
    """Motions of each law in each plane, and in scenes of the paper."""
    return {"table": "<results>/tables/friction-laws.tsv"}


def params(config: dict) -> dict:
    """Quantities in SI by which nondimensional times are those of a fault and a laboratory."""
    return {name: config["scenes"][name]["si"] for name in ("natural_fault", "laboratory")}

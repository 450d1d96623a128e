"""Figure of the atlas: classes of motion and the largest exponent over epsilon and tau."""

from scripts.results.paths import curves_of_atlas, cycles_in_atlas, places_in_atlas, table_of_atlas


def inputs(config: dict) -> dict:
    """Classes of motion, and the Hopf curves and curves of cycles in the same planes."""
    return {
        "table": table_of_atlas(config),
        "curves": curves_of_atlas(config),
        "cycles": cycles_in_atlas(config),
    }


def params(config: dict) -> dict:
    """Scenes with known attractors."""
    return {"scenes": places_in_atlas(config)}

"""Figure of the cycles followed: their greatest v along a parameter, stable or not."""

from pathlib import Path

from scripts.results.paths import cycles_of_lines, places_in_atlas, sweeps_on_lines


def inputs(config: dict) -> dict:
    """Cycles of each line, and the sweeps of routes on the same lines."""
    sweeps = [path for on_line in sweeps_on_lines(config).values() for path in on_line]
    return {"cycles": cycles_of_lines(config), "sweeps": sweeps}


def params(config: dict) -> dict:
    """Directions of the sweeps on each line, and scenes with known attractors."""
    sweeps = sweeps_on_lines(config).values()
    directions = [[Path(path).stem for path in on_line] for on_line in sweeps]
    return {"directions": directions, "scenes": places_in_atlas(config)}

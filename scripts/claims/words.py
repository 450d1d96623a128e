"""Words about results that several studies' claims share."""

from scripts.claims.claims_results import Results, equations, short
from scripts.files.inputs import Dataset
from scripts.namelists.parameters import PARAMETERS


def class_with_loops(row: dict) -> str:
    """The class, of a cycle with its period in the section."""
    period = row["period"]
    several = row["class"] == "cycle" and period > 1
    return f"cycle with {period:.0f} loops" if several else row["class"]


def places_along(along: str, places: list[float]) -> str:
    """Values of the parameter along a line in words."""
    first, *others = map(short, places)
    return " and ".join([f"${along} = {first}$", *others])


def torus_points(results: Results, fixed: dict[str, float]) -> list[dict]:
    """Torus bifurcations of stable cycles on a line, given by what is fixed on it, in order."""
    found = {
        tuple(point[key] for key in PARAMETERS): point
        for point in results.cycle_points
        if point["kind"] == "torus"
        and min(point["unstable_before"], point["unstable_behind"]) == 0
        and all(point[key] == value for key, value in fixed.items())
    }
    return [found[place] for place in sorted(found)]


def motions_beside_rest(results: Results) -> str:
    """What linear stability leaves out: the share of random histories that come to rest."""
    parts = [
        f"{100 * row['share']:.0f} % of {row['histories']:.0f} at"
        f" {equations(row, ['tau', 'epsilon', 'xi'])}"
        for row in results.basins
        if row["class"] == "fixed point"
    ]
    return (
        "The roots say what small disturbances do. Of random histories, up to slip events, these"
        f" come to rest where it is stable: {'; '.join(parts) or 'none'}."
    )


def boundary(curves: Dataset) -> Dataset:
    """The points where stability changes."""
    return curves.isel(point=curves.unstable_roots.values == 0)

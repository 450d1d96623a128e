"""Velocity and phase portrait of the paper's scenes."""

from scripts.plans.declare import MAIN, Figure, Study
from scripts.plans.scenes import paths_of_scenes, scenes_of


def inputs(config: dict) -> dict:
    """Trajectories of the rows, and classes of motion."""
    return {
        "table": "<results>/tables/attractors.tsv",
        "trajectories": paths_of_scenes("trajectories", scenes_of(config, *config["figures"])),
    }


def params(config: dict) -> dict:
    """Rows with the paper's words, and the times shown."""
    (settings,) = config["figures"].values()
    return {"settings": settings}


def figure(number: int, rows: str) -> Figure:
    """One of the paper's two figures of trajectories."""
    name = f"figure_{number}"
    return Figure(
        name,
        title=f"Figure {number}: velocity and phase portrait, rows {rows}.",
        category=MAIN,
        place=10 * number,
        inputs=inputs,
        params=params,
        variables=("u", "v"),
        shows=("figures", name),
        caption=f"{name}.rst",
    )


STUDY = Study(
    reads=("attractors", "cycles", "scenes"),
    figures=(
        figure(4, "a (fixed point) and b (oscillations)"),
        figure(5, "a (the paper's torus) and b (chaos)"),
    ),
)

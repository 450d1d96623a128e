"""Hopf curves in a plane of epsilon and another parameter.

Formulas and sources: (5) `characteristic_function.f90`; curves `hopf_curves.f90`;
supercritical or subcritical `hopf_normal_form.f90`; special points `hopf_points.f90`,
`hopf_unfoldings.f90`, `double_hopf.f90`.
"""

from scripts.plans.declare import MAIN, PAPER, Figure, Run, Study, Table
from scripts.plans.scenes import roots_of_scenes, scenes_in_plane
from scripts.requests.parameters import plane_group


def groups(config: dict, plane: str) -> dict[str, dict]:
    """A plane of Hopf curves."""
    return {"hopf_curves": plane_group(config, config["hopf_curves"][plane])}


def inputs(config: dict) -> dict:
    """Hopf curves of the plane that the configuration lists."""
    (plane,) = config["hopf_curves"]
    return {"curves": f"<results>/hopf/{plane}.nc"}


def params(config: dict) -> dict:
    """Scenes that lie in the plane."""
    (plane,) = config["hopf_curves"].values()
    return {"scenes": scenes_in_plane(config, plane)}


def figure(number: int, title: str, plane: str) -> Figure:
    """One of the paper's two figures of Hopf curves."""
    return Figure(
        f"figure_{number}",
        title=f"Figure {number}: {title}.",
        category=MAIN,
        place=10 * number,
        inputs=inputs,
        params=params,
        shows=("hopf_curves", plane),
        caption=f"figure_{number}.rst",
    )


STUDY = Study(
    reads=("formulas", "linear_stability", "routes", "scenes"),
    entries={"plane": ("hopf_curves",)},
    runs=(Run("hopf_curves", "hopf", "hopf/{plane}.nc", groups, data="curves", priority=PAPER),),
    tables=(
        Table(
            *("hopf_points", "tables/hopf-points.tsv"),
            lambda config: {
                "curves": [f"<results>/hopf/{plane}.nc" for plane in config["hopf_curves"]],
                "scenes": roots_of_scenes(config),
            },
            wanted=lambda config: bool(config["hopf_curves"]),
        ),
    ),
    figures=(
        figure(2, "Hopf curves tau(epsilon) at fixed xi and gamma", "tau_of_epsilon"),
        figure(3, "Hopf curves xi(epsilon) at fixed tau and gamma", "xi_of_epsilon"),
    ),
    kinds=(
        Figure(
            "planes",
            category="Hopf curves",
            place=30,
            inputs=inputs,
            params=params,
            shows=("hopf_curves",),
        ),
    ),
)

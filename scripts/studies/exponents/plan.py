"""Figure of exponents: running averages; values by tolerance and by resolution of the history.

Formulas and sources: `lyapunov_spectrum.f90`, `tangent_problem.f90`, `tangent_vectors.f90`,
`exponent_averages.f90`.
"""

from scripts.models.models import model_of
from scripts.plans.declare import LONGEST, Figure, Run, Study, Table
from scripts.plans.scenes import paths_of_scenes, scenes_with
from scripts.requests.parameters import zero_of
from scripts.requests.program_groups import scene_groups


def groups(config: dict, scene: str) -> dict[str, dict]:
    """A scene and how its exponents are measured, by default up to its own end."""
    settings = config["scenes"][scene]
    own = {"t_end": settings["t_end"], "checks": True, **settings.get("exponents", {})}
    measured = config["exponents"] | zero_of(config) | own
    if not measured.pop("checks"):
        measured = {key: one for key, one in measured.items() if not key.startswith("check_")}
    return {**scene_groups(config, scene), "exponents": measured}


def runs_of_scenes(config: dict) -> list[str]:
    """Exponents of all scenes that ask for them."""
    return paths_of_scenes("exponents", scenes_with(config, "exponents"))


def runs_shown(config: dict) -> list[str]:
    """Exponents of the scenes with checks; of a scene alone also without."""
    names = scenes_with(config, "exponents")
    checked = [name for name in names if config["scenes"][name]["exponents"]["checks"]]
    return paths_of_scenes("exponents", checked or names)


def params(config: dict) -> dict:
    """Scenes with t in their equations: none of their exponents is that of the flow."""
    scenes = config["scenes"]
    return {"driven": [name for name in scenes if model_of(config, scenes[name]).is_driven]}


FIGURE = {
    "params": params,
    "inputs": lambda config: {
        "runs": runs_shown(config),
        "table": "<results>/tables/exponents.tsv",
    },
}
STUDY = Study(
    reads=("attractors", "cycles", "scenes"),
    runs=(
        Run(
            *("exponents_runs", "exponents", "exponents/{scene}.nc", groups),
            priority=LONGEST,
            minutes=120,
        ),
    ),
    tables=(
        Table(
            *("exponents_table", "tables/exponents.tsv"),
            lambda config: {"runs": runs_of_scenes(config)},
        ),
    ),
    figures=(Figure("exponents", category="Supplement", place=110, **FIGURE),),
    kinds=(
        Figure(
            "exponents",
            category="Exponents",
            place=20,
            shows=("scenes",),
            shows_entry=lambda config, scene: "exponents" in config["scenes"][scene],
            **FIGURE,
        ),
    ),
)

"""Figure of one scene: in time, phase portrait, section, exponents, and spectrum.

Formulas and sources: (3), (4) `spring_block.yaml`, `slip_delayed_logarithm.yaml`;
`spectral_density.f90`.
"""

from scripts.models.models import model_of
from scripts.plans.declare import PAPER, Figure, Run, Study
from scripts.plans.scenes import is_block
from scripts.requests.program_groups import scene_groups


def spectrum_groups(config: dict, scene: str) -> dict:
    """The trajectory of a scene, and how its spectrum is made."""
    return {"trajectory": f"<results>/trajectories/{scene}.nc", "spectrum": config["spectra"]}


def inputs(config: dict) -> dict:
    """Trajectory, spectrum, attractors and roots of the scene that the configuration lists."""
    ((scene, settings),) = config["scenes"].items()
    roots = {"roots": f"<results>/linear_stability/{scene}.nc"}
    return {
        "trajectory": f"<results>/trajectories/{scene}.nc",
        "spectrum": f"<results>/spectra/{scene}.nc",
        "attractors": f"<results>/attractors/scenes/{scene}.nc",
        **(roots if model_of(config, settings).has_rest else {}),
    }


def params(config: dict) -> dict:
    """The quantities of a scene that is given in SI; no roots unless they are among the inputs."""
    (scene,) = config["scenes"].values()
    return {"si": scene.get("si", {}), "roots": None}


STUDY = Study(
    reads=("attractors", "linear_stability"),
    entries={"scene": ("scenes",)},
    runs=(
        Run(
            *("trajectory", "trajectory", "trajectories/{scene}.nc", scene_groups),
            data="trajectories",
            priority=PAPER,
        ),
        Run(
            *("spectrum", "spectrum", "spectra/{scene}.nc", spectrum_groups),
            data="spectra",
            needs={"trajectory": "trajectories/{scene}.nc"},
            priority=PAPER,
        ),
    ),
    kinds=(
        Figure(
            "scenes",
            category="Scenes",
            place=10,
            inputs=inputs,
            params=params,
            variables=("u", "v"),
            shows=("scenes",),
            shows_entry=is_block,
        ),
    ),
)

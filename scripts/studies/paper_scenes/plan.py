"""Velocity, phase portrait and power spectrum of the paper's scenes.

Formulas and sources: `spectral_density.f90`, `spectral_peaks.f90`, `base_frequencies.f90`,
`spectrum_verdict.f90`.
"""

from collections.abc import Callable

from scripts.plans.declare import MAIN, Figure, Study
from scripts.plans.scenes import paths_of_scenes, scenes_of

PORTRAIT = "velocity and phase portrait"


def portraits(config: dict) -> dict:
    """Trajectories of the rows, and classes of motion."""
    return {
        "table": "<results>/tables/attractors.tsv",
        "trajectories": paths_of_scenes("trajectories", scenes_of(config, *config["figures"])),
    }


def spectra(config: dict) -> dict:
    """Spectra of the rows."""
    return {"spectra": paths_of_scenes("spectra", scenes_of(config, *config["figures"]))}


def params(config: dict) -> dict:
    """Rows with the paper's words, and the times or frequencies shown."""
    (settings,) = config["figures"].values()
    return {"settings": settings}


def figure(number: int, inputs: Callable, title: str) -> Figure:
    """One of the paper's figures of portraits or spectra."""
    name = f"figure_{number}"
    return Figure(
        name,
        title=f"Figure {number}: {title}.",
        category=MAIN,
        place=10 * number,
        inputs=inputs,
        params=params,
        variables=("u", "v") if inputs is portraits else (),
        shows=("figures", name),
        module=inputs.__name__,
        caption=f"{name}.rst",
    )


STUDY = Study(
    reads=("attractors", "cycles", "scenes"),
    figures=(
        figure(
            4, portraits, "velocity and phase portrait, rows a (fixed point) and b (oscillations)"
        ),
        figure(
            5, portraits, "velocity and phase portrait, rows a (the paper's torus) and b (chaos)"
        ),
        figure(6, spectra, "power spectra, rows a (oscillations) and b (the paper's torus)"),
        figure(7, spectra, "power spectrum of the chaotic scene"),
    ),
)

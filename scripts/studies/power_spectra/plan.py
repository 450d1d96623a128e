"""Power spectra of the paper's scenes.

Formulas and sources: `spectrum.f90`, `spectral_peaks.f90`, `base_frequencies.f90`,
`spectrum_verdict.f90`.
"""

from scripts.plans.declare import MAIN, Figure, Study
from scripts.plans.scenes import paths_of_scenes, scenes_of


def inputs(config: dict) -> dict:
    """Spectra of the rows."""
    return {"spectra": paths_of_scenes("spectra", scenes_of(config, *config["figures"]))}


def params(config: dict) -> dict:
    """Rows with the paper's words, and the frequencies shown."""
    (settings,) = config["figures"].values()
    return {"settings": settings}


def figure(number: int, title: str) -> Figure:
    """One of the paper's two figures of spectra."""
    name = f"figure_{number}"
    return Figure(
        name,
        title=f"Figure {number}: {title}.",
        category=MAIN,
        place=10 * number,
        inputs=inputs,
        params=params,
        shows=("figures", name),
        caption=f"{name}.rst",
    )


STUDY = Study(
    reads=("scenes",),
    figures=(
        figure(6, "power spectra, rows a (oscillations) and b (the paper's torus)"),
        figure(7, "power spectrum of the chaotic scene"),
    ),
)

"""Which rules, programs and data each figure needs."""

from conftest import ROOT

from scripts.config.read_config import read


def data_of(*scenes: str) -> set[str]:
    """Trajectories and spectra of scenes."""
    return {f"{kind}/{scene}.nc" for kind in ("trajectories", "spectra") for scene in scenes}


def settings(*path: str) -> dict:
    """A section of the config as it stands in the file."""
    section = read(ROOT / "config" / "config.yaml")
    for key in path:
        section = section[key]
    return section


OPTIONAL = {"atlas", "docs"}
"""Rules that are no part of everything."""
FAMILIES = settings("stability", "families")
WORK_SCENES = settings("work_precision", "scenes")
PLANES = settings("atlas", "planes")
SCENES = ["oscillation", "torus", "chaos", "true_torus"]
"""Scenes that move."""
FIGURES = [*(f"figure_{n}" for n in range(1, 9)), "exponents", "stability", "work_precision"]
FIGURES += ["atlas_coarse", "true_torus", "route_to_chaos"]
HOPF = {"build", "hopf_namelist", "hopf_curves"}
SPECTRA = {"build", "scene_namelist", "trajectory", "spectrum_namelist", "spectrum"}
ATTRACTORS = {"build", "attractors_namelist", "attractors_runs"}
RULES_OF = {
    "figure_1": set(),
    "figure_2": HOPF,
    "figure_3": HOPF,
    "figure_4": {"build", "scene_namelist", "trajectory"},
    "figure_5": SPECTRA,
    "figure_6": SPECTRA,
    "figure_7": SPECTRA,
    "figure_8": {"build", "velocity_step_namelist", "velocity_step"},
    "exponents": {"build", "exponents_namelist", "exponents_runs", "exponents_table"},
    "stability": {"build", "stability_namelists", "reference", "measurement", "stability_table"},
    "work_precision": {
        "build",
        "trust_namelists",
        "reference",
        "measurement",
        "trusted_horizons",
        "work_precision_namelist",
        "work_precision_runs",
        "work_precision_table",
    },
    "atlas_coarse": {*ATTRACTORS, "atlas_table", *HOPF},
    "true_torus": {*ATTRACTORS, "attractors_table", *SPECTRA},
    "route_to_chaos": {*ATTRACTORS, "route_table"},
}
"""Rules that each figure needs besides its own."""
RULES_OF_ATTRACTORS = {
    "attractors_namelist",
    "attractors_runs",
    "attractors_table",
    "route_table",
}
"""Rules that the ledger needs besides."""
OUTPUTS_OF = {
    "figure_1": set(),
    "figure_2": {"bin/hopf", "hopf/tau_of_epsilon.nc"},
    "figure_3": {"bin/hopf", "hopf/xi_of_epsilon.nc"},
    "figure_4": {"bin/trajectory", "trajectories/fixed_point.nc", "trajectories/oscillation.nc"},
    "figure_5": {"bin/trajectory", "bin/spectrum", *data_of("torus", "chaos")},
    "figure_6": {"bin/trajectory", "bin/spectrum", *data_of("oscillation", "torus")},
    "figure_7": {"bin/trajectory", "bin/spectrum", *data_of("chaos")},
    "figure_8": {"bin/velocity_step", "friction/velocity_step.nc"},
    "exponents": {
        "bin/exponents",
        *(f"exponents/{scene}.nc" for scene in SCENES),
    },
    "stability": {
        "bin/measure",
        "bin/reference",
        *(f"stability/{family}.nc" for family in FAMILIES),
    },
    "work_precision": {
        "bin/measure",
        "bin/reference",
        *(f"{study}/{name}.nc" for study in ("trust", "work_precision") for name in WORK_SCENES),
    },
    "atlas_coarse": {
        *("bin/attractors", "bin/hopf", "hopf/tau_of_epsilon.nc", "hopf/tau_of_epsilon_xi_08.nc"),
        *(f"{plane}/{part:04}.nc" for plane in PLANES for part in range(1, 5)),
    },
    "true_torus": {
        *("bin/attractors", "bin/trajectory", "bin/spectrum"),
        *data_of("torus", "true_torus"),
        *(f"scenes/{scene}.nc" for scene in ["fixed_point", *SCENES]),
    },
    "route_to_chaos": {"bin/attractors", "route/0001.nc", "route/0002.nc"},
}
"""Programs and data that figures need."""
OF_OTHERS = {"exponents", "attractors"}
"""Keys of a scene that are not for its trajectory."""

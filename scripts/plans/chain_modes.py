"""Where modes of a chain are unstable: Hopf curves of all modes over epsilon and tau."""

from scripts.namelists.chains import stiffness_of_modes
from scripts.results.paths import curves_of_modes


def inputs(config: dict) -> dict:
    """Hopf curves of each mode in each plane, mode by mode."""
    return {"curves": curves_of_modes(config)}


def params(config: dict) -> dict:
    """The planes, and the stiffness of each mode."""
    study = config["chain_modes"]
    return {
        "planes": list(study["planes"].values()),
        "stiffness": stiffness_of_modes(study),
        "chain": {key: study[key] for key in ("blocks", "kappa", "ends")},
    }

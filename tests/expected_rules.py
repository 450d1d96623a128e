"""Which rules, programs and data each figure needs."""

from conftest import ROOT

from scripts.config.read_config import read
from scripts.figures.entries import files_of


def settings(*path: str) -> dict:
    """A section of the config as it stands in the file."""
    section = read(ROOT / "config" / "config.yaml")
    for key in path:
        section = section[key]
    return section


CONFIG = settings()
FAMILIES = settings("stability", "families")
WORK_SCENES = [*settings("work_precision", "scenes"), *settings("work_precision", "cases")]
PLANES = settings("atlas", "planes")
LINES = settings("routes", "lines")
CYCLE_LINES = settings("cycles", "lines")
RUNS = [*settings("routes", "histories"), "up", "down"]
SCENES = ["oscillation", "torus", "chaos", "true_torus"]
"""Scenes that move."""
TRAJECTORY = {"build", "scene_namelist", "trajectory"}
ATTRACTORS = {"build", "attractors_namelist", "attractors_runs"}
RULES_FOR = {
    "hopf": {"build", "hopf_namelist", "hopf_curves"},
    "trajectories": TRAJECTORY,
    "spectra": {*TRAJECTORY, "spectrum_namelist", "spectrum"},
    "slip_events": {"build", "scene_namelist", "slip_events"},
    "friction": {"build", "velocity_step_namelist", "velocity_step"},
    "exponents": {"build", "exponents_namelist", "exponents_runs"},
    "attractors": ATTRACTORS,
    "cycles": {"build", "cycles_namelist", "cycles_runs"},
    "fault-limit.tsv": {"fault_limit_table"},
    "exponents.tsv": {"build", "exponents_namelist", "exponents_runs", "exponents_table"},
    "stability.tsv": {
        "build",
        "measurement_namelist",
        "reference_namelist",
        "reference",
        "measurement",
        "stability_table",
    },
    "work-precision.tsv": {
        "build",
        "measurement_namelist",
        "reference_namelist",
        "reference",
        "measurement",
        "trusted_horizons",
        "work_precision_namelist",
        "work_precision_runs",
        "work_precision_table",
    },
    "atlas.tsv": {*ATTRACTORS, "atlas_table"},
    "attractors.tsv": {*ATTRACTORS, "attractors_table"},
    **{f"{line}.tsv": {*ATTRACTORS, "route_table"} for line in LINES},
}
"""Rules that make a result: data by their folder, tables by their name."""
RULES_OF_ATTRACTORS = {*ATTRACTORS, "attractors_table", "route_table", "basins_table"}
"""Rules that the ledger needs besides."""
PROGRAMS_FOR = {
    "hopf": ["hopf"],
    "trajectories": ["trajectory"],
    "spectra": ["trajectory", "spectrum"],
    "slip_events": ["slip_events"],
    "friction": ["velocity_step"],
    "exponents": ["exponents"],
    "attractors": ["attractors"],
    "cycles": ["cycles"],
    "fault-limit.tsv": [],
    "exponents.tsv": ["exponents"],
    "stability.tsv": ["measure", "reference"],
    "work-precision.tsv": ["measure", "reference"],
    "atlas.tsv": ["attractors"],
    "attractors.tsv": ["attractors"],
    **{f"{line}.tsv": ["attractors"] for line in LINES},
}
"""Programs that make a result, named in the same way."""
DATA_OF_TABLES = {
    "fault-limit.tsv": set(),
    "exponents.tsv": {f"exponents/{scene}.nc" for scene in SCENES},
    "stability.tsv": {f"stability/{family}.nc" for family in FAMILIES},
    "work-precision.tsv": {
        f"{study}/{name}.nc" for study in ("trust", "work_precision") for name in WORK_SCENES
    },
    "atlas.tsv": {
        f"{plane}/{part:04}.nc"
        for plane in PLANES
        for part in range(1, settings("atlas", "parts") + 1)
    },
    "attractors.tsv": {f"scenes/{scene}.nc" for scene in ["fixed_point", *SCENES]},
    **{f"{line}.tsv": {f"{line}/{run}.nc" for run in RUNS} for line in LINES},
}
"""Data behind each table, by folder and name."""


def kind_of(path: str) -> str:
    """A table by its name, other results by their folder in results/."""
    _, folder, *_, name = path.split("/")
    return name if folder == "tables" else folder


def results_for(figure: str) -> list[str]:
    """Results that a figure needs; other solvers were measured before."""
    return [path for path in files_of(figure, CONFIG) if path != "benchmarks/measured.tsv"]


def expected_rules_of(figure: str) -> set[str]:
    """Rules that a figure needs besides its own."""
    return set().union(*(RULES_FOR[kind_of(path)] for path in results_for(figure)))


def expected_outputs_of(figure: str) -> set[str]:
    """Programs and data that a figure needs."""
    found = set()
    for path in results_for(figure):
        kind, ending = kind_of(path), "/".join(path.split("/")[-2:])
        found |= {f"bin/{program}" for program in PROGRAMS_FOR[kind]}
        found |= DATA_OF_TABLES.get(kind, {ending})
        if kind == "spectra":
            found.add(ending.replace("spectra", "trajectories"))
    return found


OF_OTHERS = {"exponents", "attractors"}
"""Keys of a scene that are not for its trajectory."""

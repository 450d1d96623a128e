"""Scenes of the benchmarks: those of work against precision, up to when they can be trusted."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scripts.config.check_config import checked
from scripts.config.read_config import read
from scripts.files.tsv import read_table
from scripts.namelists.study_cases import case_of, measured_study
from scripts.namelists.write_measured_scene import horizon_of
from scripts.tables.accuracy import Reference, distances, read_references

ROOT = Path(__file__).resolve().parent.parent
HORIZONS = ROOT / "results" / "tables" / "trusted-horizons.tsv"


@dataclass(frozen=True, kw_only=True)
class Scene:
    """Parameters, the constant past in theta, u, ln v, last and sample times; nondimensional."""

    name: str
    tau: float
    epsilon: float
    xi: float
    gamma: float
    past: tuple[float, float, float]
    t_end: float
    sample_interval: float

    def line(self) -> str:
        """The scene as its workers read it."""
        values = (self.tau, self.epsilon, self.xi, self.gamma, *self.past)
        return " ".join(f"{value:.17g}" for value in (*values, self.t_end, self.sample_interval))


def read_study() -> dict:
    """The study of work against precision of the project's configuration."""
    return measured_study(checked(read(ROOT / "config" / "config.yaml")))


def reference_path(name: str) -> Path:
    """Where the workflow puts a scene's reference."""
    return ROOT / "results" / "references" / "trust" / f"{name}.tsv"


def reference_of(scene: Scene) -> Reference:
    """The solution in quadruple precision."""
    return read_references(reference_path(scene.name))[scene.name]


def scene_of(study: dict, horizons: list[dict], name: str) -> Scene:
    """A scene of the study, up to the time in the table of horizons."""
    case = case_of(name, study["cases"][name])
    return Scene(
        name=name,
        **{key: float(case[key]) for key in ("tau", "epsilon", "xi", "gamma")},
        past=(float(case["theta"]), float(case["u"]), math.log(case["v"])),
        t_end=horizon_of(horizons, name),
        sample_interval=case["sample_interval"],
    )


def read_horizons() -> list[dict]:
    """Until when each scene can be trusted."""
    return read_table(HORIZONS)


def error_max(samples: np.ndarray, scene: Scene, reference: Reference) -> float:
    """Largest error over all samples, rows of t, theta, u, ln v; NaN where one is missing."""
    count = round(scene.t_end / scene.sample_interval) + 1
    times = reference.time[:count]
    if samples.shape != (count, 4) or not np.allclose(samples[:, 0], times, rtol=0, atol=1e-6):
        return math.nan
    return float(np.max(distances(samples[:, 1:].T, reference.state[:, :count])))

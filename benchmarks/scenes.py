"""Scenes of the benchmarks and the solutions that errors are measured against."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml

ROOT = Path(__file__).resolve().parent.parent
PAPER = ("fixed_point", "oscillation", "torus", "chaos")
"""Scenes of the paper; their parameters are those of config/config.yaml."""
HARD = {
    "stick": {"tau": 10.0, "epsilon": 0.9, "xi": 0.8, "gamma": 0.8},
    "stiff": {"tau": 1.0, "epsilon": 0.7, "xi": 0.5, "gamma": 1.0e6},
}
"""Scenes beyond the paper, with the paper's history."""
HISTORY = {"torus": {"theta": 0.0, "u": 0.0, "v": 1.5}}
"""Histories that differ from those of the configuration."""
T_END = {"chaos": 150.0, "stick": 200.0}
"""Last times of scenes that magnify errors, where no reference says how far it can be trusted."""
USUAL_T_END = 1000.0
"""Last time of the other scenes."""


class SceneError(ValueError):
    """What is wrong with a scene or its reference."""


@dataclass(frozen=True)
class Scene:
    """Parameters, the constant past in theta, u, ln v, and the last time; nondimensional."""

    name: str
    tau: float
    epsilon: float
    xi: float
    gamma: float
    past: tuple[float, float, float]
    t_end: float

    def line(self) -> str:
        """The scene as its workers read it."""
        values = (self.tau, self.epsilon, self.xi, self.gamma, *self.past, self.t_end)
        return " ".join(f"{value:.17g}" for value in values)


def scenes(config: dict, references: Path) -> dict[str, Scene]:
    """All scenes by name, each up to the end of its reference where there is one."""
    found = {}
    for name in (*PAPER, *HARD):
        values = HARD.get(name) or config["scenes"][name]
        usual = config["scenes"]["torus"]["history"]
        history = HISTORY.get(name) or values.get("history", usual)
        past = (history["theta"], history["u"], math.log(history["v"]))
        parameters = [float(values[key]) for key in ("tau", "epsilon", "xi", "gamma")]
        found[name] = Scene(name, *parameters, past, last_time(name, references))
    return found


def last_time(name: str, references: Path) -> float:
    """Last whole time of a scene's reference; without one a time that can be trusted."""
    path = references / f"{name}.tsv"
    if not path.exists():
        return T_END.get(name, USUAL_T_END)
    return float(math.floor(read_samples(path)[-1, 0] + 1e-9))


def read_config(path: Path = ROOT / "config" / "config.yaml") -> dict:
    """The project's configuration."""
    return yaml.safe_load(path.read_text())


def read_samples(path: Path) -> np.ndarray:
    """Rows of t, theta, u, ln v; lines of names and comments are left out."""
    rows = []
    for line in path.read_text().splitlines():
        fields = line.split("\t")
        if line.startswith("#") or fields[0] == "t":
            continue
        try:
            rows.append([float(field) for field in fields])
        except ValueError:
            raise SceneError(f"{path}: {line!r}; expected numbers") from None
    if not rows or {len(row) for row in rows} != {4}:
        raise SceneError(f"{path}: expected rows of t, theta, u, ln_v")
    return np.array(rows)


def read_reference(path: Path, scene: Scene) -> np.ndarray:
    """Samples of a reference at whole times up to the scene's end; it must be of this scene."""
    samples = read_samples(path)
    whole = np.abs(samples[:, 0] - np.round(samples[:, 0])) < 1e-9
    samples = samples[whole & (samples[:, 0] <= scene.t_end + 1e-9)]
    if len(samples) == 0 or not np.allclose(samples[0], (0.0, *scene.past), rtol=0, atol=1e-12):
        raise SceneError(f"{path}: does not begin with t = 0 and the past {scene.past}")
    return samples


def largest_difference(samples: np.ndarray, reference: np.ndarray) -> float:
    """Largest difference in theta, u, ln v over the times that both have; NaN if samples end early.

    Times are whole numbers, but for rounding.
    """
    at = {round(time): row for time, *row in samples.tolist() if math.isfinite(time)}
    found = np.array([at.get(round(time), [math.nan] * 3) for time in reference[:, 0]])
    return float(np.max(np.abs(found - reference[:, 1:])))

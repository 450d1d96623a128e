"""Scenes in SI: quantities of (2) with units, which pint reads, as the parameters of (4).

(2) holds per unit of area: stresses in Pa, k in Pa/m, M in kg/m^2.
"""

import functools
import math
import re
from collections.abc import Iterator

from snakemake.logging import logger

UNITS = {"a": "", "b": "", "sigma": "Pa", "D_c": "m", "v0": "m/s", "k": "Pa/m", "M": "kg/m^2"}
OF_SLAB = {"G": "Pa", "W": "m", "rho": "kg/m^3"}
"""Units of what stands under `si`; those of a slab in place of k and M."""
LEAST, MOST = 1e-30, 1e30
"""Bounds of these numbers, so that their products are neither zero nor infinite."""
USUAL = {
    **{"a": (1e-4, 1), "b": (1e-4, 1), "sigma": (1e3, 1e10), "D_c": (1e-8, 100), "v0": (1e-13, 10)},
    **{"k": (1e2, 1e15), "M": (1e-3, 1e10), "G": (1e3, 1e12), "W": (1e-4, 1e6), "rho": (1e2, 1e5)},
}
"""Wide ranges of faults and laboratories: what is outside is likely an error, as mPa for MPa."""
SCALED = {
    **dict.fromkeys(("tau", "t_end", "t_transient", "sample_interval"), "s"),
    **{"theta": "Pa", "u": "m", "v": "m/s"},
}
"""What else may have a unit in a scene in SI. Plain numbers are nondimensional."""
NUMBER, WORD = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", r"[a-zA-Zµμ]+(?:(?:\^|\*\*)-?\d)?"
QUANTITY = re.compile(rf"({NUMBER})\s*((?:{WORD}(?:\s*[*/ ]\s*{WORD})*)?)", re.ASCII)
"""pint multiplies powers out, so their exponents have one digit."""
LONGEST = 60
"""Letters of a quantity."""


@functools.cache
def _registry():
    """The units that pint knows; loading them takes a quarter of a second."""
    import pint

    return pint.UnitRegistry()


def convert(text: str, unit: str) -> float:
    """The number of a text such as `50 MPa` in a unit; NaN if it has none."""
    match = QUANTITY.fullmatch(text) if len(text) <= LONGEST else None
    try:
        quantity = _registry().Quantity(float(match[1]), match[2]) if match else math.nan
        return _rounded(quantity.to(unit).magnitude) if match else math.nan
    # pint's for unknown units and for other dimensions
    except (AttributeError, TypeError):
        return math.nan


def _rounded(value: float) -> float:
    """With twelve digits: 10 um are 1e-5 m, and not 9.999999999999999e-06 m."""
    return float(f"{value:.12g}")


def _read(si: dict) -> dict[str, float]:
    """Numbers in SI by the keys of the file."""
    return {key: convert(str(value), (UNITS | OF_SLAB)[key]) for key, value in si.items()}


def in_si(si: dict) -> dict[str, float]:
    """a, b, sigma, D_c, v0, k and M of a scene as numbers in SI.

    G, W and rho are a slab of thickness W, whose far side moves with the plate: by Hooke's law in
    shear k = G/W, and all of it moves with the block, M = rho W.
    """
    values = _read(si)
    if "G" in values:
        values |= {"k": values["G"] / values["W"], "M": values["rho"] * values["W"]}
    return {key: values[key] for key in UNITS}


def units_of(values: dict[str, float]) -> dict[str, float]:
    """The units of (4) in SI: A = a sigma of stress, L = D_c of length, v0, L/v0 of time."""
    length, velocity = values["D_c"], values["v0"]
    stress = values["a"] * values["sigma"]
    return {"Pa": stress, "m": length, "m/s": velocity, "s": length / velocity}


def parameters_of(values: dict[str, float]) -> dict[str, float]:
    """epsilon = (B - A)/A, xi = k L/A, gamma = sqrt(k/M) L/v0; A = a sigma, B = b sigma."""
    units = units_of(values)
    return {
        "epsilon": _rounded(values["b"] / values["a"] - 1),
        "xi": _rounded(values["k"] * units["m"] / units["Pa"]),
        "gamma": _rounded(math.sqrt(values["k"] / values["M"]) * units["s"]),
    }


def fill_in_parameters(config: dict, texts: list[tuple[str, str, str]]) -> Iterator[str]:
    """Give scenes in SI the parameters of (4), and numbers for texts with units; problems.

    Adds to `texts` for each of them its scene, `key = number`, and itself.
    """
    scenes = config.get("scenes")
    for name, scene in scenes.items() if isinstance(scenes, dict) else ():
        if not isinstance(scene, dict) or "si" not in scene:
            continue
        place = f"scene '{name}'"
        if problems := list(_problems(f"{place} si", scene["si"])):
            yield from problems
            continue
        for line in doubts(place, scene):
            logger.warning(line)
        values = in_si(scene["si"])
        for key, value in parameters_of(values).items():
            if (given := scene.setdefault(key, value)) != value:
                yield f"{place}: {key} = {given!r}; expected none beside si, which gives {value}"
        # copies: by an alias a section may be that of another scene, too
        sections = [key for key in ("history", "exponents") if isinstance(scene.get(key), dict)]
        scene |= {key: {**scene[key]} for key in sections}
        for part, where in ((scene, place), *((scene[key], f"{place} {key}") for key in sections)):
            for key in SCALED.keys() & part.keys():
                if isinstance(text := part[key], str):
                    part[key] = _rounded(convert(text, SCALED[key]) / units_of(values)[SCALED[key]])
                    texts.append((place, f"{key} = {part[key]!r}", text))
                    if math.isnan(part[key]):
                        expected = f"a finite number, alone or with a unit such as {SCALED[key]}"
                        yield f"{where}: {key} = {text!r}; expected {expected}"


def doubts(place: str, scene: dict) -> Iterator[str]:
    """What may be meant otherwise in a scene in SI, with its value in SI."""
    for key, value in _read(scene["si"]).items():
        least, most = USUAL[key]
        if not least <= value <= most:
            unit, met = (UNITS | OF_SLAB)[key], scene["si"][key]
            words = f"faults and laboratories have {least:g} to {most:g} {unit}".strip()
            yield f"{place} si: {key} = {met!r} is {f'{value:g} {unit}'.strip()}; {words}"
    if isinstance(tau := scene.get("tau"), int | float) and tau > 0:
        seconds = tau * units_of(in_si(scene["si"]))["s"]
        yield f"{place}: tau = {tau} has no unit: it is {tau} D_c/v0 = {seconds:g} s"


def _problems(place: str, si) -> Iterator[str]:
    """What is wrong under `si`."""
    with_slab = {*UNITS, *OF_SLAB} - {"k", "M"}
    if not isinstance(si, dict) or set(si) not in (set(UNITS), with_slab):
        given = f"keys {', '.join(map(str, si))}" if isinstance(si, dict) else repr(si)
        yield f"{place}: {given}; expected {', '.join(UNITS)}, or G, W and rho in place of k and M"
        return
    for key, value in _read(si).items():
        if not LEAST <= value <= MOST:
            expected = f"a number with its unit, in [{LEAST}, {MOST}] {(UNITS | OF_SLAB)[key]}"
            yield f"{place}: {key} = {si[key]!r}; expected {expected.strip()}"

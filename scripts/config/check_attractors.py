"""What the schema cannot see of attractors and cycles: keys that contradict each other."""

import math
from collections.abc import Iterator

from scripts.config.ranges import range_of
from scripts.namelists.attractor_surveys import part_of
from scripts.namelists.study_cases import PARAMETERS

LEAST_LN_V, LARGEST_LN_V = -700.0, 700.0
"""Between these exp(ln v) is a positive finite number."""
MOST_POINTS = 1_000_000
"""Points that one run of the program takes."""
MOST_SAMPLES = 100_000_000
"""Samples that it takes at a point."""
FEWEST_SAMPLES = 16
"""Samples of a segment of a spectrum."""


def contradictions(config: dict) -> Iterator[str]:
    """Problems of more than one key: of scenes' attractors, the atlas, routes, basins, cycles."""
    yield from _of_scenes(config)
    yield from _of_atlas(config["atlas"], config["spectra"])
    yield from _of_routes(config["routes"], config["spectra"])
    yield from _of_basins(config["basins"], config["spectra"])
    yield from _of_cycles(config["cycles"])


def _of_scenes(config: dict) -> Iterator[str]:
    """Attractors of scenes from several histories."""
    place = "config attractors"
    yield from _of_histories(f"{place} histories", config["attractors"]["histories"])
    observation = config["attractors"]["observation"]
    yield from _of_observation(f"{place} observation", observation, config["spectra"])


def _of_histories(place: str, ranges: dict) -> Iterator[str]:
    """Ranges of random histories."""
    for key in ("theta", "u"):
        yield from window(place, key, ranges[key])
    yield from window(place, "ln_v", ranges["ln_v"], least=LEAST_LN_V, most=LARGEST_LN_V)


def _of_atlas(atlas: dict, spectra: dict) -> Iterator[str]:
    """Planes of epsilon and tau, each divided by its delays."""
    place = "config atlas"
    yield from window(place, "epsilon_window", atlas["epsilon_window"], **range_of("epsilon"))
    for name, plane in atlas["planes"].items():
        inside = f"{place} planes {name}"
        yield from window(inside, "tau_window", plane["tau_window"], **range_of("tau"))
    yield from _of_parts(place, atlas)
    yield from _of_observation(f"{place} observation", atlas["observation"], spectra)


def _of_routes(routes: dict, spectra: dict) -> Iterator[str]:
    """Lines along one parameter, the other three fixed; a run is named by its history or sweep."""
    place = "config routes"
    for name in set(routes["histories"]) & {"up", "down"}:
        yield f"{place} histories: name {name!r}; expected another, this is the name of a sweep"
    yield from _of_observation(f"{place} observation", routes["observation"], spectra)
    for name, line in routes["lines"].items():
        yield from _of_line(f"{place} lines {name}", line)


def _of_line(inside: str, line: dict) -> Iterator[str]:
    """A line along one parameter, the other three fixed."""
    along = line["along"]
    yield from window(inside, "window", line["window"], **range_of(along))
    if along in line:
        yield f"{inside}: {along} = {line[along]}; expected no value, it is along {along}"
    missing = [key for key in PARAMETERS if key not in line and key != along]
    if missing:
        yield f"{inside}: key {missing} is missing"


def _of_cycles(cycles: dict) -> Iterator[str]:
    """Lines along which cycles are followed, and starts on them."""
    for key in ("epsilon", "tau") if "curves" in cycles else ():
        values = cycles["curves"][f"{key}_window"]
        yield from window("config cycles curves", f"{key}_window", values, **range_of(key))
    for name, line in cycles["lines"].items():
        inside = f"config cycles lines {name}"
        yield from _of_line(inside, line)
        low, high = line["window"]
        for start in line["starts"]:
            if not low <= start <= high:
                yield f"{inside}: starts = {start}; expected a number in {line['window']}"


def _of_basins(basins: dict, spectra: dict) -> Iterator[str]:
    """Random histories at several places."""
    place = "config basins"
    yield from _of_histories(f"{place} histories", basins["histories"])
    yield from _of_observation(f"{place} observation", basins["observation"], spectra)


def window(
    place: str,
    key: str,
    values: list[float],
    *,
    above: float = -math.inf,
    least: float = -math.inf,
    most: float = math.inf,
) -> Iterator[str]:
    """Two ascending numbers inside a range, not so far apart that their distance is infinite."""
    low, high = values
    if above < low < high <= most and low >= least and math.isfinite(high - low):
        return
    bounds = [
        f" {sign} {bound}"
        for sign, bound in ((">", above), (">=", least), ("<=", most))
        if math.isfinite(bound)
    ]
    yield f"{place}: {key} = {values}; expected two ascending numbers{' and'.join(bounds)}"


def _of_parts(place: str, atlas: dict) -> Iterator[str]:
    """Parts of a plane, each a run over some of its delays."""
    delays, parts = atlas["tau_count"], atlas["parts"]
    if parts > delays:
        yield (
            f"{place}: parts = {parts}; expected a whole number >= 1 and <= tau_count = {delays}"
        )
        return
    refinements, columns = atlas["refinements"], atlas["epsilon_count"]
    if refinements > 0 and min(delays, columns) == 1:
        yield (
            f"{place}: refinements = {refinements}; expected 0 for one line,"
            f" epsilon_count = {columns}, tau_count = {delays}"
        )
    ends = (part_of(delays, parts, part, 2**refinements) for part in range(1, parts + 1))
    points = columns * max(last - first + 1 for first, last in ends)
    if points > MOST_POINTS:
        yield f"{place}: parts = {parts} of {points} points; expected at most {MOST_POINTS} in each"


def _of_observation(place: str, observation: dict, spectra: dict) -> Iterator[str]:
    """Samples between the beginning and the end, enough for a spectrum and not too many."""
    interval, length = observation["sample_interval"], observation["t_observed"]
    samples = length / interval
    segments = 1 + (spectra["segments"] - 1) * (1 - spectra["overlap"])
    if interval > length:
        yield (
            f"{place}: sample_interval = {interval}; expected a finite number > 0 and <="
            f" t_observed = {length}"
        )
    elif not samples <= MOST_SAMPLES:
        yield (
            f"{place}: sample_interval = {interval}; expected at most {MOST_SAMPLES} samples in"
            f" t_observed = {length}"
        )
    elif math.floor((math.floor(samples) + 1) / segments) < FEWEST_SAMPLES:
        yield (
            f"{place}: sample_interval = {interval}; expected at least {FEWEST_SAMPLES} samples in"
            f" each of {spectra['segments']} segments of t_observed = {length}"
        )

"""What the schema cannot see of attractors and cycles: keys that contradict each other."""

import math
from collections.abc import Iterable, Iterator

from scripts.config.ranges import range_of
from scripts.namelists.attractor_surveys import part_of, refinements_of
from scripts.namelists.laws import definitions, own_parameters
from scripts.namelists.study_cases import HISTORY, PARAMETERS

LEAST_LN_V, LARGEST_LN_V = -700.0, 700.0
"""Between these exp(ln v) is a positive finite number."""
MOST_POINTS = 1_000_000
"""Points that one run of the program takes."""
MOST_SAMPLES = 100_000_000
"""Samples of a run, or at a point: their spectrum takes 3 GB of memory."""
FEWEST_SAMPLES = 16
"""Samples of a segment of a spectrum."""


def wrong(place: str, values: dict, key: str, expected: str) -> str:
    """A problem of one value as a line."""
    return f"{place}: {key} = {values[key]!r}; expected {expected}"


def check_samples(place: str, run: dict, series: int = 1, length: str = "t_end") -> Iterator[str]:
    """Samples farther apart than the run is long, or too many where several series are held."""
    end, most = run[length], MOST_SAMPLES // series
    if not end / most <= run["sample_interval"] <= end:
        expected = f"a finite number >= {end / most} ({most} samples) and <= {length} = {end}"
        yield wrong(place, run, "sample_interval", expected)


def contradictions(config: dict) -> Iterator[str]:
    """Problems of more than one key: of scenes' attractors, the atlas, routes, basins, cycles."""
    for section in ("attractors", "basins"):
        place, ranges = f"config {section} histories", config[section]["histories"]
        for key in ("theta", "u"):
            yield from window(place, key, ranges[key])
        yield from window(place, "ln_v", ranges["ln_v"], least=LEAST_LN_V, most=LARGEST_LN_V)
    for section in ("attractors", "atlas", "friction_laws", "routes", "basins"):
        observation = config[section]["observation"]
        yield from _check_samples(f"config {section} observation", observation, config["spectra"])
    yield from _check_atlas("config atlas", config)
    yield from _check_laws("config friction_laws", config["friction_laws"], config)
    for name in set(config["routes"]["histories"]) & {"up", "down"}:
        yield (
            f"config routes histories: name {name!r}; expected another, this is the name of a sweep"
        )
    for section in ("routes", "cycles"):
        for name, line in config[section]["lines"].items():
            own = own_parameters(config, line["law"])
            others = HISTORY if section == "routes" else []
            yield from _check_line(f"config {section} lines {name}", line, own, others)
    for key in ("epsilon", "tau") if "curves" in config["cycles"] else ():
        values = config["cycles"]["curves"][f"{key}_window"]
        yield from window("config cycles curves", f"{key}_window", values, **range_of(key))


def _check_atlas(place: str, config: dict) -> Iterator[str]:
    """Planes, each divided by its ordinate into parts, which are runs."""
    atlas = config["atlas"]
    yield from window(place, "epsilon_window", atlas["epsilon_window"], **range_of("epsilon"))
    for name, plane in atlas["planes"].items():
        own = own_parameters(config, plane["law"])
        yield from check_axis(f"{place} planes {name}", plane, "ordinate", own, "epsilon")
    delays, parts = atlas["ordinate_count"], atlas["parts"]
    if parts > delays:
        yield wrong(place, atlas, "parts", f"a whole number >= 1 and <= ordinate_count = {delays}")
        return
    distance = 2 ** refinements_of(atlas)
    ends = (part_of(delays, parts, part, distance) for part in range(1, parts + 1))
    points = atlas["epsilon_count"] * max(last - first + 1 for first, last in ends)
    if points > MOST_POINTS:
        yield f"{place}: parts = {parts} of {points} points; expected at most {MOST_POINTS} in each"


def _check_laws(place: str, study: dict, config: dict) -> Iterator[str]:
    """Laws without parameters of their own; planes and scenes by different names."""
    yield from window(place, "epsilon_window", study["epsilon_window"], **range_of("epsilon"))
    for name, plane in study["planes"].items():
        yield from window(
            f"{place} planes {name}", "tau_window", plane["tau_window"], **range_of("tau")
        )
    bare = [law for law in definitions(config) if not own_parameters(config, law)]
    for law in study["laws"]:
        if law not in bare:
            yield f"{place} laws: {law!r}; expected some of: {', '.join(bare)}"
    for scene in study["scenes"]:
        if scene not in config["scenes"]:
            yield f"{place} scenes: {scene!r}; expected some of: {', '.join(config['scenes'])}"
    for name in set(study["planes"]) & set(config["scenes"]):
        yield f"{place} planes: {name!r}; expected a name that no scene has"


def check_axis(
    place: str, entry: dict, key: str, own: dict, abscissa: str = "", others: Iterable[str] = ()
) -> Iterator[str]:
    """A parameter, of the block or the law's own, that varies in a window; the rest are fixed.

    Beside parameters it may be one of `others`. A plane has an abscissa, too.
    """
    along, name = entry[key], f"{key}_window" if abscissa else "window"
    known = [one for one in (*PARAMETERS, *own, *others) if one != abscissa]
    if along not in known:
        yield wrong(place, entry, key, f"one of: {', '.join(known)}")
        return
    yield from window(place, name, entry[name], **range_of(along, own))
    if along in entry:
        yield wrong(place, entry, along, f"no value, it is {key} {along}")
    missing = [one for one in PARAMETERS if one not in {*entry, along, abscissa}]
    if missing:
        yield f"{place}: key {missing} is missing"


def _check_line(inside: str, line: dict, own: dict, others: Iterable[str]) -> Iterator[str]:
    """A line along one parameter; starts on it, of cycles."""
    yield from check_axis(inside, line, "along", own, others=others)
    low, high = line["window"]
    for start in line.get("starts", []):
        if not low <= start <= high:
            yield f"{inside}: starts = {start}; expected a number in {line['window']}"


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


def _check_samples(place: str, observation: dict, spectra: dict) -> Iterator[str]:
    """Samples between the beginning and the end, enough for a spectrum and not too many."""
    interval, length = observation["sample_interval"], observation["t_observed"]
    segments = 1 + (spectra["segments"] - 1) * (1 - spectra["overlap"])
    problems = list(check_samples(place, observation, length="t_observed"))
    if not problems and (math.floor(length / interval) + 1) / segments < FEWEST_SAMPLES:
        expected = (
            f"at least {FEWEST_SAMPLES} samples in each of {spectra['segments']} segments of"
            f" t_observed = {length}"
        )
        problems = [wrong(place, observation, "sample_interval", expected)]
    yield from problems

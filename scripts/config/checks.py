"""Checks that the studies share, of keys that may contradict each other."""

import math
from collections.abc import Iterable, Iterator

from scripts.config.ranges import range_of
from scripts.namelists.laws import PREFIX
from scripts.namelists.parameters import PARAMETERS

LEAST_LN_V, LARGEST_LN_V = -700.0, 700.0
"""Between these exp(ln v) is a positive finite number."""
MOST_SAMPLES = 100_000_000
"""Samples of a run, or at a point: their spectrum takes 3 GB of memory."""
FEWEST_SAMPLES = 16
"""Samples of a segment of a spectrum."""
LEAST_RING = 3
"""Blocks of the smallest ring."""


def wrong(place: str, values: dict, key: str, expected: str) -> str:
    """A problem of one value as a line."""
    return f"{place}: {key} = {values[key]!r}; expected {expected}"


def check_samples(place: str, run: dict, series: int = 1, length: str = "t_end") -> Iterator[str]:
    """Samples farther apart than the run is long, or too many where several series are held."""
    end, most = run[length], MOST_SAMPLES // series
    if not end / most <= run["sample_interval"] <= end:
        expected = f"a finite number >= {end / most} ({most} samples) and <= {length} = {end}"
        yield wrong(place, run, "sample_interval", expected)


def check_histories(place: str, ranges: dict) -> Iterator[str]:
    """Ranges from which histories are drawn."""
    for key in ("theta", "u"):
        yield from window(place, key, ranges[key])
    yield from window(place, "ln_v", ranges["ln_v"], least=LEAST_LN_V, most=LARGEST_LN_V)


def check_observation(place: str, observation: dict, spectra: dict) -> Iterator[str]:
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


def check_line(inside: str, line: dict, own: dict, others: Iterable[str] = ()) -> Iterator[str]:
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


def check_blocks(place: str, scene: dict) -> Iterator[str]:
    """Keys of a scene that do not fit its number of blocks."""
    yield from check_ends(place, scene)
    blocks = scene["blocks"]
    for key, value in scene["history"].items():
        if isinstance(value, list) and (blocks == 1 or len(value) != blocks):
            expected = "one number" + f", or {blocks}, one for each block" * (blocks > 1)
            yield f"{place} history: {key} has {len(value)} numbers; expected {expected}"
    if scene["disturbance"]["block"] > blocks:
        expected = f"a whole number >= 0 and <= blocks = {blocks}"
        yield wrong(f"{place} disturbance", scene["disturbance"], "block", expected)
    if blocks == 1 and scene["kappa"] != 0:
        yield wrong(place, scene, "kappa", "0 with blocks = 1")
    if blocks > 1 and scene["law"].startswith(PREFIX):
        yield wrong(place, scene, "law", "a law with inertia, which chains have")


def check_ends(place: str, chain: dict) -> Iterator[str]:
    """A ring that is too short."""
    if chain["ends"] == "ring" and chain["blocks"] < LEAST_RING:
        yield wrong(place, chain, "blocks", f"a whole number >= {LEAST_RING} with ends = ring")


def check_scenes(
    place: str, names: Iterable[str], scenes: dict, *, chains: bool = False
) -> Iterator[str]:
    """Names of no scene of one block, or of no chain where these are expected."""
    known = [name for name, scene in scenes.items() if (scene["blocks"] > 1) == chains]
    for name in names:
        if name not in known:
            yield f"{place}: {name!r}; expected one of: {', '.join(known)}"


def check_reference(place: str, reference: dict) -> Iterator[str]:
    """A check of the reference that is not less exact than the reference."""
    if reference["check_tolerance"] <= reference["tolerance"]:
        expected = f"a finite number > tolerance = {reference['tolerance']}"
        yield wrong(place, reference, "check_tolerance", expected)

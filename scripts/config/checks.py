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


def check_chain(place: str, chain: dict) -> Iterator[str]:
    """Problems of one chain."""
    yield from check_ends(place, chain)
    blocks, t_end = chain["blocks"], chain["t_end"]
    for key, value in chain["history"].items():
        if isinstance(value, list) and len(value) != blocks:
            yield (
                f"{place} history: {key} has {len(value)} numbers; expected one number, or"
                f" {blocks}, one for each block"
            )
    if chain["disturbance"]["block"] > blocks:
        expected = f"a whole number >= 0 and <= blocks = {blocks}"
        yield wrong(f"{place} disturbance", chain["disturbance"], "block", expected)
    if chain["t_transient"] >= t_end:
        yield wrong(place, chain, "t_transient", f"a finite number >= 0 and < t_end = {t_end}")
    yield from check_samples(place, chain, blocks)
    if chain["law"].startswith(PREFIX):
        yield wrong(place, chain, "law", "a law with inertia, which chains have")


def check_ends(place: str, chain: dict) -> Iterator[str]:
    """A ring that is too short."""
    if chain["ends"] == "ring" and chain["blocks"] < LEAST_RING:
        yield wrong(place, chain, "blocks", f"a whole number >= {LEAST_RING} with ends = ring")


def check_scenes_of_chains(place: str, study: dict, scenes: dict) -> Iterator[str]:
    """Scenes that are not there, or whose law chains have not."""
    for name in study["scenes"]:
        if name not in scenes:
            yield f"{place} scenes: {name!r}; expected one of: {', '.join(scenes)}"
        elif scenes[name]["law"].startswith(PREFIX):
            law = scenes[name]["law"]
            yield f"{place} scenes: {name!r} has the law {law}; chains have no such law"


def check_reference(place: str, reference: dict) -> Iterator[str]:
    """A check of the reference that is not less exact than the reference."""
    if reference["check_tolerance"] <= reference["tolerance"]:
        expected = f"a finite number > tolerance = {reference['tolerance']}"
        yield wrong(place, reference, "check_tolerance", expected)

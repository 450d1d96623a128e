"""Checks that the studies share, of keys that may contradict each other."""

import math
from collections.abc import Callable, Iterable, Iterator

from generator.ranges import expected_of, is_inside, range_of
from scripts.models.models import ALONE, HISTORY, model_of
from scripts.plans.scenes import is_block

LEAST_LN_V, LARGEST_LN_V = -700.0, 700.0
"""Between these exp(ln v) is a positive finite number."""
MOST_SAMPLES = 100_000_000
"""Samples of a run, or at a point: their spectrum takes 3 GB of memory."""
FEWEST_SAMPLES = 16
"""Samples of a segment of a spectrum."""
LEAST_RING = 3
"""Blocks of the smallest ring."""


def place_of(path: tuple[str, ...] | list[str]) -> str:
    """Where a key stands, for people."""
    if len(path) >= 2 and path[0] == "scenes":
        return " ".join([f"scene '{path[1]}'", *path[2:]])
    return " ".join(["config", *path])


def wrong(place: str, values: dict, key: str, expected: str) -> str:
    """A problem of one value as a line."""
    return f"{place}: {key} = {values[key]!r}; expected {expected}"


def check_samples(place: str, run: dict, series: int = 1, length: str = "t_end") -> Iterator[str]:
    """Samples farther apart than the run is long, or too many where several series are held."""
    end, most = run[length], MOST_SAMPLES // series
    if not end / most <= run["sample_interval"] <= end:
        expected = f"a finite number >= {end / most} ({most} samples) and <= {length} = {end}"
        yield wrong(place, run, "sample_interval", expected)


def check_values(place: str, values: dict, rules: dict[str, dict]) -> Iterator[str]:
    """Values by name, each a number or a list of them; sets defaults and the order of the names."""
    if unknown := sorted(set(values) - set(rules)):
        yield f"{place}: unknown key {unknown}; allowed: {', '.join(rules)}"
    for key, of_key in rules.items():
        if key not in values and "default" in of_key:
            values[key] = of_key["default"]
        if key not in values:
            yield f"{place}: key [{key!r}] is missing"
        value = values.pop(key, [])
        if value != []:
            values[key] = value
        for one in value if isinstance(value, list) else [value]:
            if not is_inside(one, of_key):
                yield wrong(place, {key: one}, key, expected_of(key, of_key))


def check_own_history(config: dict, place: str, entry: dict, key: str = "history") -> Iterator[str]:
    """A model of a user's own without its history: that of the section is the block's."""
    model = model_of(config, entry)
    if key not in entry and not model.is_block:
        states = ", ".join(model.history)
        yield f"{place}: key [{key!r}] is missing: {states} of the model {entry['law']}"


def check_rest(config: dict, place: str, entry: dict) -> Iterator[str]:
    """A model without the state at rest at which roots, Hopf points and cycles begin."""
    if not model_of(config, entry).has_rest:
        expected = "a model with steady_state: Hopf points and cycles begin there"
        yield f"{place}: model = {entry['law']!r}; expected {expected}"


def check_not_driven(config: dict, place: str, entry: dict) -> Iterator[str]:
    """A model with t in its equations, of whose motions there are no classes."""
    if model_of(config, entry).is_driven:
        expected = "a model without t in its equations: classes of motion are of these"
        yield f"{place}: model = {entry['law']!r}; expected {expected}"
    yield from check_smooth(config, place, entry)


def check_smooth(config: dict, place: str, entry: dict) -> Iterator[str]:
    """A model of whose motions there are no exponents, since disturbances jump."""
    if term := model_of(config, entry).switch:
        yield f"{place}: model = {entry['law']!r}; expected a smooth model, without {term}"
    yield from check_constant_delays(config, place, entry)


def check_constant_delays(config: dict, place: str, entry: dict) -> Iterator[str]:
    """A model with delays that move, for which a study needs constant ones."""
    if delay := model_of(config, entry).moving_delay:
        yield f"{place}: model = {entry['law']!r}; expected constant delays, not {delay}"


def check_histories(place: str, ranges: dict, rules: dict[str, dict] = HISTORY) -> Iterator[str]:
    """Ranges from which histories are drawn, of a value or of its logarithm."""
    known = {*rules, *(f"ln_{key}" for key in rules)}
    if unknown := sorted(set(ranges) - known - {"seed"}):
        yield f"{place}: unknown key {unknown}; allowed: seed, {', '.join(sorted(known))}"
    for key, of_key in rules.items():
        given = [name for name in (key, f"ln_{key}") if name in ranges]
        if not given:
            yield f"{place}: key [{key!r}] is missing"
        elif given[0] == key:
            yield from window(place, key, ranges[key], **range_of(of_key))
        else:
            bounds = {"least": LEAST_LN_V, "most": LARGEST_LN_V}
            yield from window(place, given[0], ranges[given[0]], **bounds)


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


def check_axis(place: str, entry: dict, key: str, known: dict[str, dict]) -> Iterator[str]:
    """What varies in a window, of what is known by name: it has no value beside it."""
    along, name = entry[key], "window" if key == "along" else f"{key}_window"
    if along not in known:
        yield wrong(place, entry, key, f"one of: {', '.join(known)}")
        return
    if name in entry:
        yield from window(place, name, entry[name], **range_of(known[along]))
    if along in entry:
        yield wrong(place, entry, along, f"no value, it is {key} {along}")


def check_plane(config: dict, place: str, plane: dict) -> Iterator[str]:
    """The axes of a plane, two parameters of its model."""
    known = model_of(config, plane).parameters
    yield from check_axis(place, plane, "abscissa", known)
    others = {name: rules for name, rules in known.items() if name != plane["abscissa"]}
    yield from check_axis(place, plane, "ordinate", others)


def check_line(config: dict, inside: str, line: dict, *, histories: bool = False) -> Iterator[str]:
    """A line along a parameter, or a value of the history; starts on it, of cycles."""
    model = model_of(config, line)
    more = model.history if histories else {}
    yield from check_axis(inside, line, "along", {**model.parameters, **more})
    yield from check_own_history(config, inside, line)
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


def check_blocks(config: dict, place: str, scene: dict) -> Iterator[str]:
    """Keys of a scene that do not fit its model or its number of blocks."""
    yield from check_ends(place, scene)
    blocks, disturbance, model = scene["blocks"], scene["disturbance"], model_of(config, scene)
    kind = "node" if model.network else "block"
    known = [name for key in model.history for name in (key, f"ln_{key}")]
    if unknown := sorted(set(disturbance) - {*known, "seed", "block"}):
        allowed = ", ".join(["seed", "block", *known])
        yield f"{place} disturbance: unknown key {unknown}; allowed: {allowed}"
    for key, value in scene["history"].items():
        if isinstance(value, list) and (blocks == 1 or len(value) != blocks):
            expected = "one number" + f", or {blocks}, one for each {kind}" * (blocks > 1)
            yield f"{place} history: {key} has {len(value)} numbers; expected {expected}"
    if disturbance["block"] > blocks:
        expected = f"a whole number >= 0 and <= blocks = {blocks}"
        yield wrong(f"{place} disturbance", disturbance, "block", expected)
    if blocks == 1 and model.is_block and scene["kappa"] != 0:
        yield wrong(place, scene, "kappa", "0 with blocks = 1")
    if blocks > 1 and not model.network:
        yield from check_coupled(config, place, scene)


def check_coupled(config: dict, place: str, entry: dict) -> Iterator[str]:
    """A model of which there are no chains."""
    if model_of(config, entry).kind != ALONE:
        yield wrong(place, entry, "law", "a law with inertia, which chains have")


def check_ends(place: str, chain: dict) -> Iterator[str]:
    """A ring that is too short."""
    if chain["ends"] == "ring" and chain["blocks"] < LEAST_RING:
        yield wrong(place, chain, "blocks", f"a whole number >= {LEAST_RING} with ends = ring")


def check_scenes(
    config: dict, place: str, names: Iterable[str], *, kind: Callable[[dict, str], bool] = is_block
) -> Iterator[str]:
    """Names of no scene of a kind, by default of one block."""
    known = [name for name in config["scenes"] if kind(config, name)]
    for name in names:
        if name not in known:
            yield f"{place}: {name!r}; expected one of: {', '.join(known)}"


def check_reference(place: str, reference: dict) -> Iterator[str]:
    """A check of the reference that is not less exact than the reference."""
    if reference["check_tolerance"] <= reference["tolerance"]:
        expected = f"a finite number > tolerance = {reference['tolerance']}"
        yield wrong(place, reference, "check_tolerance", expected)

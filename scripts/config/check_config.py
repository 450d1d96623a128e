"""Check a configuration against its schema, in words, and fill in the defaults."""

import copy
import math
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import jsonschema

from scripts.config import check_attractors
from scripts.config.ranges import SCHEMA, range_of, rules_of
from scripts.config.read_config import ConfigError, parse
from scripts.namelists.study_cases import cases_of_family, number_of_cases

EQUATIONS = 3
"""Equations of the block: exponents that it has without delay."""
MOST_CASES = 1000
"""Cases that one namelist holds."""
LONGEST_NAME = 64
"""Letters of a case's name."""
SIGNS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
"""Bounds of numbers in the schema, as messages write them."""
LONG = 1e4
"""Time after which a decaying case counts as stationary."""


def checked(config: dict) -> dict:
    """Return `config` with its defaults; raise ConfigError naming place, key, value and range."""
    problems = [in_words(error) for error in validator_of(SCHEMA).iter_errors(config)]
    if not problems:
        _fill_in_ends_of_exponents(config)
        problems = list(_contradictions(config))
    if problems:
        raise ConfigError("\n".join(["the configuration is refused:", *sorted(set(problems))]))
    return config


@cache
def validator_of(schema: Path):
    """The validator of a file with a schema."""
    return validator_for(rules_of(schema))


def validator_for(rules: dict):
    """A validator for which NaN and infinity are no numbers and which sets missing keys."""
    base = jsonschema.Draft202012Validator

    def is_finite_number(_, value):
        return _is_finite_number(value)

    def is_whole_number(_, value):
        return isinstance(value, int) and not isinstance(value, bool)

    def fill_then_check(validator, properties, instance, subschema):
        if validator.is_type(instance, "object"):
            for key, rules in properties.items():
                if "default" in rules:
                    instance.setdefault(key, copy.deepcopy(rules["default"]))
        yield from base.VALIDATORS["properties"](validator, properties, instance, subschema)

    types = base.TYPE_CHECKER.redefine_many(
        {"number": is_finite_number, "integer": is_whole_number}
    )
    extended = jsonschema.validators.extend(
        base, {"properties": fill_then_check}, type_checker=types
    )
    return extended(rules)


def _is_finite_number(value) -> bool:
    """Whether it is a number that a double can hold."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def in_words(error: jsonschema.ValidationError) -> str:
    """One problem as a line: place, key, value met, what is allowed."""
    path = [str(part) for part in error.absolute_path]
    if error.validator == "additionalProperties" and isinstance(error.instance, dict):
        known = list(error.schema.get("properties", {}))
        unknown = sorted(set(error.instance) - set(known), key=str)
        meant = {near for key in unknown for near in get_close_matches(str(key), known, n=1)}
        hint = f" (is it meant to be {' and '.join(map(repr, sorted(meant)))}?)" if meant else ""
        return f"{_place(path)}: unknown key {unknown}; allowed: {', '.join(known)}{hint}"
    if error.validator == "required":
        missing = [key for key in error.validator_value if key not in error.instance]
        return f"{_place(path)}: key {missing} is missing"
    if error.validator == "type" and "propertyNames" in error.absolute_schema_path:
        return f"{_place(path)}: name {error.instance!r}; expected text (quote it)"
    if "propertyNames" in error.absolute_schema_path:
        return (
            f"{_place(path)}: name {error.instance!r}; expected small letters, digits and"
            " underscores, a letter first, at most 64, and not 20 equal parts at the end"
        )
    known = filter(None, [error.schema.get("description"), range_in_words(error.schema)])
    expected = ", ".join(known) or "keys with values below it"
    return _value_in_words(path, error.instance, expected)


def range_in_words(rules: dict) -> str:
    """The values that a number or a word may have; empty if the description has them."""
    described = rules.get("description", "")
    if any(words in described for words in ("finite number", "whole number", "one of:")):
        return ""
    if "enum" in rules:
        return f"one of: {', '.join(rules['enum'])}"
    kind = {"number": "a finite number", "integer": "a whole number"}.get(rules.get("type"), "")
    bounds = [f"{sign} {rules[key]}" for key, sign in SIGNS.items() if key in rules]
    return f"{kind} {' and '.join(bounds)}".strip()


def _value_in_words(path: list[str], value, expected: str) -> str:
    line = f"{_place(path[:-1])}: {path[-1] if path else 'value'} = {value!r}; expected {expected}"
    if isinstance(value, str) and _is_number(value):
        line += f" (this is text; write {value} without quotes for the number)"
    return line


def _is_number(text: str) -> bool:
    """Whether a text would be a finite number without quotes."""
    try:
        return _is_finite_number(parse(text))
    except ConfigError:
        return False


def _place(path: list[str]) -> str:
    """Where a key stands, for people."""
    if len(path) >= 2 and path[0] == "scenes":
        return " ".join([f"scene '{path[1]}'", *path[2:]])
    return " ".join(["config", *path])


def _fill_in_ends_of_exponents(config: dict) -> None:
    """Exponents are measured up to the end of their scene where nothing else is given."""
    for scene in config["scenes"].values():
        if "exponents" in scene:
            scene["exponents"].setdefault("count", config["exponents"]["count"])
            scene["exponents"].setdefault("t_end", scene["t_end"])


def _contradictions(config: dict):
    """Problems that involve more than one key."""
    for name, scene in config["scenes"].items():
        place = f"scene '{name}'"
        if scene["t_transient"] >= scene["t_end"]:
            yield (
                f"{place}: t_transient = {scene['t_transient']}; expected a finite number >= 0"
                f" and < t_end = {scene['t_end']}"
            )
        if scene["sample_interval"] > scene["t_end"]:
            yield (
                f"{place}: sample_interval = {scene['sample_interval']}; expected a finite number"
                f" > 0 and <= t_end = {scene['t_end']}"
            )
        yield from _contradictions_of_exponents(place, scene)
    for figure, settings in config["figures"].items():
        for row, shown in settings["rows"].items():
            if shown["scene"] not in config["scenes"]:
                place = f"config figures {figure} rows {row}"
                yield (
                    f"{place}: scene = {shown['scene']!r}; expected one of:"
                    f" {', '.join(config['scenes'])}"
                )
    yield from _contradictions_of_sections(config)
    for name, plane in config["hopf_curves"].items():
        place = f"config hopf_curves {name}"
        for axis, parameter in (("epsilon", "epsilon"), ("ordinate", plane["ordinate"])):
            window = plane[f"{axis}_window"]
            yield from check_attractors.window(
                place, f"{axis}_window", window, **range_of(parameter)
            )
        if plane["epsilon_window"][1] <= 0:
            yield f"{place}: epsilon_window = {plane['epsilon_window']}; expected an end > 0"
        if plane["ordinate"] == "tau" and plane["fixed"] <= 0:
            yield f"{place}: fixed (xi) = {plane['fixed']}; expected a finite number > 0"
    yield from _contradictions_of_studies(config)
    yield from check_attractors.contradictions(config)


def _contradictions_of_sections(config: dict):
    """Problems of figures that show maxima and points of sections."""
    for row, shown in config["figures"]["true_torus"]["rows"].items():
        scene = config["scenes"].get(shown["scene"])
        if scene is not None and "attractors" not in scene:
            yield (
                f"config figures true_torus rows {row}: scene = {shown['scene']!r}; expected a"
                " scene with the key attractors"
            )
    for survey in ("attractors", "routes"):
        if config[survey]["observation"]["kept"] == 0:
            yield f"config {survey} observation: kept = 0; expected a whole number >= 1"


def _contradictions_of_exponents(place: str, scene: dict):
    """Problems of the exponents of a scene."""
    wanted = scene.get("exponents")
    if wanted and scene["tau"] == 0 and wanted["count"] > EQUATIONS:
        yield (
            f"{place} exponents: count = {wanted['count']}; expected a whole number >= 2 and"
            f" <= {EQUATIONS} without delay"
        )
    if wanted and wanted["t_end"] <= max(scene["t_transient"], scene["tau"]):
        yield (
            f"{place} exponents: t_end = {wanted['t_end']}; expected a finite number >"
            f" t_transient = {scene['t_transient']} and > tau = {scene['tau']}"
        )


def _contradictions_of_studies(config: dict):
    """Problems of stability and work against precision."""
    for study in ("stability", "work_precision"):
        reference = config[study]["reference"]
        if reference["check_tolerance"] <= reference["tolerance"]:
            yield (
                f"config {study} reference: check_tolerance = {reference['check_tolerance']};"
                f" expected a finite number > tolerance = {reference['tolerance']}"
            )
    for name, family in config["stability"]["families"].items():
        count = number_of_cases(family)
        if count > MOST_CASES:
            yield (
                f"config stability families {name}: {count} combinations; expected at most"
                f" {MOST_CASES}"
            )
            continue
        cases = cases_of_family(name, family)
        longest = max((case["name"] for case in cases), key=len)
        if len(longest) > LONGEST_NAME:
            yield (
                f"config stability families {name}: case '{longest}' of {len(longest)} letters;"
                f" expected at most {LONGEST_NAME} (shorten the family's name)"
            )
        if family["reference"] == "stationary" and family["t_end"] < LONG:
            yield (
                f"config stability families {name}: t_end = {family['t_end']}; expected a finite"
                f" number >= {LONG} where the reference is the stationary state"
            )
    yield from _contradictions_of_measured(config["work_precision"], config["scenes"])


def _contradictions_of_measured(study: dict, scenes: dict):
    """Names that mean nothing or two things, and samples farther apart than the run is long."""
    for name in study["scenes"]:
        if name not in scenes:
            yield (
                f"config work_precision scenes: {name!r}; expected one of: {', '.join(scenes)} (or"
                " a case with its parameters under work_precision cases)"
            )
    for name in study["cases"]:
        if name in scenes:
            yield (
                f"config work_precision cases: {name!r}; expected a name that no scene has (or the"
                " scene under work_precision scenes)"
            )
    for kind in ("scenes", "cases"):
        for name, case in study[kind].items():
            if case["sample_interval"] > case["t_end"]:
                yield (
                    f"config work_precision {kind} {name}: sample_interval ="
                    f" {case['sample_interval']}; expected a finite number > 0 and <= t_end ="
                    f" {case['t_end']}"
                )

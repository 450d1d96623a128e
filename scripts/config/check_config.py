"""Check a configuration against its schema, in words, and fill in the defaults."""

import copy
import math
from collections.abc import Iterator
from difflib import get_close_matches

import jsonschema

from scripts.config import check_models, si
from scripts.config.checks import check_blocks, check_samples, check_smooth, place_of, wrong
from scripts.files.read_config import ConfigError
from scripts.models.models import model_of
from scripts.models.networks import nodes_of
from scripts.plans import studies
from scripts.plans.scenes import is_block, is_chain

EQUATIONS = 3
"""Equations of a block: exponents that it has without delay."""
MORE_EXPONENTS = 2
"""Exponents of a chain beyond one a block, and the most of all, where no number is given."""
MOST_EXPONENTS = 64
CHAINS = "chain"
"""The figure whose rows are scenes of more than one block."""
SIGNS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
"""Bounds of numbers in the schema, as messages write them."""


def checked(config: dict) -> dict:
    """Return `config` with its defaults; raise ConfigError naming place, key, value and range."""
    texts: list[tuple[str, str, str]] = []
    problems = list(si.fill_in_parameters(config, texts))
    problems += check_models.name_models(config)
    schema = check_models.with_parameters(studies.schema(), config)
    problems = problems or [in_words(e) for e in validator_for(schema).iter_errors(config)]
    problems = problems or list(check_models.contradictions(config))
    if not problems:
        _fill_in_nodes(config)
        _fill_in_exponents(config)
        problems = list(_contradictions(config))
    if problems:
        for place, words, text in texts:
            problems = [
                line.replace(words, f"{words} ({text})") if line.startswith(place) else line
                for line in problems
            ]
        raise ConfigError("\n".join(["the configuration is refused:", *sorted(set(problems))]))
    return config


def validator_for(rules: dict):
    """A validator for which NaN and infinity are no numbers and which sets missing keys."""
    base = jsonschema.Draft202012Validator
    types = base.TYPE_CHECKER.redefine_many(
        {
            "number": lambda _, value: _is_finite_number(value),
            "integer": lambda _, value: isinstance(value, int) and not isinstance(value, bool),
        }
    )

    def fill_then_check(validator, properties, instance, subschema):
        if validator.is_type(instance, "object"):
            for key, rules in properties.items():
                if "default" in rules:
                    instance.setdefault(key, copy.deepcopy(rules["default"]))
        yield from base.VALIDATORS["properties"](validator, properties, instance, subschema)

    check = {"properties": fill_then_check}
    return jsonschema.validators.extend(base, check, type_checker=types)(rules)


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
        # xi is written ksi, too
        spelt = [str(key).replace("ksi", "xi") for key in unknown]
        meant = {near for key in spelt for near in get_close_matches(key, known, n=1)}
        hint = f" (is it meant to be {' and '.join(map(repr, sorted(meant)))}?)" if meant else ""
        return f"{place_of(path)}: unknown key {unknown}; allowed: {', '.join(known)}{hint}"
    if error.validator == "required":
        missing = [key for key in error.validator_value if key not in error.instance]
        return f"{place_of(path)}: key {missing} is missing"
    value = error.instance
    known = filter(None, [error.schema.get("description"), range_in_words(error.schema)])
    expected = ", ".join(known) or "keys with values below it"
    if "propertyNames" in error.absolute_schema_path:
        expected = expected if isinstance(value, str) else "text (quote it)"
        return f"{place_of(path)}: name {value!r}; expected {expected}"
    key = path[-1] if path else "value"
    return f"{place_of(path[:-1])}: {key} = {value!r}; expected {expected}"


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


def _fill_in_nodes(config: dict) -> None:
    """A scene of a network has as many blocks as nodes."""
    for scene in config["scenes"].values() if config.get("models") else ():
        if network := model_of(config, scene).network:
            scene["blocks"] = nodes_of(network)


def _fill_in_exponents(config: dict) -> None:
    """Exponents are measured up to the end of their scene, and of one block checked, where nothing
    else is given."""
    for scene in config["scenes"].values():
        if "exponents" in scene:
            blocks, alone = scene["blocks"], scene["blocks"] == 1
            of_chain = min(blocks + MORE_EXPONENTS, MOST_EXPONENTS)
            count = config["exponents"]["count"] if alone else of_chain
            if model_of(config, scene).network:
                count = min(blocks, config["exponents"]["count"])
            defaults = {"count": count, "t_end": scene["t_end"], "checks": alone}
            scene["exponents"] = defaults | scene["exponents"]


def _contradictions(config: dict) -> Iterator[str]:
    """Problems that involve more than one key: of scenes, of rows of figures, and of studies."""
    scenes = config["scenes"]
    for name, scene in scenes.items():
        yield from _contradictions_of_scene(config, f"scene '{name}'", scene)
    for figure, settings in config["figures"].items():
        for row, shown in settings["rows"].items():
            kind = is_chain if figure == CHAINS else is_block
            known = [name for name in scenes if kind(config, name)]
            if shown["scene"] not in known:
                place = f"config figures {figure} rows {row}"
                yield wrong(place, shown, "scene", f"one of: {', '.join(known)}")
    for checks in studies.load_parts("checks").values():
        yield from checks.contradictions(config)


def _contradictions_of_scene(config: dict, place: str, scene: dict):
    """Problems of a scene and of its exponents."""
    transient, t_end, wanted = scene["t_transient"], scene["t_end"], scene.get("exponents")
    model = model_of(config, scene)
    stored, delay = list(model.history), scene["tau"] if model.is_block else math.nan
    if not set(scene.get("variables", stored)) <= set(stored):
        yield wrong(place, scene, "variables", f"some of: {', '.join(stored)}")
    if transient >= t_end:
        yield wrong(place, scene, "t_transient", f"a finite number >= 0 and < t_end = {t_end}")
    yield from check_samples(place, scene, scene["blocks"])
    yield from check_blocks(config, place, scene)
    if wanted:
        yield from check_smooth(config, f"{place} exponents", scene)
    most = EQUATIONS * scene["blocks"]
    if wanted and delay == 0 and wanted["count"] > most:
        expected = f"a whole number >= 2 and <= {most} without delay"
        yield wrong(f"{place} exponents", wanted, "count", expected)
    if wanted and (wanted["t_end"] <= transient or wanted["t_end"] <= delay):
        expected = f"a finite number > t_transient = {transient} and > tau = {delay}"
        yield wrong(f"{place} exponents", wanted, "t_end", expected)

"""Check what has a model: its parameters and histories, whose names the schema does not have."""

import copy
from collections.abc import Iterator

from generator.ranges import expected_of, is_inside, range_of
from scripts.config.checks import check_values, place_of
from scripts.files.read_config import ConfigError, read
from scripts.models.check_definitions import check_definition
from scripts.models.models import (
    BLOCK,
    Model,
    block_parameters,
    chain_parameters,
    definition,
    forms_of,
    models,
    models_of_entries,
)
from scripts.models.networks import check_network, nodes_of

KEYWORDS = {"above": "exclusiveMinimum", "at_least": "minimum"}
"""Of the schema, for bounds in definitions."""
KINDS = {"meaning": str, "unit": str, **dict.fromkeys(("above", "at_least"), int | float)}
"""Of what a definition says of a parameter."""
OUTSIDE = ("laws", "models", "claims")
"""Sections whose parts have no model."""


def name_models(config: dict) -> Iterator[str]:
    """Put `model` of entries, a name under models, in the place of their law; problems."""
    users = config.get("models")
    known = list(users) if isinstance(users, dict) else []
    for path, entry in _parts(config):
        if "model" not in entry:
            continue
        name, place = entry.pop("model"), place_of(path)
        if "law" in entry:
            yield f"{place}: law = {entry['law']!r}; expected none beside model = {name!r}"
        if name not in known:
            expected = f"one of: {', '.join(known)}" if known else "a name under models"
            yield f"{place}: model = {name!r}; expected {expected}"
        entry["law"] = name


def with_parameters(schema: dict, config: dict) -> dict:
    """The schema in which whatever has a model may have the parameters of any model."""
    users = {kind: config.get(kind) for kind in ("laws", "models")}
    users = {kind: part for kind, part in users.items() if isinstance(part, dict)}
    own = {
        (kind, str(name)): dict(_entries(entry))
        for kind, part in users.items()
        for name, entry in part.items()
    }
    laws = [model.own_parameters for model in models({}).values()]
    known = [block_parameters(), *laws, chain_parameters()]
    every: dict[str, list[dict]] = {}
    for parameters in [*known, *own.values()]:
        for name, entry in parameters.items():
            every.setdefault(name, []).append(entry or {})
    whole = copy.deepcopy(schema)
    taken = {key for place in _with_law(whole) for key in place}
    for (kind, name), parameters in own.items():
        not_own = taken.union(*[block_parameters(), chain_parameters()] * (kind == "laws"))
        if meant := not_own & set(parameters):
            raise ConfigError(
                f"config {kind} {name}: parameters {', '.join(sorted(meant))}: keys of all that has"
                f" a model have these names; expected none of {', '.join(sorted(not_own))}"
            )
    for place in _with_law(whole):
        # messages list parameters first
        others = dict(place)
        place.clear()
        lists = others["law"].get("lists", False)
        place |= {name: _rules(name, entries, lists) for name, entries in every.items()} | others
    return whole


def _rules(name: str, entries: list[dict], lists: bool) -> dict:
    """What the schema says of a parameter: the range of all models that have it, if it is one."""
    shared = entries[0] if all(range_of(one) == range_of(entries[0]) for one in entries) else {}
    bounds = {KEYWORDS[key]: shared[key] for key in KEYWORDS if key in shared}
    described = {**shared, "meaning": entries[0].get("meaning", name)}
    rules = {"type": "number", "description": expected_of(name, described), **bounds}
    if not lists:
        return rules
    words = rules["description"].replace("a finite", "at least one finite")
    several = {"type": ["number", "array"], "minItems": 1, "uniqueItems": True, "items": rules}
    return {**bounds, **several, "description": f"{words}, each once"}


def _entries(model):
    """Parameters of a definition that may not be one."""
    parameters = model.get("parameters") if isinstance(model, dict) else None
    for name, entry in parameters.items() if isinstance(parameters, dict) else ():
        given = entry.items() if isinstance(entry, dict) else ()
        # the rules of its section refuse the rest
        yield str(name), {key: one for key, one in given if isinstance(one, KINDS.get(key, ()))}


def _with_law(schema):
    """The properties of all that has a law."""
    if isinstance(schema, dict):
        properties = schema.get("properties")
        if isinstance(properties, dict) and "law" in properties:
            yield properties
        for value in schema.values():
            yield from _with_law(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from _with_law(value)


def contradictions(config: dict) -> Iterator[str]:
    """Definitions of which no model can be made, entries that do not fit theirs; sets defaults."""
    try:
        check_users_models(config)
    except ConfigError as problem:
        yield str(problem)
        return
    known = models_of_entries(config)
    every = {
        name
        for model in models(config).values()
        for name in [*model.parameters, *model.network.get("parameters", {})]
    }
    for path, entry in _parts(config):
        if "law" not in entry:
            continue
        place = place_of(path)
        if entry["law"] not in known:
            yield f"{place}: law = {entry['law']!r}; expected one of: {', '.join(known)}"
            continue
        if known[entry["law"]].network:
            yield from _scene_of_network(known[entry["law"]], path, entry)
        yield from _parameters(known[entry["law"]], place, entry, every)
        if "history" in entry:
            rules = known[entry["law"]].history
            yield from check_values(f"{place} history", entry["history"], rules)


def _scene_of_network(model: Model, path: tuple[str, ...], entry: dict) -> Iterator[str]:
    """What networks cannot have."""
    place, nodes = place_of(path), nodes_of(model.network)
    if path[0] != "scenes" or "attractors" in entry:
        part = " attractors" * (path[0] == "scenes")
        expected = "a model without an index: networks have trajectories and exponents alone"
        yield f"{place}{part}: model = {entry['law']!r}; expected {expected}"
    elif entry["blocks"] not in (1, nodes) or entry["ends"] != "free":
        expected = f"neither, since the model {entry['law']} has nodes"
        yield f"{place}: blocks = {entry['blocks']}, ends = {entry['ends']}; expected {expected}"


def _parameters(model: Model, place: str, entry: dict, every: set[str]) -> Iterator[str]:
    """Problems of the parameters of an entry."""
    known, own, name = model.parameters, model.own_parameters, entry["law"]
    kind = "law" if model.is_block else "model"
    if "blocks" in entry and model.is_block:
        known = known | chain_parameters()
    shown = own if kind == "law" else known
    for key in sorted((every - set(known)) & set(entry)):
        has = f"it has {', '.join(shown)}" if shown else "it has none of its own"
        yield f"{place}: {key} is no parameter of the {kind} {name}; {has}"
    axes = {entry.get(key) for key in ("along", "abscissa", "ordinate")} - {None}
    axes |= {key.removesuffix("_window") for key in entry if key.endswith("_window")}
    # without an axis that is known, nothing says which value is left out
    varied = axes - {"abscissa", "ordinate"}
    if not varied <= {*known, *model.history}:
        return
    for key, rules in known.items():
        if key not in entry and key not in axes and "default" in rules:
            entry[key] = rules["default"]
        if key not in entry and key not in axes:
            of_model = f": a parameter of the {kind} {name}" if key in own else ""
            yield f"{place}: key [{key!r}] is missing{of_model}"
        for value in _as_list(entry.get(key, [])):
            if not is_inside(value, rules):
                yield f"{place}: {key} = {value!r}; expected {expected_of(key, rules)}"


def check_users_models(config: dict) -> None:
    """Refuse the first of a user's laws and models of which none can be made; raise ConfigError."""
    taken = {*models({})}
    for section in ("laws", "models"):
        for name, own in config[section].items():
            place, whole = f"config {section} {name}", definition(name, own)
            names = {form.compiled for form in forms_of(name, whole)}
            if names & taken:
                raise ConfigError(f"{place}: another model has this name; expected another name")
            taken |= names
            check_network(own, place)
            check_definition(place, [read(BLOCK), whole] if section == "laws" else [whole])


def _as_list(value) -> list:
    return value if isinstance(value, list) else [value]


def _parts(value, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], dict]]:
    """All parts of a configuration that may have a model, and where they stand."""
    if isinstance(value, dict):
        if path and path[0] not in OUTSIDE:
            yield path, value
        for key, part in value.items():
            yield from _parts(part, (*path, str(key)))

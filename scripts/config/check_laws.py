"""Check laws of friction and what has one; the schema has no names of a law's own parameters."""

import copy

from scripts.files.read_config import ConfigError
from scripts.namelists.laws import block_parameters, check_law, definitions, own_parameters
from scripts.namelists.parameters import HISTORY


def with_own_parameters(schema: dict, config: dict) -> dict:
    """The schema in which whatever has a law may have the own parameters of any law."""
    laws = config.get("laws")
    users = laws if isinstance(laws, dict) else {}
    known = definitions({}).values()
    own = {
        str(name): {"type": "number", "description": str((entry or {}).get("meaning", name))}
        for law in [*known, *(law for law in users.values() if isinstance(law, dict))]
        for name, entry in _entries(law)
    }
    whole = copy.deepcopy(schema)
    taken = {key for place in _with_law(whole) for key in place}
    for law, entry in users.items():
        if meant := taken & {
            str(name) for name, _ in _entries(entry if isinstance(entry, dict) else {})
        }:
            raise ConfigError(
                f"config laws {law}: parameters {', '.join(sorted(meant))}: keys of all that has a "
                f"law have these names; expected none of {', '.join(sorted(taken))}"
            )
    for place in _with_law(whole):
        place |= {name: entry for name, entry in own.items() if name not in place}
    return whole


def _entries(law: dict):
    parameters = law.get("parameters")
    for name, entry in parameters.items() if isinstance(parameters, dict) else ():
        yield name, entry if isinstance(entry, dict) else {}


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


def contradictions(config: dict):
    """Laws of which no model can be made, and entries that do not fit their law; sets defaults."""
    for name, law in config["laws"].items():
        try:
            check_law(name, law)
        except ConfigError as problem:
            yield str(problem)
            return
    laws = definitions(config)
    every = {name for law in laws for name in own_parameters(config, law)}
    for path, entry in _entries_with_law(config):
        place = " ".join(["config", *path])
        if entry["law"] not in laws:
            yield f"{place}: law = {entry['law']!r}; expected one of: {', '.join(laws)}"
            continue
        own = own_parameters(config, entry["law"])
        for key in sorted((every - set(own)) & set(entry)):
            has = f"it has {', '.join(own)}" if own else "it has none of its own"
            yield f"{place}: {key} is no parameter of the law {entry['law']}; {has}"
        # an axis has no value; checks.py refuses one that is no parameter
        axis = entry.get("along", entry.get("ordinate"))
        values = HISTORY if path[0] == "routes" else []
        known = axis in (None, *block_parameters(), *own, *values)
        for key, rules in own.items():
            if key in entry or (known and key != axis):
                yield from _own_parameter(place, entry, key, rules)


def _own_parameter(place: str, entry: dict, key: str, rules: dict):
    """Problems of one own parameter."""
    if key not in entry and "default" not in rules:
        yield f"{place}: key [{key!r}] is missing: a parameter of the law {entry['law']}"
        return
    value = entry.setdefault(key, rules.get("default"))
    if "above" in rules and not value > rules["above"]:
        yield f"{place}: {key} = {value}; expected a finite number > {rules['above']}"
    if "at_least" in rules and not value >= rules["at_least"]:
        yield f"{place}: {key} = {value}; expected a finite number >= {rules['at_least']}"


def _entries_with_law(value, path: tuple[str, ...] = ()):
    """All parts of a configuration that have a law, and where they stand."""
    if isinstance(value, dict):
        if isinstance(value.get("law"), str) and path[0] not in ("laws", "claims"):
            yield path, value
        for key, part in value.items():
            yield from _entries_with_law(part, (*path, str(key)))

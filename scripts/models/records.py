"""The record of a model: attributes of a file of results, or the same of an entry.

They are `model` (its name), `model_kind`, `parameters` (their names) and these by name. A row of a
table has the words of its model as `law`, and columns of the parameters.
"""

import math
from collections.abc import Mapping

from scripts.models.models import (
    ADDED,
    DAMPED,
    PAPER,
    PARAMETERS,
    chain_parameters,
    model_of,
)

BEGINNINGS = {"": "model ", DAMPED: f"{ADDED[DAMPED]}_"}
"""What stands before the name of a model of some kinds in words."""


def place_of(config: dict, entry: Mapping) -> dict:
    """Model and parameters of an entry, of the latter those that it gives: all but axes."""
    names = [*model_of(config, entry).parameters, "law"]
    return {key: entry[key] for key in names if key in entry}


def record_of(config: dict, entry: Mapping) -> dict:
    """The record of the model of an entry, as a result of it has it."""
    model = model_of(config, entry)
    values = {key: entry[key] for key in model.parameters if key in entry}
    names = " ".join(model.parameters)
    return {"model": model.name, "model_kind": model.kind, "parameters": names, **values}


def law_of(place: Mapping, *axes: str) -> str:
    """The words of the model of a record, a row or a place; the paper's law if it has none.

    A record's have the values of the own parameters but for those of axes.
    """
    if "model" not in place:
        return str(place.get("law", PAPER))
    kind = place.get("model_kind", "")
    known = {*PARAMETERS, *axes, *(chain_parameters() if kind else ())}
    own = [name for name in place["parameters"].split() if name in place and name not in known]
    values = ", ".join(f"{name} = {place[name]:g}" for name in own)
    return BEGINNINGS.get(kind, "") + place["model"] + (f" ({values})" if values else "")


def is_of_block(place: Mapping) -> bool:
    """Whether a record, a row or a place is that of the block: it alone has all its parameters."""
    if "model" in place:
        return bool(place.get("model_kind"))
    return "law" not in place or not any(math.isnan(place.get(x, math.nan)) for x in PARAMETERS)


def is_on(scene: Mapping, place: Mapping, *axes: str) -> bool:
    """Whether the record of a scene has the model and parameters of a place, those of axes
    aside."""
    keys = [key for key in PARAMETERS if key not in axes and key in scene]
    same = all(scene[key] == place.get(key) for key in keys)
    return same and law_of(scene, *axes) == law_of(place)


def spoken(law: str) -> str:
    """A law as figures and sentences write it."""
    return law.replace("_", " ")

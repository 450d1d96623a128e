"""Definitions of models: the block with each law of friction, and a user's laws and models.

An entry of the configuration names its model under `law`, also a model of its user's own.
"""

import contextlib
import hashlib
import json
import os
from collections.abc import Mapping
from functools import cache, reduce
from pathlib import Path

from scripts.files.digests import digest_of_files
from scripts.files.read_config import ConfigError, read

MODEL = Path(__file__).parents[2] / "fortran" / "src" / "model"
BLOCK = MODEL / "spring_block.yaml"
"""The equations of the block, to which a law adds its own."""
GENERATOR = MODEL.parents[2] / "generator"
CHECKED = MODEL.parents[2] / "build" / "checked_laws"
"""A file for each law that was checked before, named by its digest."""
PAPER = "slip_delayed_logarithm"
"""The law of equation (4)."""
PREFIX = "quasistatic_"
"""What stands before the name of a law without inertia."""
OF_USER = "model "
"""What stands before the name of a model that is not the block, in words."""
CHAIN = "chain_"
"""What stands before the name of the law of a chain of blocks."""
BEFORE = " before the start"
HISTORY = {
    "theta": {"meaning": f"friction state{BEFORE}", "default": 0.0},
    "u": {"meaning": f"displacement{BEFORE}", "default": 0.0},
    "v": {"meaning": f"velocity{BEFORE}", "default": 1.1, "above": 0.0},
}
"""Values of the block before the initial time."""


@cache
def built_in() -> dict[str, dict]:
    """Definitions of the project's laws by name, the paper's first."""
    laws = {path.stem: read(path) for path in sorted((MODEL / "laws").glob("*.yaml"))}
    return {PAPER: laws.pop(PAPER), **laws}


def definition(name: str, law: dict) -> dict:
    """The definition of a user's law or model, as the generator reads it."""
    if "equations" in law:
        return {"name": name, **law}
    parts = {key: law[key] for key in ("evolution", "friction") if key in law}
    return {
        "name": name,
        "source": law["source"],
        "parameters": law["parameters"],
        "definitions": parts,
    }


def definitions(config: dict) -> dict[str, dict]:
    """Definitions of all laws by name, those without inertia after the others."""
    users = config.get("laws", {})
    laws = {**built_in(), **{name: definition(name, law) for name, law in users.items()}}
    return laws | {f"{PREFIX}{name}": without_inertia(law) for name, law in laws.items()}


def models_of_user(config: dict) -> dict[str, dict]:
    """A user's models that are not the block, by name."""
    return config.get("models", {})


def is_law(config: dict, name: str) -> bool:
    """Whether a model is the block with a law of friction."""
    return name not in models_of_user(config)


def has_rest(config: dict, name: str) -> bool:
    """Whether a model declares a state at rest: roots, Hopf points and cycles begin there."""
    return is_law(config, name) or "steady_state" in models_of_user(config)[name]


def is_driven(config: dict, name: str) -> bool:
    """Whether a model has t in its equations."""
    return _facts(config, name)[0]


def switch_of(config: dict, name: str) -> str:
    """The first term of a model that is not smooth; empty if all are."""
    return _facts(config, name)[1]


def _facts(config: dict, name: str) -> tuple[bool, str]:
    if is_law(config, name):
        return False, ""
    place, own = f"config models {name}", definition(name, models_of_user(config)[name])
    return check_model(place, name, [own])


def names_of_models(config: dict) -> list[str]:
    """Names of all models that entries may have."""
    return [*definitions(config), *models_of_user(config)]


def parameters_of(config: dict, model: str) -> dict[str, dict]:
    """Meanings and ranges of all parameters of a model by name."""
    if is_law(config, model):
        return block_parameters() | own_parameters(config, model)
    return {key: entry or {} for key, entry in models_of_user(config)[model]["parameters"].items()}


def history_of(config: dict, model: str) -> dict[str, dict]:
    """Meanings and ranges of the values of a model before the initial time, by name."""
    if is_law(config, model):
        return HISTORY
    states = models_of_user(config)[model]["states"]
    return {name: {"meaning": f"{meaning}{BEFORE}"} for name, meaning in states.items()}


@cache
def block_parameters() -> dict[str, dict]:
    """The parameters of the block by name, which every law has."""
    return read(BLOCK)["parameters"]


@cache
def chain_parameters() -> dict[str, dict]:
    """The parameters by name that a chain has beside those of its blocks, 0 of one block."""
    own = read(MODEL / "chain.yaml")["parameters"]
    return {key: {**entry, "default": 0.0} for key, entry in own.items()}


@cache
def _damping() -> dict[str, dict]:
    """The parameters that a law without inertia has beside its own."""
    own = read(MODEL / "quasistatic.yaml")["parameters"]
    return {key: entry for key, entry in own.items() if key not in block_parameters()}


def without_inertia(law: dict) -> dict:
    """A law with radiation damping in place of mass: what the generator makes of it."""
    return {**law, "parameters": {**(law.get("parameters") or {}), **_damping()}}


def own_parameters(config: dict, law: str) -> dict[str, dict]:
    """The parameters that a model has beside those that the block has by the same names."""
    if not is_law(config, law):
        every = parameters_of(config, law)
    else:
        every = definitions(config)[law].get("parameters") or {}
    return {key: entry or {} for key, entry in every.items() if key not in block_parameters()}


def own_place(config: dict, settings: dict) -> dict:
    """Law of an entry, and by name the own parameters that it gives: all but those of axes."""
    names = ("law", *own_parameters(config, settings["law"]))
    return {key: settings[key] for key in names if key in settings}


def law_in_words(config: dict, settings: dict) -> str:
    """Name of the law of an entry, with the values of its own parameters, as results have it."""
    kind = "" if is_law(config, settings["law"]) else OF_USER
    return kind + with_values(**own_place(config, settings))


def law_in_file(attributes: Mapping, *axes: str) -> str:
    """The same by the attributes of a file of results, without the parameters of axes."""
    names = attributes["parameters"].split()
    of_block = set(block_parameters()) <= set(names)
    known = {*block_parameters(), *axes, *["kappa"] * of_block}
    own = {key: attributes[key] for key in names if key not in known and key in attributes}
    kind = "" if of_block else OF_USER
    return kind + with_values(attributes["model"].removeprefix(CHAIN), **own)


def with_values(law: str, **own: float) -> str:
    """Name of a law with the values of own parameters."""
    values = ", ".join(f"{name} = {value:g}" for name, value in own.items())
    return law + (f" ({values})" if values else "")


def law_of(place: Mapping) -> str:
    """The law of a row, of a file's attributes or of a place; the paper's if it has none."""
    return law_in_file(place) if "model" in place else str(place.get("law", PAPER))


def is_on(scene: dict, place: Mapping, *axes: str) -> bool:
    """Whether a scene has the law and parameters of a place, those of axes aside."""
    own = {key: scene[key] for key in scene if key not in {*block_parameters(), "law"}}
    fixed = {key: value for key, value in own.items() if key not in axes}
    law = law_of(scene) if fixed == own else with_values(law_of(scene).split(" (")[0], **fixed)
    keys = [key for key in block_parameters() if key not in axes and key in scene]
    return law == law_of(place) and all(scene[key] == place.get(key) for key in keys)


def is_of_block(place: Mapping) -> bool:
    """Whether a row, attributes or a place are those of the block."""
    return not law_of(place).startswith(OF_USER)


def spoken(law: str) -> str:
    """A law as figures and sentences write it."""
    return law.replace("_", " ")


def check_model(place: str, name: str, parts: list[dict]) -> tuple[bool, str]:
    """Refuse parts of a definition of which no model can be made; raise ConfigError saying why.

    Otherwise whether the model has t in its equations, and its first term that is not smooth.
    """
    if name in built_in():
        raise ConfigError(f"{place}: the project has a law of this name; expected another name")
    if name.startswith((PREFIX, CHAIN)):
        raise ConfigError(
            f"{place}: {PREFIX}NAME is the law NAME without inertia, {CHAIN}NAME that of a chain;"
            " expected another"
        )
    checked = CHECKED / _digest_of(parts)
    if checked.exists():
        return tuple(json.loads(checked.read_text(encoding="utf-8")))
    # needs SymPy, which takes half a second to load
    from generator.definition import overlaid, read_model
    from generator.fortran import in_words
    from generator.model import TIME, ModelError
    from generator.module import write_module

    try:
        model = read_model(reduce(overlaid, parts))
        write_module(model)
    except (ModelError, TypeError) as problem:
        reason = str(problem).removeprefix(f"model {name}: ")
        raise ConfigError(f"{place}: {reason}") from None
    has_time = any(one.has(TIME) for one in model.equations.values())
    switches = [in_words(one.text, model.written) for one in model.switches]
    facts = has_time, next(iter(switches), "")
    # where nothing can be written, the model is checked again
    with contextlib.suppress(OSError):
        CHECKED.mkdir(parents=True, exist_ok=True)
        unfinished = checked.with_suffix(f".{os.getpid()}")
        unfinished.write_text(json.dumps(facts), encoding="utf-8")
        unfinished.replace(checked)
    return facts


def check_users_models(config: dict) -> None:
    """Refuse the first of a user's laws and models of which none can be made; raise ConfigError."""
    for name, law in config["laws"].items():
        check_model(f"config laws {name}", name, [read(BLOCK), definition(name, law)])
    for name, model in models_of_user(config).items():
        place = f"config models {name}"
        if name in config["laws"]:
            raise ConfigError(f"{place}: a law has this name; expected another name")
        check_model(place, name, [definition(name, model)])


def _digest_of(parts: list[dict]) -> str:
    """A digest of a definition and of all by which it is checked."""
    sources = [*sorted(GENERATOR.glob("*.py")), *sorted(GENERATOR.glob("*.jinja"))]
    said = json.dumps([parts, digest_of_files(sources)])
    return hashlib.sha256(said.encode()).hexdigest()

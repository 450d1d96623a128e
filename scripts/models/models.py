"""Who a model is: the block with a law of friction, also without inertia or as one of a chain, or
the equations of a user.

An entry of the configuration names its model under `law`, also a model of its user's own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from scripts.files.read_config import read
from scripts.models.check_definitions import check_definition
from scripts.models.networks import network_of, without_numbers

MODEL = Path(__file__).parents[2] / "fortran" / "src" / "model"
BLOCK = MODEL / "spring_block.yaml"
"""The equations of the block, to which a law adds its own."""
PAPER = "slip_delayed_logarithm"
"""The law of equation (4)."""
OF_USER, ALONE, DAMPED, OF_CHAIN = "", "block", "block without inertia", "chain of blocks"
"""Kinds of models, as definitions and files of results have them."""
ADDED = {ALONE: "", DAMPED: "quasistatic", OF_CHAIN: "chain", OF_USER: ""}
"""The definition in MODEL that each kind adds to block and law."""
BEFORE = " before the start"
HISTORY = {
    "theta": {"meaning": f"friction state{BEFORE}", "default": 0.0},
    "u": {"meaning": f"displacement{BEFORE}", "default": 0.0},
    "v": {"meaning": f"velocity{BEFORE}", "default": 1.1, "above": 0.0},
}
"""Values of the block before the initial time."""
PARAMETERS = list(read(BLOCK)["parameters"])
"""Names of the block's parameters."""


@cache
def parameters_in(name: str) -> dict[str, dict]:
    """Meanings and ranges of the parameters in a definition of MODEL, by name."""
    return read(MODEL / f"{name}.yaml")["parameters"]


def block_parameters() -> dict[str, dict]:
    """The parameters of the block by name, which every law has."""
    return parameters_in(BLOCK.stem)


def chain_parameters() -> dict[str, dict]:
    """The parameters by name that a chain has beside those of its blocks, 0 of one block."""
    return {key: {**one, "default": 0.0} for key, one in parameters_in(ADDED[OF_CHAIN]).items()}


@dataclass(frozen=True)
class Model:
    """Who a model is."""

    kind: str
    name: str
    """Of its law of friction, or of the model of a user."""
    definition: dict
    """Of its law or model, as the generator reads it."""
    network: dict = field(default_factory=dict)
    """Index, nodes and their parameters (networks.py); empty of a model without an index."""

    @property
    def compiled(self) -> str:
        """The name of its object, by which namelists open it; also that in entries."""
        return "_".join(filter(None, [ADDED[self.kind], self.name]))

    @property
    def is_block(self) -> bool:
        """Whether it is the block with a law of friction."""
        return self.kind != OF_USER

    @property
    def has_rest(self) -> bool:
        """Whether it declares a state at rest: roots, Hopf points and cycles begin there."""
        return self.is_block or "steady_state" in self.definition

    @property
    def is_driven(self) -> bool:
        """Whether it has t in its equations."""
        return self._facts[0]

    @property
    def switch(self) -> str:
        """The first term that is not smooth; empty if all are."""
        return self._facts[1]

    @property
    def moving_delay(self) -> str:
        """The first delay that depends on t or the states; empty if all are constant."""
        return self._facts[2]

    @property
    def _facts(self) -> tuple[bool, str, str]:
        place = f"config models {self.name}"
        return (False, "", "") if self.is_block else check_definition(place, [self.definition])

    @property
    def own_parameters(self) -> dict[str, dict]:
        """The parameters that it has beside those that the block has by the same names."""
        added = parameters_in(ADDED[self.kind]) if ADDED[self.kind] else {}
        listed = {**(self.definition.get("parameters") or {}), **added}
        return {key: one or {} for key, one in listed.items() if key not in PARAMETERS}

    @property
    def parameters(self) -> dict[str, dict]:
        """Meanings and ranges of all its parameters by name."""
        if self.is_block:
            return block_parameters() | self.own_parameters
        of_nodes = self.network.get("parameters", {})
        known = self.definition["parameters"].items()
        return {key: one or {} for key, one in known if key not in of_nodes}

    @property
    def history(self) -> dict[str, dict]:
        """Meanings and ranges of its values before the initial time, by name."""
        if self.is_block:
            return HISTORY
        states = self.definition["states"]
        return {
            name.partition("[")[0].strip(): {"meaning": f"{meaning}{BEFORE}"}
            for name, meaning in states.items()
        }


@cache
def built_in() -> dict[str, dict]:
    """Definitions of the project's laws by name, the paper's first."""
    laws = {path.stem: read(path) for path in sorted((MODEL / "laws").glob("*.yaml"))}
    return {PAPER: laws.pop(PAPER), **laws}


def definition(name: str, law: dict) -> dict:
    """The definition of a user's law or model, as the generator reads it."""
    if "equations" in law:
        return {"name": name, **without_numbers(law)}
    parts = {key: law[key] for key in ("evolution", "friction") if key in law}
    return {
        "name": name,
        "source": law["source"],
        "parameters": law["parameters"],
        "definitions": parts,
    }


def of_user(config: dict) -> dict[str, dict]:
    """Definitions of a user's laws and models by name."""
    both = {**config.get("laws", {}), **config.get("models", {})}
    return {name: definition(name, one) for name, one in both.items()}


def forms_of(name: str, given: dict, network: dict | None = None) -> list[Model]:
    """What a definition makes: a model of a user, or of a law each kind of block."""
    kinds = [OF_USER] if "equations" in given else [ALONE, DAMPED, OF_CHAIN]
    return [Model(kind, name, given, network or {}) for kind in kinds]


def models(config: dict) -> dict[str, Model]:
    """All models by the names of their objects."""
    given = {**built_in(), **of_user(config)}
    networks = {name: network_of(one) for name, one in config.get("models", {}).items()}
    found = [
        form for name, one in given.items() for form in forms_of(name, one, networks.get(name))
    ]
    return {one.compiled: one for one in sorted(found, key=lambda one: [*ADDED].index(one.kind))}


def models_of_entries(config: dict) -> dict[str, Model]:
    """The models that entries may have, by name."""
    return {name: one for name, one in models(config).items() if one.kind != OF_CHAIN}


def model_of(config: dict, entry: Mapping) -> Model:
    """The model of an entry."""
    return models(config)[entry["law"]]

# SPDX-License-Identifier: BSD-3-Clause
"""A model: its equations, parameters, and what can be computed of it."""

import copy
import ctypes
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from delaykit import methods, objects, runs, scans
from delaykit.arguments import ENDS, HUGE, number_of
from delaykit.errors import ModelError, check_name
from delaykit.generator.ranges import expected_of, is_inside
from delaykit.library import LIBRARY, address, open_object
from delaykit.networks import Network

OPTIONS = {
    *("about", "kind", "source", "auxiliary", "definitions", "fast", "domain", "event", "section"),
    *("integral", "coordinates", "steady_state", "longest_delay", "events"),
}
"""Keys of a definition that may be given by name (generator/README.md explains them)."""
LONG = 1000
"""Letters of all equations from which an object has no more than a method needs: a compiler takes
a second for the whole of them, and a tenth of it for the equations."""


class Handle(ctypes.c_void_p):
    """A model that the library has opened, until nobody has it."""

    def __init__(self, path: Path, network: Network | None):
        def opened(of_network: str) -> int:
            return open_object(path, of_network).value

        super().__init__(network.opened(opened) if network else opened(""))

    def __del__(self):
        if self.value:
            LIBRARY.dk_close(self)


class Model:
    """Equations y' = f(t, y(t), y(t - delay), ...) with named parameters.

    equations: by state, in the order of the state vector, each a text such as
        "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y" or a SymPy expression in which a delayed
        state is a function of time, y(t - tau). Texts are parsed, never evaluated.
    parameters: by name, a value, or a dict of `default`, `meaning`, `unit`, `above`, `at_least`.
    steady_state: by state an expression of parameters, or {"near": {state: guess}}.
    blocks, ends: of a chain, whose equations have second_difference(STATE): the number of blocks,
        and free, ring or plate.
    size: of a network, {index: number of nodes}: its equations are those of each node, as
        {"x[i]": "k*sum(j, a[i, j]*x[j](t - tau[i, j])) - x[i]"}. Parameters with an index are
        arrays, shape (nodes), with two matrices, shape (nodes, nodes), dense or sparse. A term that
        is 0 where a matrix is 0 costs nothing there.

    The model is compiled when it is first needed, and kept in the user's cache.
    """

    def __init__(
        self,
        equations: Mapping,
        parameters: Mapping | None = None,
        *,
        states=None,
        name="model",
        blocks=1,
        ends="free",
        size=None,
        **options,
    ):
        for key in options:
            check_name("option", key, OPTIONS)
        if not isinstance(equations, Mapping) or not equations:
            raise ModelError(f"equations: {equations!r}; expected a text for each state")
        if not isinstance(blocks, int) or blocks < 1:
            raise ModelError(f"blocks: {blocks!r}; expected a whole number >= 1")
        check_name("ends", ends, ENDS)
        self.blocks, self.ends = blocks, ends
        self.extent, self.handles = "whole", {}
        texts = {str(key): text_of(value) for key, value in equations.items()}
        given = {str(key): value for key, value in (parameters or {}).items()}
        parts = {key: text_of(one) for key, one in (options.get("definitions") or {}).items()}
        self.network = Network.read({**parts, **texts}, given, size)
        indexed = self.network.indices if self.network else {}
        if self.network:
            if (blocks, ends) != (1, "free"):
                raise ModelError(f"blocks: {blocks!r}, ends: {ends!r}; expected none in a network")
            self.blocks = self.network.nodes
        names = [key.partition("[")[0].strip() for key in texts]
        self.definition = {
            "name": str(name),
            "parameters": {key: entry_of(key, v) for key, v in given.items() if key not in indexed},
            "states": {key: str((states or {}).get(key, key)) for key in names},
            "equations": texts,
            **{key: plain(value) for key, value in options.items() if value is not None},
        }
        self.auxiliary = {
            str(key): str(text).replace(" ", "")[4:-1]
            for key, text in (options.get("auxiliary") or {}).items()
        }
        self.parameters = {
            key: entry["default"]
            for key, entry in self.definition["parameters"].items()
            if "default" in entry
        }

    @classmethod
    def from_file(cls, *paths: str | Path, **parameters) -> "Model":
        """The model that files of the generator define together; later ones replace."""
        from ruamel.yaml import YAML

        from delaykit.generator.definition import overlaid

        whole: dict = {}
        for path in paths:
            whole = overlaid(whole, YAML(typ="safe", pure=True).load(Path(path)))
        whole.pop("history", None)
        whole["parameters"] = {
            key: {**(entry or {}), **({"default": parameters[key]} if key in parameters else {})}
            for key, entry in whole.get("parameters", {}).items()
        }
        for key in parameters:
            check_name("parameter", key, whole["parameters"])
        return cls(whole.pop("equations"), whole.pop("parameters"), **whole)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states, in the order of the state vector."""
        return tuple(self.definition["states"])

    def reduced(self, extent: str) -> "Model":
        """The model whose object has no more than this, if the equations are long."""
        other = copy.copy(self)
        if sum(map(len, self.definition["equations"].values())) > LONG:
            other.extent = extent
        return other

    @property
    def own_events(self) -> int:
        """How many events of its definition change the state."""
        events = self.definition.get("events") or ()
        return 1 if isinstance(events, Mapping) else len(events)

    @property
    def path(self) -> Path:
        """The compiled object."""
        of_network = self.network.entries if self.network else {}
        parameters = {**self.definition["parameters"], **of_network}
        return objects.compiled({**self.definition, "parameters": parameters}, self.extent)

    @property
    def handle(self) -> "Handle":
        """The handle of the compiled model in the library."""
        if self.extent not in self.handles:
            self.handles[self.extent] = Handle(self.path, self.network)
        return self.handles[self.extent]

    def __copy__(self):
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __getstate__(self):
        return {**self.__dict__, "handles": {}}

    def __repr__(self):
        lines = [f"{state}' = {text}" for state, text in self.definition["equations"].items()]
        numbers = ", ".join(f"{key} = {value:g}" for key, value in self.parameters.items())
        return f"<delaykit.Model {self.definition['name']}: {'; '.join(lines)}; {numbers}>"

    def with_parameters(self, **values) -> "Model":
        """The same model with other values of parameters, arrays of those of nodes and edges."""
        other = copy.copy(self)
        arrays = {key: values.pop(key) for key in [*values] if key in self.arrays}
        other.parameters = {**self.parameters, **self.checked(values)}
        if arrays:
            other.network, other.handles = self.network.changed(arrays), {}
        return other

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """Values of the parameters of the nodes and edges of a network."""
        return dict.fromkeys(self.network.indices) | self.network.values if self.network else {}

    def checked(self, values: Mapping) -> dict[str, float]:
        """Values of parameters; raise ModelError for a name or a number that cannot be."""
        numbers = {}
        for key, value in values.items():
            if key in self.arrays:
                raise ModelError(
                    f"parameter {key}: has indices; expected with_parameters({key}=...)"
                )
            check_name("parameter", key, self.definition["parameters"])
            number = numbers[key] = number_of(f"parameter {key}", value)
            entry = self.definition["parameters"][key]
            if not is_inside(number, entry):
                expected = expected_of(key, entry)
                raise ModelError(f"parameter {key}: {number!r}; expected {expected}")
        return numbers

    def numbers(self, values: Mapping | None = None) -> np.ndarray:
        """All parameters in the order of the definition, some with other values."""
        known = {**self.parameters, **(self.checked(values) if values else {})}
        missing = [key for key in self.definition["parameters"] if key not in known]
        if missing:
            raise ModelError(f"parameter {missing[0]}: no value; expected a number")
        return np.array([known[key] for key in self.definition["parameters"]], float)

    def delays(self, **values) -> np.ndarray:
        """The delays with these values of parameters, in units of time."""
        return self.delays_of(self.numbers(values))

    def delays_of(self, numbers: np.ndarray) -> np.ndarray:
        """The delays with these parameters, those that move last by their bound."""
        count = ctypes.c_int()
        LIBRARY.dk_delays(self.handle, address(numbers), None, ctypes.byref(count))
        lags = np.empty(count.value)
        LIBRARY.dk_delays(self.handle, address(numbers), address(lags), ctypes.byref(count))
        return np.where(lags < HUGE, lags, np.inf)

    integrate = runs.integrate
    section = runs.section
    scan = scans.scan
    exponents = methods.exponents
    attractor = methods.attractor
    roots = methods.roots
    hopf = methods.hopf
    cycle = methods.cycle

    def run(self, *arguments, **options):
        """A run as an xarray.Dataset; the arguments are those of `integrate`."""
        if options.get("dense_output"):
            raise ModelError(
                "dense_output: True; expected with integrate, whose result is a function"
            )
        return self.integrate(*arguments, **options).to_dataset()

    def resting(self, near: Mapping | None, *, needed=True) -> "Model":
        """The model with a state at rest, looked for near a guess unless it has one."""
        if near is None:
            if needed and "steady_state" not in self.definition:
                raise ModelError("near: None; expected a guess, or a model with steady_state")
            return self
        if not isinstance(near, Mapping):
            raise ModelError(f"near: {near!r}; expected {{state: guess}}")
        guess = {key: number_of(f"near {key}", value) for key, value in near.items()}
        other = copy.copy(self)
        other.definition, other.handles = {**self.definition, "steady_state": {"near": guess}}, {}
        return other


def plain(value):
    """A value of a definition without SymPy or NumPy in it."""
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    if isinstance(value, int | float) and not isinstance(value, bool):
        return value
    return text_of(value)


def text_of(value) -> str:
    """A text; that of a SymPy expression has all digits, and no names but its own."""
    if not hasattr(value, "free_symbols"):
        return str(value)
    from mpmath.libmp import from_str, repr_dps, to_str
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):
        def _print_Float(self, one):  # noqa: N802
            texts = (to_str(one._mpf_, digits) for digits in range(15, repr_dps(one._prec) + 1))
            return next(x for x in texts if from_str(x, one._prec, "n") == one._mpf_)

        def _print_Exp1(self, _):  # noqa: N802
            return "exp(1)"

        def _print_Pi(self, _):  # noqa: N802
            return "acos(-1)"

    return Printer().doprint(value)


def entry_of(name, value) -> dict:
    """The entry of a parameter in a definition."""
    if isinstance(value, Mapping):
        return plain(value)
    return {} if value is None else {"default": number_of(f"parameter {name}", value)}

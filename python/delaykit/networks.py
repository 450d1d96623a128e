# SPDX-License-Identifier: BSD-3-Clause
"""Networks: models with an index, and the parameters of their nodes and edges as arrays."""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from delaykit.errors import ModelError
from delaykit.generator.network_file import count_indices, write_network
from delaykit.generator.ranges import expected_of, is_inside


@dataclass(frozen=True)
class Network:
    """Nodes, parameters of each, shape (nodes), and of edges, shape (nodes, nodes) or sparse."""

    index: str
    nodes: int
    entries: dict
    """Entries of its parameters in the definition, by name"""
    indices: dict
    """Numbers of their indices"""
    values: dict
    """Arrays by name"""

    @classmethod
    def read(cls, texts: Mapping, parameters: Mapping, size) -> "Network | None":
        """The network of equations and definitions, or None of equations without indices."""
        index, indices = count_indices(texts, parameters)
        if not index:
            if size is not None:
                raise ModelError(f"size: {size!r}; expected none without an index, as in x[i]")
            return None
        if not isinstance(size, Mapping) or set(size) != {index}:
            raise ModelError(f"size: {size!r}; expected {{{index!r}: number of nodes}}")
        nodes = size[index]
        if isinstance(nodes, bool) or not isinstance(nodes, int | np.integer) or nodes < 1:
            raise ModelError(f"size of {index}: {nodes!r}; expected a whole number >= 1")
        entries = {name: {} for name in indices}
        values = {}
        for name in indices:
            value = parameters[name]
            if isinstance(value, Mapping):
                entries[name] = {k: v for k, v in value.items() if k != "default"}
                value = value.get("default")
            if value is not None:
                values[name] = value
        return cls(index, int(nodes), entries, indices, {}).changed(values)

    def changed(self, values: Mapping) -> "Network":
        """The network with other values: arrays, or a number for all nodes or edges."""
        found = dict(self.values)
        for name, value in values.items():
            shape = (self.nodes,) * self.indices[name]
            if hasattr(value, "tocoo"):
                array = value.tocoo()
                numbers, given = array.data, array.shape
            else:
                try:
                    array = numbers = np.array(value, float)
                except (TypeError, ValueError):
                    raise ModelError(f"parameter {name}: {value!r}; expected numbers") from None
                given = array.shape or shape
            if given != shape or not np.isfinite(numbers).all():
                text = f"finite numbers of shape {shape}, or one for all"
                raise ModelError(f"parameter {name}: shape {given}; expected {text}")
            for number in (np.min(numbers, initial=np.inf), np.max(numbers, initial=-np.inf)):
                if np.isfinite(number) and not is_inside(number, self.entries[name]):
                    expected = expected_of(name, self.entries[name])
                    raise ModelError(f"parameter {name}: {number:g}; expected {expected}")
            found[name] = array if given == shape and np.ndim(array) else np.full(shape, array)
        return replace(self, values=found)

    def write(self, path: Path) -> None:
        """Write the file that a program opens."""
        missing = [name for name in self.indices if name not in self.values]
        if missing:
            raise ModelError(f"parameter {missing[0]}: no value; expected an array")
        vectors, matrices = (
            [self.values[name] for name in self.entries if self.indices[name] == count]
            for count in (1, 2)
        )
        write_network(path, self.nodes, vectors, matrices)

    def opened(self, open_path):
        """What a procedure makes of the path of the written file."""
        with tempfile.TemporaryDirectory(prefix="delaykit-") as folder:
            path = Path(folder, "network")
            self.write(path)
            return open_path(str(path))

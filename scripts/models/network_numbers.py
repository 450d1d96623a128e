"""Numbers of the nodes and edges of a user's network, from lists or CSV files, and their file."""

import csv
import math
from pathlib import Path

import numpy as np

from generator.network_file import write_network
from generator.ranges import expected_of, is_inside
from scripts.files.outputs import logged, written
from scripts.files.read_config import ConfigError
from scripts.models.networks import nodes_of


def arrays_of(network: dict, place: str) -> dict[str, np.ndarray]:
    """Numbers of all nodes or edges by parameter; raise ConfigError for what they cannot be."""
    nodes, found = nodes_of(network), {}
    for name, entry in network["parameters"].items():
        where, shape = f"{place}: parameter {name}", (nodes,) * entry["indices"]
        if ("csv" in entry) == ("default" in entry):
            raise ConfigError(f"{where}: has an index; expected default or csv, {in_words(shape)}")
        read = numbers_in if "csv" in entry else numbers_of
        array = found[name] = read(entry.get("csv", entry.get("default")), where, shape)
        for at in {int(array.argmin()), int(array.argmax())}:
            number = float(array.flat[at])
            if not is_inside(number, entry):
                indices = ", ".join(str(i) for i in np.unravel_index(at, shape))
                expected = expected_of(name, entry)
                raise ConfigError(f"{where}[{indices}] = {number:g}; expected {expected}")
    return found


def numbers_of(value, where: str, shape: tuple[int, ...]) -> np.ndarray:
    """Numbers from a list, a list of lists, or one for all."""
    try:
        array = np.array(value, float)
    except (TypeError, ValueError):
        raise ConfigError(f"{where}: rows of unequal length; expected {in_words(shape)}") from None
    if array.shape not in ((), shape):
        met = " x ".join(map(str, array.shape))
        raise ConfigError(f"{where}: {met} numbers; expected {in_words(shape)}, or one for all")
    return np.broadcast_to(array, shape)


def numbers_in(path: str, where: str, shape: tuple[int, ...]) -> np.ndarray:
    """Numbers from a CSV file: of nodes in a row or a column, of edges in a square."""
    nodes, rows, expected = shape[0], [], in_words(shape)
    if not Path(path).is_file():
        raise ConfigError(f"{where}: {path}: is no regular file; expected {expected}")
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            for line, row in enumerate(csv.reader(file), start=1):
                if not row:
                    continue
                place = f"{where}: {path}, row {line}"
                rows.append(np.array([number_of(one, place, i) for i, one in enumerate(row, 1)]))
                if len(row) != len(rows[0]) or len(row) > nodes or len(rows) > nodes:
                    raise ConfigError(f"{place}: {len(row)} numbers; expected {expected}")
    except (OSError, UnicodeDecodeError, csv.Error) as problem:
        raise ConfigError(f"{where}: {path}: cannot be read: {problem}") from None
    met = len(rows), len(rows[0]) if rows else 0
    if met not in ([(nodes, 1), (1, nodes)] if len(shape) == 1 else [shape]):
        raise ConfigError(f"{where}: {path}: {met[0]} x {met[1]} numbers; expected {expected}")
    return np.array(rows).reshape(shape)


def number_of(text: str, place: str, column: int) -> float:
    """A finite number."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ConfigError(f"{place}, column {column}: {text!r}; expected a finite number")
    return number


def in_words(shape: tuple[int, ...]) -> str:
    """How many numbers a parameter has."""
    nodes = shape[0]
    if len(shape) == 1:
        return f"{nodes} numbers, one for each node"
    return f"{nodes} rows of {nodes} numbers: into each node from each node"


def write(path: Path, network: dict) -> None:
    """Write the file that the program opens beside the compiled model."""
    arrays = arrays_of(network, "network")
    indices = {name: entry["indices"] for name, entry in network["parameters"].items()}
    of_nodes, of_edges = ([arrays[x] for x in arrays if indices[x] == n] for n in (1, 2))
    with written(path) as unfinished:
        write_network(unfinished, nodes_of(network), of_nodes, of_edges)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write(Path(snakemake.output[0]), snakemake.params.network)

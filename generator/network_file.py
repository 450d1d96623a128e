# SPDX-License-Identifier: BSD-3-Clause
"""The file of a network that a program opens: its nodes, edges and their parameters."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

INDEXED = re.compile(r"(\w+)\s*\[\s*(\w+)\s*(,\s*\w+\s*)?\]")


def count_indices(texts: Mapping[str, str], parameters: Iterable[str]) -> tuple[str, dict]:
    """The index of the states of equations, "" without one, and of these parameters that have
    indices their number, in their order. texts: equations and definitions."""
    index = next((m[2] for m in map(INDEXED.fullmatch, texts) if m), "")
    found = {m[1]: 1 + bool(m[3]) for text in texts.values() for m in INDEXED.finditer(text)}
    return index, {name: found[name] for name in parameters if index and name in found}


def write_network(path: Path, nodes: int, vectors: Sequence, matrices: Sequence) -> None:
    """Write the file that fortran/model_network.f90 explains.

    Parameters of nodes have shape (nodes), those of edges (nodes, nodes), dense or of
    scipy.sparse by coordinates; both in the order of the definition.
    """
    # plans of runs read `indices_of` and need no NumPy
    import numpy as np

    parts = []
    for matrix in matrices:
        if hasattr(matrix, "row"):
            rows, columns, numbers = matrix.row, matrix.col, matrix.data
        else:
            rows, columns = np.nonzero(matrix)
            numbers = matrix[rows, columns]
        parts.append((rows.astype(np.int64) * nodes + columns, numbers))
    places = np.unique(np.concatenate([np.empty(0, np.int64), *(place for place, _ in parts)]))
    table = np.zeros((len(matrices), len(places)))
    for row, (place, numbers) in zip(table, parts, strict=True):
        np.add.at(row, np.searchsorted(places, place), numbers)
    rows, columns = np.divmod(places, nodes)
    first = 1 + np.searchsorted(rows, np.arange(nodes + 1))
    counts = [nodes, len(vectors), len(matrices), len(places)]
    with path.open("wb") as file:
        for numbers in (counts, first, 1 + columns):
            np.asarray(numbers, np.int32).tofile(file)
        for numbers in (*vectors, table):
            np.asarray(numbers, np.float64).tofile(file)

"""Damage on the disk: a bit that changed in a result is an error, not another value."""

import re
import zlib

import netCDF4
import numpy as np
import pytest
from conftest import PROGRAMS

from scripts.files.inputs import read
from scripts.files.outputs import FileError

STREAM = re.compile(rb"x[\x01\x5e\x9c\xda]")
"""How compressed values begin."""


def unshuffled(stream: bytes, values: np.ndarray) -> bytes:
    """What was compressed, as numbers: there, bytes of one significance lie together."""
    whole = len(stream) - len(stream) % values.itemsize
    return np.frombuffer(stream[:whole], np.uint8).reshape(values.itemsize, -1).T.tobytes()


def deciding(stream: bytes, values: bytes) -> int:
    """Index of a byte near the middle of a compressed stream whose last bit changes the values:
    one that says where equal values are copied from does not."""
    for index in range(len(stream) // 2, len(stream)):
        damaged = bytearray(stream)
        damaged[index] ^= 1
        try:
            if zlib.decompress(damaged) != values:
                return index
        except zlib.error:
            return index
    raise AssertionError("no bit matters")


def places(content: bytes, variables: dict[str, np.ndarray]) -> dict[str, int]:
    """For each variable, the index of a byte among its values, compressed or plain."""
    streams = []
    for found in STREAM.finditer(content):
        stream = zlib.decompressobj()
        try:
            values = stream.decompress(content[found.start() :])
        except zlib.error:
            continue
        compressed = content[found.start() : len(content) - len(stream.unused_data)]
        streams.append((values, found.start() + deciding(compressed, values)))
    where = {}
    for name, values in variables.items():
        plain = values.tobytes()
        compressed = (at for stream, at in streams if unshuffled(stream, values).startswith(plain))
        where[name] = next(compressed, content.find(plain))
    return where


@pytest.mark.parametrize("program", [name for name in PROGRAMS if name != "reference"])
def test_changed_bit_is_an_error(programs, good_groups, program):
    """In each variable of each program. References are tables of text."""
    programs.made_of(program, good_groups[program])
    content = programs.output.read_bytes()
    with netCDF4.Dataset(programs.output) as file:
        file.set_auto_mask(False)
        file.set_auto_chartostring(False)
        variables = {name: one[...] for name, one in file.variables.items() if one.size}
    assert variables
    for name, place in places(content, variables).items():
        assert place > 0, name
        damaged = bytearray(content)
        damaged[place] ^= 1
        programs.output.write_bytes(damaged)
        with pytest.raises(FileError, match=r"output.nc: cannot be read: NetCDF: .*; run the same"):
            read(programs.output)


@pytest.mark.parametrize("program", [name for name in PROGRAMS if name != "reference"])
def test_every_variable_has_a_checksum(programs, good_groups, program):
    """One that is empty, too."""
    programs.made_of(program, good_groups[program])
    with netCDF4.Dataset(programs.output) as file:
        for name, variable in file.variables.items():
            assert variable.filters()["fletcher32"], name


def test_spectrum_of_a_damaged_trajectory_is_refused(programs, good_groups):
    """The line names the trajectory and says what to do."""
    values = good_groups["spectrum"]["spectrum"]
    with open(values["trajectory"], "rb") as whole:
        damaged = bytearray(whole.read())
    with netCDF4.Dataset(values["trajectory"]) as file:
        v = file["v"][:].data
    damaged[places(bytes(damaged), {"v": v})["v"]] ^= 1
    (programs.folder / "damaged.nc").write_bytes(damaged)
    values["trajectory"] = "damaged.nc"
    run = programs.run_groups("spectrum", good_groups["spectrum"])
    assert run.returncode == 1
    assert run.stdout == ""
    assert run.stderr.startswith("error: damaged.nc: variable 'v' cannot be read (remove the file;")
    assert run.stderr.count("\n") == 1
    assert not programs.output.exists()

# SPDX-License-Identifier: BSD-3-Clause
"""The compiled library of the solver and the methods, called over its interface to C."""

import ctypes
import threading
from pathlib import Path

import numpy as np

from delaykit.errors import RunError, RunInterruptedError
from delaykit.objects import ADVICE

PATH = Path(__file__).with_name("libdelaykit.so")
MESSAGE = 2048
"""Room for a message, in letters."""


def structure(*fields: str) -> list[tuple[str, type]]:
    """Fields of a structure from words `name:kind`."""
    kinds = {
        "r": ctypes.c_double,
        "i": ctypes.c_int,
        "l": ctypes.c_int64,
        "p": ctypes.c_void_p,
        "s": ctypes.c_char_p,
    }
    return [(name, kinds[kind]) for name, kind in (field.split(":") for field in fields)]


class History(ctypes.Structure):
    """dk_history: a past in polynomials."""

    _fields_ = structure(
        *("origin:p", "kink:p", "step_start:p", "step_length:p", "valid_for:p", "nodes:p"),
        *("coefficients:p", "passages:p", "generation:p", "kept:p"),
        *("kinks:i", "steps:i", "degree:i", "components:i"),
    )


class Request(ctypes.Structure):
    """dk_request: what is wanted of a run."""

    _fields_ = structure(
        *("parameters:p", "past:p", "state:p", "t_start:r", "t_start_rest:r", "t_end:r"),
        "method:s",
        *("rtol:p", "atol:p", "first_step:r", "max_step:r", "max_steps:l", "max_bytes:r"),
        *("times:p", "breaks:p", "doses:p", "event_level:p", "event_component:p"),
        *("event_direction:p", "event_terminal:p", "event_of_slope:p", "share:r"),
        *("blocks:i", "ends:i", "time_count:i", "break_count:i", "dose_count:i"),
        *("event_count:i", "keep_all:i", "history:p"),
    )


def load() -> ctypes.CDLL:
    """The library, with the types of its procedures."""
    try:
        library = ctypes.CDLL(str(PATH))
    except OSError as problem:
        raise ImportError(f"{problem}; {ADVICE}") from None
    handle, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int
    to_handle = ctypes.POINTER(handle)
    types = {
        "dk_open": (number, [text, text, to_handle, text, number]),
        "dk_close": (None, [handle]),
        "dk_free": (None, [handle]),
        "dk_unit_of_time": (ctypes.c_double, [handle, ctypes.POINTER(Request)]),
        "dk_delays": (None, [handle, handle, handle, ctypes.POINTER(number)]),
        "dk_values": (handle, [handle, text, ctypes.POINTER(number)]),
        "dk_describe": (number, [handle, text, number]),
        "dk_methods": (number, [text, number]),
        "dk_integrate": (number, [handle, ctypes.POINTER(Request), to_handle, text, number]),
        "dk_linearise": (number, [handle, ctypes.POINTER(Request), to_handle, text, number]),
        "dk_command": (number, [handle, text, text, to_handle, text, number]),
        "dk_watch": (None, [number]),
        "dk_stop": (None, [number]),
    }
    for name, (result, arguments) in types.items():
        procedure = getattr(library, name)
        procedure.restype, procedure.argtypes = result, arguments
    return library


LIBRARY = load()


def open_object(path: Path, network: str = "") -> ctypes.c_void_p:
    """The handle of a compiled model. network: the path of the file of its nodes and edges."""
    handle, message = ctypes.c_void_p(), ctypes.create_string_buffer(MESSAGE)
    paths = str(path).encode(), network.encode()
    if LIBRARY.dk_open(*paths, ctypes.byref(handle), message, MESSAGE):
        raise RunError(message.value.decode(errors="replace"))
    return handle


def lines_of(procedure, *arguments) -> list[list[str]]:
    """Lines that a procedure writes, in words. Its last arguments: room, and its size."""
    length = procedure(*arguments, None, 0) + 1
    text = ctypes.create_string_buffer(length)
    procedure(*arguments, text, length)
    return [line.split("\t") for line in text.value.decode(errors="replace").splitlines()]


class Results:
    """Results that the library holds; their arrays are copies."""

    def __init__(self, handle: ctypes.c_void_p):
        self.handle = handle

    def __del__(self):
        LIBRARY.dk_free(self.handle)

    def values(self, name: str, kind=np.float64) -> np.ndarray:
        """A variable as a row of numbers; empty if there is none of this name."""
        length = ctypes.c_int()
        held = LIBRARY.dk_values(self.handle, name.encode(), ctypes.byref(length))
        values = np.empty(length.value if held else 0, kind)
        if held:
            ctypes.memmove(address(values), held, values.nbytes)
        return values

    def description(self) -> list[list[str]]:
        """The lines of dk_describe, in words."""
        return lines_of(LIBRARY.dk_describe, self.handle)


def call(procedure, *arguments) -> Results:
    """Results of a procedure that ends with the arguments result, message and length."""
    handle, message = ctypes.c_void_p(), ctypes.create_string_buffer(MESSAGE)
    # Ctrl-C ends the call if this is the main thread; Python raises then as usual
    watched = threading.current_thread() is threading.main_thread()
    try:
        if watched:
            LIBRARY.dk_watch(1)
        failed = procedure(*arguments, ctypes.byref(handle), message, MESSAGE)
    finally:
        if watched:
            LIBRARY.dk_watch(0)
    results = Results(handle)
    if failed:
        text = message.value.decode(errors="replace")
        raise (RunInterruptedError if text.endswith("interrupted") else RunError)(text, results)
    return results


def address(array: np.ndarray | None) -> int | None:
    """Where the numbers of an array begin."""
    return None if array is None else array.ctypes.data

# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions of this package. A message says what is wrong, the value met, and what is expected."""

import difflib
from collections.abc import Iterable


class DelaykitError(Exception):
    """Any error of this package."""


class ModelError(DelaykitError, ValueError):
    """What is wrong with a definition, a parameter, a history or an option."""


class CompilerError(DelaykitError, RuntimeError):
    """There is no compiler, or it failed."""


class RunError(DelaykitError, RuntimeError):
    """The solver or a method stopped, in its own words. `partial` holds what was reached."""

    def __init__(self, message: str, partial=None):
        super().__init__(message)
        self.partial = partial

    def __reduce__(self):
        return type(self), (self.args[0], self.partial)


class RunInterruptedError(RunError):
    """A run that was asked to stop."""


def check_name(what: str, name, known: Iterable[str]) -> None:
    """Raise ModelError if a name is none of those known; name the nearest."""
    known = list(known)
    if name in known:
        return
    near = difflib.get_close_matches(str(name), known, n=1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    raise ModelError(f"{what} {name!r}; expected one of {', '.join(known)}{hint}")

# SPDX-License-Identifier: BSD-3-Clause
"""Events: passages of a state, or of its slope, through a level."""

import re
from dataclasses import dataclass

from delaykit.errors import ModelError

WRITTEN = re.compile(r"\s*(\w+(?:\[\d+\])?)\s*('?)\s*=\s*(\S+)\s*(rising|falling)?\s*(stop)?\s*\Z")


@dataclass(frozen=True)
class Event:
    """A passage of `state` (nondimensional unless the model says otherwise) through `level`.

    direction: 1 rising, -1 falling, 0 both. of_slope: the slope passes the level, so level 0
    falling is a maximum. terminal: the first such event ends the run.
    """

    state: str
    level: float = 0.0
    direction: int = 0
    of_slope: bool = False
    terminal: bool = False

    @classmethod
    def read(cls, text: "str | Event") -> "Event":
        """An event from words such as "y = 1 rising" or "y' = 0 falling stop"."""
        if isinstance(text, Event):
            return text
        found = WRITTEN.match(str(text))
        try:
            level = float(found[3])
        except (TypeError, ValueError):
            raise ModelError(
                f"event {text!r}; expected STATE = NUMBER or STATE' = NUMBER, then rising or "
                "falling, then stop where it ends the run"
            ) from None
        direction = {"rising": 1, "falling": -1, None: 0}[found[4]]
        return cls(found[1], level, direction, found[2] == "'", found[5] == "stop")

"""How the tests of the config spoil it and read the refusal."""

import math
import re
from collections.abc import Iterator

import pytest

from scripts.config.check_config import checked
from scripts.config.read_config import ConfigError

NO_NUMBERS = ["0.5", True, None, [0.5], {"a": 0.5}, math.nan, math.inf, -math.inf]
Place = tuple[str | int, ...]
"""Keys, and places in lists, that lead to a value."""


def put(config: dict, path: Place, value) -> None:
    """Set the value at a place of a config."""
    for key in path[:-1]:
        config = config[key]
    config[path[-1]] = value


def take_out(config: dict, path: Place) -> None:
    """Remove the key at a place of a config."""
    for key in path[:-1]:
        config = config[key]
    del config[path[-1]]


def numbers_in(value, path: Place = ()) -> Iterator[Place]:
    """Places of all numbers, of a list the last one."""
    if isinstance(value, dict | list):
        items = value.items() if isinstance(value, dict) else [*enumerate(value)][-1:]
        for key, item in items:
            yield from numbers_in(item, (*path, key))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path


def rounds(ranges: dict[Place, tuple[str, list]]) -> list[dict[Place, tuple]]:
    """The first value of each place with the words of its range, the second of each, and so on."""
    longest = max(len(values) for _, values in ranges.values())
    return [
        {path: (values[i], words) for path, (words, values) in ranges.items() if i < len(values)}
        for i in range(longest)
    ]


def apart(paths: list[Place]) -> list[list[Place]]:
    """The places in groups; in a group no two stand in the same section, and none in another."""
    groups: list[list[Place]] = []
    for path in paths:
        free = (
            group
            for group in groups
            if not any(path[: len(one) - 1] == one[:-1] or one == path[: len(one)] for one in group)
        )
        group = next(free, None)
        if group is None:
            groups.append([path])
        else:
            group.append(path)
    return groups


def place_of(path: Place) -> str:
    """How a refusal calls a place."""
    if path[:1] == ("scenes",) and len(path) > 1:
        return " ".join([f"scene '{path[1]}'", *map(str, path[2:])])
    return " ".join(["config", *map(str, path)])


def refusal(config: dict) -> str:
    """The words with which a config is refused."""
    with pytest.raises(ConfigError) as caught:
        checked(config)
    return str(caught.value)


def line_about(words: str, key: str) -> str:
    """The one line of a refusal that is about a key."""
    (line,) = [line for line in words.splitlines() if f"{key} = " in line or f"{key}) = " in line]
    return line


def assert_refused(config: dict, spoiled: dict[Place, tuple]) -> None:
    """Each of these values gets one line with place, key, value and range, and nothing else does.

    `spoiled` holds the value and the words of the range.
    """
    for path, (value, _) in spoiled.items():
        put(config, path, value)
    lines = refusal(config).splitlines()[1:]
    for path, (value, words) in spoiled.items():
        key = rf"{re.escape(place_of(path[:-1]))}: {path[-1]}(?: \(\w+\))?"
        start = re.compile(rf"{key} = {re.escape(repr(value))}; expected (.*)")
        found = [match[1] for match in map(start.match, lines) if match]
        assert len(found) == 1, (path, value, lines)
        assert words in found[0], (path, value)
    assert len(lines) == len(spoiled)

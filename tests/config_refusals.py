"""How the tests of the config spoil it and read the refusal."""

import math

import pytest

from scripts.config.check_config import checked
from scripts.config.read_config import ConfigError

NO_NUMBERS = ["0.5", True, None, [0.5], {"a": 0.5}, math.nan, math.inf, -math.inf]


def put(config: dict, path: tuple[str, ...], value) -> None:
    """Set the value at a place of a config."""
    for key in path[:-1]:
        config = config[key]
    config[path[-1]] = value


def out_of_range(ranges: dict) -> list[tuple]:
    """Each key with each of its values out of range."""
    return [(key, value, words) for key, (words, values) in ranges.items() for value in values]


def refusal(config: dict) -> str:
    """The words with which a config is refused."""
    with pytest.raises(ConfigError) as caught:
        checked(config)
    return str(caught.value)


def line_about(words: str, key: str) -> str:
    """The one line of a refusal that is about a key."""
    (line,) = [line for line in words.splitlines() if f"{key} = " in line or f"{key}) = " in line]
    return line

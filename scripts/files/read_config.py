"""Read configuration files by the rules of YAML 1.2, in which 1e-9 is a number and 010 is ten."""

import copy
import json
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from snakemake.utils import update_config

MOST_VALUES, DEEPEST = 100_000, 50
"""The largest configuration: values, each alias counted as what it stands for, and levels of
nesting. With aliases a file of a kilobyte can stand for millions."""


class ConfigError(ValueError):
    """All that is wrong with a configuration, one line each."""


def read(path: str | Path) -> dict:
    """The keys and values of a file; raise ConfigError naming file and line of a problem."""
    path = Path(path)
    try:
        # a pipe may be silent, a device endless
        if path.exists() and not path.is_file():
            raise ConfigError(f"{path}: is no regular file; write its text to a file")
        text = path.read_text(encoding="utf-8")
    except OSError as problem:
        raise ConfigError(f"{path}: cannot be read: {problem.strerror}") from None
    except UnicodeDecodeError as problem:
        raise ConfigError(f"{path}: {problem}; expected text in UTF-8") from None
    values = parse(text, str(path))
    if values is None:
        raise ConfigError(f"{path}: the file is empty")
    if not isinstance(values, dict):
        raise ConfigError(f"{path}: {values!r}; expected keys with values below them")
    check_size(values, str(path))
    return values


def parse(text: str, source: str = "text"):
    """The value that a text stands for; raise ConfigError naming its source and the line."""
    try:
        # YAML takes the two halves of a rare character for two characters
        if source.endswith(".json"):
            return json.loads(text)
        return YAML(typ="safe", pure=True).load(text)
    except RecursionError:
        raise ConfigError(f"{source}: nested too deep; expected {DEEPEST} levels at most") from None
    except MarkedYAMLError as problem:
        mark = problem.problem_mark or problem.context_mark
        words = f"{problem.problem} {problem.context or ''}".strip()
        raise ConfigError(f"{source}, line {mark.line + 1}: {words}") from None
    except (YAMLError, ValueError) as problem:
        raise ConfigError(f"{source}: {' '.join(str(problem).split())}") from None


def check_size(config: dict, source: str) -> None:
    """Raise ConfigError, with its key, for an entry that is too large or holds itself."""
    known: dict[int, tuple[int, int]] = {}
    open_ones = set()

    def measure(value, depth: int) -> tuple[int, int]:
        """Values and levels of a value."""
        if not isinstance(value, dict | list):
            return 1, 0
        if id(value) in open_ones or depth > DEEPEST:
            raise OverflowError
        if id(value) not in known:
            open_ones.add(id(value))
            inside = value.values() if isinstance(value, dict) else value
            sizes, levels = zip((1, 0), *(measure(one, depth + 1) for one in inside), strict=True)
            known[id(value)] = sum(sizes), 1 + max(levels)
            open_ones.remove(id(value))
        size, levels = known[id(value)]
        if size > MOST_VALUES or depth + levels > DEEPEST:
            raise OverflowError
        return size, levels

    for key, value in config.items():
        try:
            measure(value, 1)
        except OverflowError:
            raise ConfigError(
                f"{source}: {key}: too large or an alias of itself; expected at most {MOST_VALUES} "
                f"values, with aliases written out, and {DEEPEST} levels"
            ) from None


def read_overlay(settings) -> dict:
    """What Snakemake was given by --configfile and --config. It reads files by YAML 1.1 itself."""
    return merge({}, *map(read, settings.configfiles), dict(settings.config))


def merge(config: dict, *overlays: dict) -> dict:
    """A configuration with others merged over it in turn, as Snakemake does it."""
    whole = copy.deepcopy(config)
    for overlay in overlays:
        update_config(whole, copy.deepcopy(overlay))
    return whole

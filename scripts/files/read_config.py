"""Read configuration files by the rules of YAML 1.2, in which 1e-9 is a number and 010 is ten."""

import copy
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from snakemake.utils import update_config


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
    return values


def parse(text: str, source: str = "text"):
    """The value that a text stands for; raise ConfigError naming its source and the line."""
    try:
        return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as problem:
        mark = problem.problem_mark or problem.context_mark
        words = f"{problem.problem} {problem.context or ''}".strip()
        raise ConfigError(f"{source}, line {mark.line + 1}: {words}") from None
    except (YAMLError, ValueError) as problem:
        raise ConfigError(f"{source}: {' '.join(str(problem).split())}") from None


def merge(config: dict, *overlays: dict) -> dict:
    """A configuration with others merged over it in turn, as Snakemake does it."""
    whole = copy.deepcopy(config)
    for overlay in overlays:
        update_config(whole, copy.deepcopy(overlay))
    return whole

"""Read configuration files by the rules of YAML 1.2, in which 1e-9 is a number and 010 is ten."""

import copy
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from snakemake.utils import update_config


class ConfigError(ValueError):
    """All that is wrong with a configuration, one line each."""


def read(path: str | Path) -> dict:
    """What a file says; raise ConfigError naming file and line where it cannot be read."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except OSError as problem:
        raise ConfigError(f"{path}: cannot be read: {problem.strerror}") from None
    except UnicodeDecodeError as problem:
        raise ConfigError(f"{path}: {problem}; expected text in UTF-8") from None
    said = parsed(text, str(path))
    if not isinstance(said, dict):
        raise ConfigError(f"{path}: {said!r}; expected keys with values below them")
    return said


def parsed(text: str, source: str = "text"):
    """The value that a text stands for; raise ConfigError naming its source and the line."""
    try:
        return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as problem:
        mark = problem.problem_mark or problem.context_mark
        words = f"{problem.problem} {problem.context or ''}".strip()
        raise ConfigError(f"{source}, line {mark.line + 1}: {words}") from None
    except (YAMLError, ValueError) as problem:
        raise ConfigError(f"{source}: {' '.join(str(problem).split())}") from None


def merged_over(config: dict, overlay: dict) -> dict:
    """A configuration with another one merged over it, as Snakemake does it."""
    whole = copy.deepcopy(config)
    update_config(whole, copy.deepcopy(overlay))
    return whole


def merged(files: list[str | Path], entries: list[str]) -> dict:
    """Files merged one over the other as Snakemake does it, then entries KEY=VALUE."""
    config = {}
    for path in files:
        update_config(config, read(path))
    for entry in entries:
        key, _, value = entry.partition("=")
        update_config(config, {key: parsed(value, f"--config {entry}")})
    return config

"""Targets that no rule makes: refused in one line, with the one that was probably meant."""

import re
from collections.abc import Iterable
from itertools import product
from pathlib import Path

from scripts.console.error_words import meant

CHOICE = re.compile(r"\{\w+,([\w|]+)\}")
"""A wildcard of a path that stands for one of some words."""


def problem_of(targets: Iterable[str], rules: Iterable) -> str | None:
    """What is wrong with the first target that is neither there nor made by a rule."""
    rules = list(rules)
    for target in sorted(map(str, targets)):
        if not Path(target).exists() and not any(rule.is_producer(target) for rule in rules):
            known = [rule.name for rule in rules if not rule.has_wildcards()]
            known += [path for rule in rules for path in paths_of(rule)]
            return (
                f"no rule makes '{target}'{meant(target, known)}"
                " (./reproduce --list shows all targets)"
            )
    return None


def paths_of(rule) -> list[str]:
    """Paths that a rule makes, one for each word that its wildcards may stand for."""
    return [path for pattern in rule.output for path in choices(str(pattern))]


def choices(pattern: str) -> list[str]:
    """All paths of a pattern; none where a wildcard may stand for any word."""
    *parts, last = CHOICE.split(pattern)
    if "{" in "".join([*parts[::2], last]):
        return []
    words = [part.split("|") if at % 2 else [part] for at, part in enumerate(parts)]
    return ["".join(chosen) + last for chosen in product(*words)]

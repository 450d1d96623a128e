"""Read configuration files by the rules of YAML 1.2, in which 1e-9 is a number and 010 is ten."""

import copy
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    CollectionEndEvent,
    CollectionStartEvent,
    NodeEvent,
    ScalarEvent,
)
from ruamel.yaml.nodes import ScalarNode
from ruamel.yaml.parser import Parser
from snakemake.utils import update_config

MOST_BYTES = 200_000
"""Size of a file; that of the project's longest one is 34 000."""
MOST_ENTRIES = 10_000
"""Keys and values of a file, those that aliases stand for included; the project's have 2 300."""
DEEPEST = 20
"""Lists and mappings within each other; the project's files have 12."""


class ConfigError(ValueError):
    """All that is wrong with a configuration, one line each."""


class BoundedParser(Parser):
    """Refuses what is too large or too deep before anything is built of it, and 1_000.

    YAML 1.2 has no underscores in numbers; ruamel.yaml would leave them out.
    """

    def __init__(self, loader) -> None:
        """Nothing is counted yet."""
        super().__init__(loader)
        self.entries = 0
        self.unfinished = []
        self.entries_of_anchors = {}

    def get_event(self):
        """The next part of the file."""
        event = super().get_event()
        if isinstance(event, NodeEvent):
            self.count(event)
        elif isinstance(event, CollectionEndEvent):
            anchor, before = self.unfinished.pop()
            self.entries_of_anchors[anchor] = self.entries - before
        return event

    def count(self, event: NodeEvent) -> None:
        """Add a value to the entries; an alias stands for all entries of its anchor."""
        if isinstance(event, AliasEvent):
            if event.anchor in [anchor for anchor, _ in self.unfinished]:
                refuse(event, f"found *{event.anchor} inside of its own value &{event.anchor}")
            self.entries += self.entries_of_anchors.get(event.anchor, 0)
        else:
            self.entries += 1
        if self.entries > MOST_ENTRIES:
            refuse(event, f"found more than {MOST_ENTRIES} keys and values; divide the file")
        if isinstance(event, CollectionStartEvent):
            self.unfinished.append((event.anchor, self.entries - 1))
            if len(self.unfinished) > DEEPEST:
                refuse(event, f"found more than {DEEPEST} lists and mappings within each other")
        elif isinstance(event, ScalarEvent):
            self.entries_of_anchors[event.anchor] = 1
            tag = event.tag or self.loader.resolver.resolve(ScalarNode, event.value, event.implicit)
            if "_" in event.value and str(tag).endswith((":int", ":float")):
                refuse(event, f"found {event.value}; write a number without _, or text in quotes")


def refuse(event: NodeEvent, words: str) -> None:
    """Raise the error of YAML at this place."""
    raise MarkedYAMLError(problem=words, problem_mark=event.start_mark)


def read(path: str | Path) -> dict:
    """What a file says; raise ConfigError naming file and line where it cannot be read."""
    path = Path(path)
    try:
        # a pipe may be silent, a device endless
        if path.exists() and not path.is_file():
            raise ConfigError(f"{path}: is no regular file; write its text to a file")
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
        if len(content) > MOST_BYTES:
            raise ConfigError(f"{path}: larger than {MOST_BYTES} bytes; divide the file")
        text = content.decode()
    except OSError as problem:
        order = "" if path.suffix in (".yaml", ".yml") else "; a target stands before --configfile"
        raise ConfigError(f"{path}: cannot be read: {problem.strerror}{order}") from None
    except UnicodeDecodeError as problem:
        raise ConfigError(f"{path}: {problem}; expected text in UTF-8") from None
    said = parsed(text, str(path))
    if said is None:
        raise ConfigError(f"{path}: the file is empty")
    if not isinstance(said, dict):
        raise ConfigError(f"{path}: {said!r}; expected keys with values below them")
    # Snakemake itself uses this key before the configuration is checked
    if not isinstance(said.get("pathvars", {}), dict):
        raise ConfigError(
            f"{path}: pathvars = {said['pathvars']!r}; expected {{ results: results }}"
        )
    return said


def parsed(text: str, source: str = "text"):
    """The value that a text stands for; raise ConfigError naming its source and the line."""
    try:
        yaml = YAML(typ="safe", pure=True)
        yaml.Parser = BoundedParser
        return yaml.load(text)
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

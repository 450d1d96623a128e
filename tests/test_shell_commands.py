"""Shell commands of the rules: a value in place of a name in braces is one word of the shell."""

import re

import pytest
from conftest import ROOT

NUMBERS = {"threads"}
"""Names in braces whose values Snakemake itself makes, without characters of a shell."""
COMMANDS = [
    (path.name, command)
    for path in [ROOT / "Snakefile", *sorted((ROOT / "rules").glob("*.smk"))]
    for command in re.findall(r"^ +shell:\n((?: {8,}.*\n)+)", path.read_text(), re.MULTILINE)
]
"""Each command with the file of its rule."""


def unquoted(command: str) -> set[str]:
    """Names in braces without `:q`; doubled braces are for the shell."""
    names = re.findall(r"\{([^{}]*)\}", re.sub(r"\{\{|\}\}", "", command))
    return {name for name in names if not name.endswith(":q")} - NUMBERS


def test_every_command_is_found():
    texts = [path.read_text() for path in [ROOT / "Snakefile", *(ROOT / "rules").glob("*.smk")]]
    assert len(COMMANDS) == len(re.findall(r"\bshell\b\s*[:(]", "".join(texts))) > 2


@pytest.mark.parametrize(("file", "command"), COMMANDS)
def test_command_quotes_paths_and_texts(file, command):
    """A folder may hold spaces, a file what a shell would run."""
    assert unquoted(command) == set()

"""What cannot work of a run is refused before Snakemake looks for jobs."""

import sys
from difflib import get_close_matches
from pathlib import Path

from snakemake.cli import parse_args


def targets_of(argv: list[str]) -> list[str]:
    """Targets of the command line, as Snakemake reads it; none where another program is at work."""
    if Path(argv[0]).name != "snakemake":
        return []
    _, arguments = parse_args(argv[1:])
    return sorted(arguments.targets)


def problem_of(workflow, results: str, files: list[str]) -> str:
    """Why a run cannot work, in words; empty if it can.

    `files` are results by their paths, in which `<results>` stands for the folder `results`.
    """
    settings = workflow.resource_settings
    for name, number in (("--cores", settings.cores), ("--jobs", settings.nodes)):
        if isinstance(number, int) and number < 1:
            return f"{name} {number}; expected a whole number >= 1"
    known = [rule.name for rule in workflow.rules]
    for target in targets_of(sys.argv):
        if target in known or Path(target).exists():
            continue
        if not any(rule.is_producer(target) for rule in workflow.rules):
            paths = [path.replace("<results>", results) for path in files]
            near = get_close_matches(target, [*known, *paths], n=1, cutoff=0.5)
            hint = f"; the nearest one is {near[0]}" if near else ""
            listed = "(./reproduce --list-target-rules lists the targets)"
            return f"no target is named {target}{hint} {listed}"
    return ""

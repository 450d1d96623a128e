"""Namelists of the Fortran program."""

import io
from pathlib import Path

import f90nml

from scripts.files.outputs import written

HISTORIES = "histories"
"""The values before the initial time, which are many: a namelist group of their own."""


def text_of(groups: dict[str, dict]) -> str:
    """The text of a namelist file with these groups of values.

    The program reads them from one namelist group, &settings: there a key is `group%key`.
    Histories are a namelist group of their own.
    """
    lists = {HISTORIES: groups[HISTORIES]} if HISTORIES in groups else {}
    settings = {key: value for key, value in groups.items() if key not in lists}
    text = io.StringIO()
    f90nml.Namelist({"settings": settings, **lists}).write(text)
    return text.getvalue()


def write_namelist(path: Path, groups: dict[str, dict]) -> None:
    """Write groups of values; the file is complete or absent."""
    with written(path) as unfinished:
        unfinished.write_text(text_of(groups), encoding="utf-8")


def end_at_horizons(groups: dict[str, dict], rows: list[dict]) -> dict[str, dict]:
    """Cases that end at the times up to which runs can be compared, given by rows of a table."""
    horizons = {row["scene"]: row["horizon"] for row in rows}
    cases = [{**case, "t_end": horizons[case["name"]]} for case in groups["cases"]]
    return {**groups, "cases": cases}

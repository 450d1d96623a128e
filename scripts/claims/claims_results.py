"""Verdicts, and what they rest on: files in results/."""

from collections.abc import Mapping
from pathlib import Path

from scripts.files.inputs import Dataset, read
from scripts.files.tsv import read_table
from scripts.models.records import law_of
from scripts.plans import studies

REPRODUCED = "reproduced"
CORRECTED = "reproduced with a correction"
NOT_REPRODUCED = "not reproduced"
NOT_TESTABLE = "not testable"
VERDICTS = [REPRODUCED, CORRECTED, NOT_REPRODUCED, NOT_TESTABLE]
ANSWERS = {REPRODUCED: "yes", CORRECTED: "in part", NOT_REPRODUCED: "no"}
"""What a verdict is as the answer to a question of ours."""


def read_results(
    files: Mapping[str, str | list[str]], law: str | None = None
) -> dict[str, list[dict] | dict[str, Dataset]]:
    """Read the files, one or several of each kind, by the names of the data.

    Of a kind these are rows of tables, or data sets by the names of their files. Of a law alone if
    it is given: claims about it do not take results of another one.
    """
    given = {}
    for name, listed in files.items():
        paths = [listed] if isinstance(listed, str) else listed
        maker = studies.data()[name]
        if maker.output.endswith(".tsv"):
            rows = [row for path in paths for row in read_table(path)]
            one_law = None if maker.of_all_laws else law
            given[name] = [row for row in rows if one_law in (None, law_of(row))]
        else:
            data = {Path(path).stem: read(path) for path in paths}
            given[name] = {
                key: one for key, one in data.items() if law in (None, law_of(one.attrs))
            }
    return given

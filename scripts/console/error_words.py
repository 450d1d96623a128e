"""Errors of Snakemake in one line, and the word that was probably meant."""

import re
from collections.abc import Iterable
from difflib import get_close_matches

HEADER = re.compile(r"\w+(Error|Exception)( in file .*)?:")
"""The first line of an error of Snakemake's: its class and the place in the Snakefile."""


def meant(word: str, known: Iterable[str]) -> str:
    """`; did you mean 'figure_5'?`, or nothing where no known word is like this one."""
    close = get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f"; did you mean '{close[0]}'?" if close else ""


def in_one_line(message: str) -> str:
    """The reason in an error message of Snakemake's, without its class, place and traceback."""
    lines = [line.strip() for line in message.splitlines() if line.strip()]
    if any(line.startswith("Traceback (most recent call last)") for line in lines):
        # the last line begins with the class of the error
        lines = [re.sub(r"^\w+(\.\w+)*: ", "", lines[-1])]
    # places in the project's code
    lines = [line for line in lines if not re.match(r'File ".*", line \d+, in ', line)]
    if len(lines) > 1 and HEADER.fullmatch(lines[0]):
        lines = lines[1:]
    if len(lines) > 2 and lines[0].endswith(" is refused:"):
        lines[1:] = [f"({number}) {line}" for number, line in enumerate(lines[1:], start=1)]
    words = re.sub(r"^(error|\w+Error|\w+Exception): ", "", " ".join(lines), flags=re.IGNORECASE)
    return f"error: {words}"

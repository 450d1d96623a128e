"""Configuration files are read by YAML 1.2, and what cannot be read is named with its place."""

import json
import math
import os
from pathlib import Path
from types import SimpleNamespace

import pytest

from scripts.files.read_config import ConfigError, merge, parse, read, read_overlay
from scripts.workflow.plan import read_plan


def test_files_of_the_command_line_are_read_by_the_same_rules(tmp_path):
    """Snakemake reads 1e4 as text and 010 as 8; --config is merged over the files."""
    path = tmp_path / "mine.yaml"
    path.write_text("scenes: { mine: { t_end: 1e4, tau: 010, xi: 1 } }")
    settings = SimpleNamespace(configfiles=[path], config={"scenes": {"mine": {"xi": 2}}})
    assert read_overlay(settings) == {"scenes": {"mine": {"t_end": 1e4, "tau": 10, "xi": 2}}}


def test_page_of_a_failed_run_gets_every_character(tmp_path):
    path = tmp_path / "given.json"
    path.write_text(json.dumps({"failed": "\x1b \U0001f389"}))
    assert read(path) == {"failed": "\x1b \U0001f389"}


def aliases(times: int) -> bytes:
    """Sixty lists, each of so many aliases of the one before."""
    lines = [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * times)}]" for i in range(1, 60)]
    return "\n".join(["a0: &a0 [x]", *lines]).encode()


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("1e-10", 1e-10), ("1E3", 1000.0), ("-.5", -0.5), ("1.", 1.0), ("010", 10)),
        *(("0o10", 8), ("0x1F", 31), (".inf", math.inf), ("inf", "inf"), ("1:30", "1:30")),
        *(("yes", "yes"), ("off", "off"), ("true", True), ("null", None)),
    ],
)
def test_scalar_is_what_yaml_1_2_says(text, value):
    """PyYAML, which Snakemake uses, reads seven of these otherwise."""
    found = parse(f"a: {text}")["a"]
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b"a: 1\nb: 2\na: 3\n", ", line 3: found duplicate key"),
        (b"a: [1, 2\nx: 3\n", ", line 2: expected ',' or ']', but got ':'"),
        (b"a:\n\tb: 1\n", ", line 2: found character '\\t'"),
        (b"a: 1\nb: *c\n", ", line 2: found undefined alias"),
        (b"a: !!python/object:os.system 1\n", ", line 1: could not determine a constructor"),
        (b"a: 1\n---\nb: 2\n", ", line 2: but found another document"),
        (b"a: 2001-99-99\n", ": month must be in 1..12"),
        (b"a: \x00\n", ": unacceptable character"),
        (b"a: \xff\n", ": 'utf-8' codec can't decode byte 0xff in position 3"),
        (b"# only a comment\n", ": the file is empty"),
        (b"- a\n", ": ['a']; expected keys with values below them"),
        (aliases(9), ": a5: too large or an alias of itself; expected at most 100000 values"),
        (aliases(1), ": a49: too large or an alias of itself; expected at most 100000 values"),
        (b"a: &x [*x]\n", ": a: too large or an alias of itself"),
        (b"a: &x { b: *x }\n", ": a: too large or an alias of itself"),
        (b"a: " + b"[" * 1000 + b"]" * 1000, ": nested too deep; expected 50 levels at most"),
        (None, ": cannot be read: No such file or directory"),
    ],
)
def test_what_cannot_be_read_is_named_in_one_line(tmp_path, text, words):
    path = tmp_path / "mine.yaml"
    if text is not None:
        path.write_bytes(text)
    with pytest.raises(ConfigError) as caught:
        read(path)
    assert str(caught.value).startswith(f"{path}{words}")
    assert "\n" not in str(caught.value)


def test_size_of_what_snakemake_was_given_is_checked():
    """It has read it already."""
    given = {"scenes": []}
    given["scenes"].append(given["scenes"])
    with pytest.raises(ConfigError, match="--config or --configfile: scenes: too large"):
        read_plan(given)


def test_what_is_no_regular_file_is_refused(tmp_path):
    """A pipe into which nobody writes, a device without end, a folder, a link to one of them."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    for path in (tmp_path / "pipe", tmp_path / "link", Path("/dev/zero"), tmp_path):
        with pytest.raises(ConfigError, match=f"^{path}: is no regular file; write its text"):
            read(path)


def test_later_values_win():
    """Key by key, a list as a whole; what is merged stays as it was."""
    first, second = {"a": {"b": 1, "c": 2}, "d": [1, 2]}, {"a": {"b": 3}, "d": [4]}
    assert merge(first, second) == {"a": {"b": 3, "c": 2}, "d": [4]}
    assert first["d"] == [1, 2]

"""Configuration files are read by YAML 1.2, and what cannot be read is named with its place."""

import math
import os
from pathlib import Path

import pytest

from scripts.config.read_config import ConfigError, merged, parsed, read


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-10", 1e-10),
        ("1E3", 1000.0),
        ("-.5", -0.5),
        ("1.", 1.0),
        ("010", 10),
        ("0o10", 8),
        ("0x1F", 31),
        (".inf", math.inf),
        ("inf", "inf"),
        ("1:30", "1:30"),
        ("yes", "yes"),
        ("off", "off"),
        ("true", True),
        ("null", None),
    ],
)
def test_scalar_is_what_yaml_1_2_says(text, value):
    """PyYAML, which Snakemake uses, reads seven of these otherwise."""
    found = parsed(f"a: {text}")["a"]
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b"a: 1\nb: 2\na: 3\n", ", line 3: found duplicate key"),
        (b"a: {\n  b: 1, b: 2 }\n", ", line 2: found duplicate key"),
        (b"a: [1, 2\nx: 3\n", ", line 2: expected ',' or ']', but got ':'"),
        (b"a:\n\tb: 1\n", ", line 2: found character '\\t'"),
        (b"a: 1\n  b: 2\n", ", line 2: mapping values are not allowed here"),
        (b"a: 1\nb: *c\n", ", line 2: found undefined alias"),
        (b"a: !!python/object:os.system 1\n", ", line 1: could not determine a constructor"),
        (b"a: 1\n---\nb: 2\n", ", line 2: but found another document"),
        (b"a: 2001-99-99\n", ": month must be in 1..12"),
        (b"a: \x00\n", ": unacceptable character"),
        (b"a: \xff\n", ": 'utf-8' codec can't decode byte 0xff in position 3"),
        (b"a: 1_000\n", ", line 1: found 1_000; write a number without _"),
        (b"a: 1\nb: [2, 1_0.5e3]\n", ", line 2: found 1_0.5e3; write a number without _"),
        (b"a: !!int 1_0\n", ", line 1: found 1_0; write a number without _"),
        (b"a: 1\nb: &b\n  c: *b\n", ", line 3: found *b inside of its own value &b"),
        (b"a: &a [1, *a]\n", ", line 1: found *a inside of its own value &a"),
        (b"a: " + b"[" * 20 + b"]" * 20, ", line 1: found more than 20 lists and mappings"),
        (b"{a: " * 100_000, ": larger than 200000 bytes"),
        (b"{a: " * 40_000, ", line 1: found more than 20 lists and mappings"),
        (b"- 1\n" * 10_001, ", line 10000: found more than 10000 keys and values"),
        (b"a: 1\n# " + b"x" * 200_000, ": larger than 200000 bytes; divide the file"),
        (b"pathvars: 5\n", ": pathvars = 5; expected { results: results }"),
        (b"pathvars:\n", ": pathvars = None; expected { results: results }"),
        (b"", ": the file is empty"),
        (b"# only a comment\n", ": the file is empty"),
        (b"- a\n", ": ['a']; expected keys with values below them"),
        (None, ": cannot be read: No such file or directory"),
    ],
)
def test_what_cannot_be_read_is_named_in_one_line(tmp_path, text, words):
    """File, line where there is one, and what is wrong."""
    path = tmp_path / "mine.yaml"
    if text is not None:
        path.write_bytes(text)
    with pytest.raises(ConfigError) as caught:
        read(path)
    assert str(caught.value).startswith(f"{path}{words}")
    assert "\n" not in str(caught.value)


def test_target_in_place_of_a_file_is_explained(tmp_path):
    """Snakemake takes all words after --configfile for files."""
    words = "cannot be read: No such file or directory; a target stands before --configfile"
    with pytest.raises(ConfigError, match=words):
        read(tmp_path / "figure_6")


def test_aliases_count_with_what_they_stand_for():
    """Ten lists of ten aliases each, in turn, stand for 10^10 values."""
    lines = ["a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 10)]
    assert parsed("\n".join(lines[:3]))["a2"][9][9] == [1] * 10
    with pytest.raises(ConfigError, match="line 4: found more than 10000 keys and values"):
        parsed("\n".join(lines))


@pytest.mark.parametrize("text", ["'1_000'", "_", "tau_1", "_1_"])
def test_text_with_underscores_stays_text(text):
    """In quotes, and where no number is meant."""
    assert parsed(f"a: {text}")["a"] == text.strip("'")


def test_what_is_no_regular_file_is_refused(tmp_path):
    """A pipe into which nobody writes, a device without end, a folder, a link to one of them."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    for path in (tmp_path / "pipe", tmp_path / "link", Path("/dev/zero"), tmp_path):
        with pytest.raises(ConfigError, match=f"^{path}: is no regular file; write its text"):
            read(path)


def test_later_files_and_entries_win(tmp_path):
    """Key by key, a list as a whole; an entry of the command line is YAML as well."""
    for name, text in (("one", "{a: {b: 1, c: 2}, d: [1, 2]}"), ("two", "{a: {b: 3}, d: [4]}")):
        (tmp_path / name).write_text(text)
    config = merged([tmp_path / "one", tmp_path / "two"], ["a={c: 1e-9}", "e=x=y"])
    assert config == {"a": {"b": 3, "c": 1e-9}, "d": [4], "e": "x=y"}


def test_broken_entry_is_named():
    """With what was written."""
    with pytest.raises(ConfigError, match=r"^--config a=\[1, line 1: "):
        merged([], ["a=[1"])

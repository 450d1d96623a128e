"""Configuration files are read by YAML 1.2, and what cannot be read is named with its place."""

import math

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
        (b"", ": None; expected keys with values below them"),
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

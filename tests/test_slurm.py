"""The profile for Slurm and the arithmetic of ./test slurm, without a cluster."""

import ast
import re

import pytest
from conftest import ROOT
from scaling import Run, projected_hours, report, start_up

from scripts.config.read_config import read


def profile() -> dict:
    """Settings of the profile."""
    return read(ROOT / "profiles" / "slurm" / "config.yaml")


def long_rules() -> set[str]:
    """Rules that become jobs of a cluster."""
    text = (ROOT / "rules" / "common.smk").read_text()
    (found,) = re.findall(r"^LONG_RULES = (\{.*?\})", text, flags=re.MULTILINE | re.DOTALL)
    return ast.literal_eval(found)


def test_jobs_of_the_cluster_ask_for_memory_and_time():
    """All of them and no other rule; and they are rules."""
    asked = profile()["set-resources"]
    assert set(asked) == long_rules()
    assert all(set(values) == {"mem_mb", "runtime"} for values in asked.values())
    rules = "".join(path.read_text() for path in (ROOT / "rules").glob("*.smk"))
    assert long_rules() <= set(re.findall(r"^rule (\w+):", rules, flags=re.MULTILINE))


def test_long_rules_are_measured():
    """Every one writes a benchmark, from which its resources are taken."""
    for path in (ROOT / "rules").glob("*.smk"):
        for name, body in re.findall(
            r"^rule (\w+):\n(.*?)(?=^\S|\Z)", path.read_text(), re.M | re.S
        ):
            assert name not in long_rules() or "benchmark:" in body


@pytest.fixture
def runs() -> list[Run]:
    """Sixty points in four parts: two workers are 1.5 times as fast as one."""
    return [Run(1, 60, 4, 60.0, 40.0), Run(2, 60, 4, 40.0, 44.0)]


def test_start_up_is_what_programs_do_not_take(runs):
    """20 s in four parts with one worker; with two, 80 s of workers less 44."""
    assert [start_up(run) for run in runs] == [5.0, 9.0]


def test_projection_counts_whole_rounds():
    """500 parts of 2000 points: 1000 s each at 1 s a point on two cores."""
    assert projected_hours(1.0, 80.0, 1) == pytest.approx(500 * 1080 / 3600)
    assert projected_hours(1.0, 80.0, 100) == pytest.approx(5 * 1080 / 3600)
    assert projected_hours(1.0, 80.0, 400) == pytest.approx(2 * 1080 / 3600)


def test_report_shows_its_arithmetic(runs):
    """Rates and their ratio, then each product with its factors."""
    lines = report(runs, 0.36, 500.0)
    assert [line.split() for line in lines[1:3]] == [
        ["1", "60", "4", "60.0", "0.67", "1.00", "1.00", "1.00"],
        ["2", "60", "4", "40.0", "0.73", "1.50", "1.50", "1.65"],
    ]
    text = "\n".join(lines)
    assert "1000000 x 0.360 s / 3600 = 100 core hours" in text
    assert "2000 x 0.360 s / 2 + 5.0 s = 365 s a part" in text
    assert "with 100 jobs at once: 5 x 365 s = 0.5 hours" in text

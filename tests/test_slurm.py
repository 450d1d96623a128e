"""The profile for Slurm, without a cluster."""

import ast
import re

from conftest import ROOT

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

"""The profile for Slurm, without a cluster."""

from conftest import ROOT

from scripts.config.read_config import read
from scripts.results.programs import RUNS


def test_jobs_of_the_cluster_ask_for_memory_and_time():
    """Every rule that takes minutes, and no other rule."""
    resources = read(ROOT / "profiles" / "slurm" / "config.yaml")["set-resources"]
    assert set(resources) == {run.rule for run in RUNS if run.takes_minutes}
    assert all(set(values) == {"mem_mb", "runtime"} for values in resources.values())

"""Planning a run: nothing is read twice, and nothing is loaded that draws, fits or derives."""

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

from conftest import SMOKE, project_files

COUNTING = """
import atexit, collections, json, os, sys
opened = collections.Counter()
def count(event, values):
    if event == "open" and isinstance(values[0], str):
        opened[os.path.abspath(values[0])] += 1
sys.addaudithook(count)
def write(descriptor=os.open(os.environ["COUNTS"], os.O_WRONLY | os.O_CREAT), write=os.write):
    write(descriptor, json.dumps([opened, sorted(sys.modules)]).encode())
atexit.register(write)
"""
"""Counts the files that a process opens, and names the modules that it has loaded."""
HEAVY = {"matplotlib", "scipy.linalg", "powerlaw", "sympy", "xarray", "pandas"}


def test_dry_run_opens_no_file_of_the_project_more_than_three_times(fresh, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(COUNTING)
    counts = tmp_path / "counts.json"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "COUNTS": str(counts)}
    command = [Path(sys.executable).parent / "snakemake", "--dry-run", "--quiet", "all", *SMOKE]
    run = subprocess.run(command, cwd=fresh.folder, env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    opened, modules = json.loads(counts.read_text())
    files = {fresh.folder / name for name in project_files()}
    own = Counter({path: n for path, n in opened.items() if Path(path) in files})
    assert len(own) > 100
    assert [(path, n) for path, n in own.most_common(5) if n > 3] == []
    assert HEAVY & set(modules) == set()

"""The benchmarks where they need no other solver: errors, ratios, workers, tables, pictures."""

import math
import os
import re
import subprocess
import sys

import cycles
import dense
import measuring
import numpy as np
import peers
import pictures
import pytest
import workers

from scripts.files.tsv import read_table

TASK = workers.Task((10.0, 0.5, 0.8, 0.8, 0.0, 0.0, 0.25), 1.0, 0.5)
RUN = workers.HERE / "run"


def stand_in(script: str) -> list[str]:
    """The command of a solver that is a few lines of Python."""
    return [sys.executable, "-u", "-c", f"import sys, time\ntask = input()\n{script}"]


POINTS = [(1e-4, 1.0), (1e-6, 4.0)]


@pytest.mark.parametrize(
    ("level", "points", "expected"),
    [
        # between two points the time is logarithmic
        (1e-5, POINTS, 2.0),
        # an easy level costs the loosest point
        (1e-2, POINTS, 1.0),
        # a level that is not reached has no time
        (1e-7, POINTS, math.nan),
        # of two ways to one error the cheaper one counts
        (1e-5, [(1e-3, 1.0), (1e-5, 2.0), (1e-4, 3.0), (1e-6, 8.0)], 2.0),
    ],
)
def test_time_at_an_error(level, points, expected):
    assert measuring.cost_at(level, points) == pytest.approx(expected, nan_ok=True)


def test_ratios_are_of_runs_that_ended_well():
    """At equal error time over ours, also of single turns; a solver that stopped has none."""
    runs = [
        ("ours", "ok", 1e-4, [1.0, 2.0, 1.0]),
        ("ours", "ok", 1e-8, [2.0, 4.0, 2.0]),
        ("slow", "ok", 1e-4, [20.0, 20.0, 30.0]),
        ("slow", "ok", 1e-8, [60.0, 60.0, 60.0]),
        ("bad", "stopped", 1e-9, [1.0]),
    ]
    names = ("solver", "status", "error_max", "turns")
    rows = [dict(zip(names, run, strict=True)) | {"seconds": min(run[-1])} for run in runs]
    row = measuring.ratio_row(rows, "slow", 1e-4)
    assert list(row.values()) == pytest.approx([1.0, 20.0, 10.0, 30.0, math.nan], nan_ok=True)
    assert measuring.ratio_row(rows, "slow", 1e-8)["ratio"] == pytest.approx(30.0)
    assert math.isnan(measuring.ratio_row(rows, "slow", 1e-9)["ratio"])
    assert math.isnan(measuring.ratio_row(rows, "bad", 1e-8)["ratio"])
    counted = [row | {"instructions": 10 if row["solver"] == "ours" else 25} for row in rows]
    assert measuring.ratio_row(counted, "slow", 1e-4)["instructions"] == 2.5


def test_error_is_the_largest_of_all_samples():
    """Relative where the reference is above 1; samples that are missing or late have none."""
    reference = np.array([[0.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0], [1.0, -10.0, 0.0, 0.0]])
    samples = reference.copy()
    samples[1, 3] = 0.125
    assert measuring.error_max(samples, reference) == 0.125
    samples[2, 1] += 5.0
    assert measuring.error_max(samples, reference) == 0.5
    assert math.isnan(measuring.error_max(samples[:2], reference))
    for value in (math.nan, 0.6):
        samples[1, 0] = value
        assert math.isnan(measuring.error_max(samples, reference))


def test_worker_answers_and_says_why_not():
    """Other output is left out; after an answer that took too long it starts again."""
    script = "print('hello')\nprint('answer: 1.2 3.5')\nfor line in sys.stdin:\n"
    script += "    _, runs, path = line.split()\n    time.sleep(60 if runs == '9' else 0)\n"
    script += "    if runs == '0':\n        open(path, 'w').write('1 2\\n3 4\\n')\n"
    script += "    print('answer: ' + ('0 too stiff for me' if runs == '8' else '0.5 ok'))"
    with workers.Worker(stand_in(script), TASK) as worker:
        assert worker.seconds(1e-3, 7, 30.0) == 0.5
        assert (worker.version, worker.set_up_seconds) == ("1.2", 3.5)
        assert 0 <= worker.memory() < 100
        table, seconds = worker.numbers(1e-3, 30.0)
        assert (table.tolist(), seconds) == ([[1.0, 2.0], [3.0, 4.0]], 0.5)
        with pytest.raises(workers.SolverError, match="too stiff for me"):
            worker.seconds(1e-3, 8, 30.0)
        with pytest.raises(workers.TimeLimitError, match=r"longer than 0\.2 s"):
            worker.seconds(1e-3, 9, 0.2)
        assert worker.seconds(1e-3, 7, 30.0) == 0.5
    with workers.Worker(stand_in("sys.exit(3)")) as worker:
        with pytest.raises(workers.SolverError, match="ended by itself with status 3"):
            worker.seconds(1e-3, 1, 30.0)


def test_worker_in_python_keeps_to_the_protocol(tmp_path):
    """What it prints is no answer; a task that fails says why; a fresh process counts its start."""
    task = "lambda words, numbers, t_end, interval: lambda tolerance, wanted: "
    task += "print('noise') or [[float(words[0]), *numbers, t_end, 1/tolerance]]"
    script = f"import serving\nserving.serve('2.0', {{'other': None, 'mine': {task}}})"
    (tmp_path / "mine_worker.py").write_text(script)
    words = f"import runpy, sys; sys.path.append('{RUN.parent / 'solvers'}'); del sys.argv[0]; "
    command = [sys.executable, "-c", f"{words} runpy.run_path(sys.argv[0])"]
    command += [str(tmp_path / "mine_worker.py"), "mine", "5"]
    with workers.Worker(command, workers.Task((7.0,), 9.0)) as worker:
        assert worker.numbers(0.5, 30.0)[0].tolist() == [[5.0, 7.0, 9.0, 2.0]]
        with pytest.raises(workers.SolverError, match="division by zero"):
            worker.numbers(0.0, 30.0)
        warm = worker.seconds(0.5, 3, 30.0)
        worker.fresh = True
        assert worker.seconds(0.5, 1, 30.0) > warm
        assert worker.clock > warm


def test_solvers_take_turns_and_the_median_counts():
    """The first turn does not; a run that fails leaves its row without an error."""
    script = "print('answer: 1')\nspent = iter([9, 1, 3, 2])\nfor line in sys.stdin:\n"
    script += "    fails = line.startswith('0.01')\n"
    script += "    print('answer: ' + ('0 too stiff' if fails else f'{next(spent)} ok'))"
    rows = [
        {"solver": "mine", "tolerance": tolerance, "status": "ok", "error_max": 1e-3}
        for tolerance in (0.1, 0.01)
    ]
    with workers.Worker(stand_in(script), TASK) as worker, pytest.MonkeyPatch.context() as patch:
        patch.setattr(measuring, "LONG_SECONDS", 10.0)
        measuring.time_in_turns(rows, {"mine": worker}, 3, 30.0)
    assert (rows[0]["turns"], rows[0]["seconds"]) == ([1.0, 3.0, 2.0], 2.0)
    assert rows[1]["status"] == "too stiff"
    assert math.isnan(rows[1]["error_max"])


def test_solver_that_is_missing_says_what_it_needs(monkeypatch):
    monkeypatch.setitem(workers.SOLVERS, "radar5", workers.Solver("none", "--hairer FOLDER"))
    with pytest.raises(SystemExit, match="radar5 is missing; it needs --hairer FOLDER"):
        workers.command_of("radar5")


def test_solvers_are_those_for_the_problem():
    """Some know the block alone; each problem has a program, numbered as the compiler is told."""
    names = ["radar5", "retard", "jitcdde", "jitcdde_moving", "desolve"]
    wanted = {
        "torus": ["retard", "jitcdde", "desolve"],
        "gamma 1e6": ["radar5", "desolve"],
        "enzyme": ["radar5"],
        "waltman": ["radar5"],
        "paul": ["radar5", "retard", "jitcdde_moving"],
        "infection": ["retard"],
    }
    assert {one: peers.others_of(peers.CASES[one], names) for one in wanted} == wanted
    build = (workers.HERE / "CMakeLists.txt").read_text()
    problems = re.search(r"foreach\(problem ([\w\s]+)\)", build)[1].split()
    assert {case.problem for case in peers.CASES.values()} | {"cells"} == set(problems)
    files = {path.name for path in (workers.HERE / "solvers").glob("*_worker.*")}
    called = set(re.findall(r"solvers/(\w+\.\w+)", " ".join(map(str, workers.SOLVERS.values()))))
    assert {name for name in files if not name.endswith(".f90")} == called


def test_picture_is_drawn_of_a_table(tmp_path):
    rows = [
        {"case": "torus", "given": given, "solver": "retard", "error": 1e-3, "ratio": ratio}
        for given, ratio in (("series", 0.5), ("f", math.nan))
    ]
    measuring.write_table(tmp_path / "peers.tsv", rows, ["a header"])
    figure = pictures.draw(read_table(tmp_path / "peers.tsv"))
    [axes] = figure.axes
    assert [text.get_text() for text in axes.texts] == ["0.50"]
    assert [text.get_text() for text in axes.get_yticklabels()] == [
        "f: torus, retard",
        "series: torus, retard",
    ]


def test_error_of_dense_output_counts_by_the_run_where_it_is_worst():
    """Over the error at steps, or the tolerance if that is larger; a run that failed is counted."""
    errors = np.array([[1e-3, 1e-2], [1e-9, 1e-5], [2e-6, 4e-5], [math.nan, math.nan]])
    row = dense.worst(errors, 1e-6, np.array([1.0, 2.0, 3.0, 4.0]))
    assert list(row.values()) == pytest.approx([4, 1, 20.0, 3.0, 2e-6, 4e-5])


def test_cycles_of_a_worker_are_read():
    """Its branches together, then its special points."""
    script = "print('answer: 7')\nfor line in sys.stdin:\n    path = line.split()[2]\n"
    script += "    open(path, 'w').write('0 10 2e-9\\n1 .5 0\\n0 10 1e-6\\n2 .75 0\\n')\n"
    script += "    print('answer: 5 ok')"
    settings = {"along": "tau", "window": [1, 2], "epsilon": 1, "xi": 1, "gamma": 1}
    row, points = cycles.follow("mine", stand_in(script), "a line", settings, 30.0)
    assert list(row.values()) == ["a line", "mine", 20, 0.25, 1e-6]
    assert points == [("fold", 0.5), ("torus", 0.75)]


def test_special_points_are_paired_by_kind_and_place():
    """The nearest of one kind; a point that one of the two has alone keeps its row."""
    ours = [("fold", 0.5), ("torus", 0.75)]
    theirs = [("fold", 0.5004), ("fold", 0.5000001), ("period_doubling", 0.75)]
    rows = [[*row.values()][1:] for row in cycles.side_by_side("a line", ours, theirs)]
    assert [row[:3] for row in rows] == [
        ["fold", "0.5", "0.5000001"],
        ["torus", "0.75", ""],
        ["fold", "", "0.5004"],
        ["period_doubling", "", "0.75"],
    ]
    differences = [row[3] for row in rows]
    assert differences == pytest.approx([1e-7, *[math.nan] * 3], nan_ok=True)


def run(*words, path: str = "") -> subprocess.CompletedProcess:
    """The command, which is refused before anything is set up."""
    environment = {**os.environ, "PATH": f"{path}:{os.environ['PATH']}"}
    done = subprocess.run([RUN, *words], env=environment, capture_output=True, text=True)
    assert done.returncode != 0
    return done


def test_what_is_missing_is_said_before_anything_is_set_up(tmp_path):
    """Packages of Debian, which are installed on request alone, and sources of Hairer."""
    for name in ("radar5", "contr5", "decsol", "retard"):
        (tmp_path / f"{name}.f").touch()
    missing = f"benchmarks: {tmp_path}/dc_decdel.f is missing\n"
    assert run("peers", "--hairer", tmp_path).stderr == missing
    assert "benchmarks/run NAME" in run("nothing").stderr
    (tmp_path / "dpkg-query").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "dpkg-query").chmod(0o755)
    assert "r-cran-desolve; --install installs them" in run("peers", path=tmp_path).stderr


def test_every_benchmark_is_listed():
    """Each module that begins to measure has its line of help."""
    named = set(re.findall(r"^  (\w+) +\S", RUN.read_text(), re.MULTILINE)) - {"build"}
    modules = (path for path in RUN.parent.glob("*.py") if "\ndef main(" in path.read_text())
    assert {path.stem for path in modules} == named

"""The benchmarks where they need no other solver: ratios, scenes, workers, tables."""

import math
import os
import re
import subprocess
import sys

import chains
import cycles
import dense
import measuring
import numpy as np
import peers
import picture
import pytest
import work_precision
import workers

SCENE = workers.Scene(
    tau=10.0,
    epsilon=0.5,
    xi=0.8,
    gamma=0.8,
    past=(0.0, 0.0, 0.25),
    t_end=1.0,
    sample_interval=0.5,
)


def stand_in(script: str) -> list[str]:
    """The command of a solver that is a few lines of Python."""
    return [sys.executable, "-u", "-c", f"import sys, time\nscene = input()\n{script}"]


POINTS = [(1e-4, 1.0), (1e-6, 4.0)]


@pytest.mark.parametrize(
    ("level", "points", "expected"),
    [
        # between two points the time is logarithmic
        (1e-5, POINTS, 2.0),
        (1e-6, POINTS, 4.0),
        # an easy level costs the loosest point
        (1e-2, POINTS, 1.0),
        # a level that is not reached has no time
        (1e-7, POINTS, None),
        (1e-7, [], None),
        # of two ways to one error the cheaper one counts
        (1e-5, [(1e-3, 1.0), (1e-5, 2.0), (1e-4, 3.0), (1e-6, 8.0)], 2.0),
    ],
)
def test_time_at_an_error(level, points, expected):
    assert work_precision.cost_at(level, points) == (expected and pytest.approx(expected))


def test_ratios_are_of_runs_that_ended_well():
    """A solver that stopped has none; at equal error time over ours."""
    runs = [
        ("ours", "ok", 1e-4, 1.0),
        ("ours", "ok", 1e-8, 2.0),
        ("slow", "ok", 1e-4, 20.0),
        ("slow", "ok", 1e-8, 60.0),
        ("bad", "stopped", 1e-9, 1.0),
    ]
    names = ("solver", "status", "error_max", "seconds")
    rows = [dict(zip(names, run, strict=True)) for run in runs]
    assert work_precision.ratios(rows, 1e-4) == {"our_seconds": 1.0, "slow": 20.0, "bad": None}
    found = work_precision.ratios(rows, 1e-8)
    assert (found["slow"], found["bad"]) == (pytest.approx(30.0), None)
    assert work_precision.ratios(rows, 1e-9)["slow"] is None


def test_error_is_the_largest_of_all_samples():
    """Relative where the reference is above 1; samples that are missing or late have none."""
    reference = np.array([[0.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0], [1.0, -10.0, 0.0, 0.0]])
    samples = reference.copy()
    assert work_precision.error_max(samples, reference) == 0.0
    samples[1, 3] = 0.125
    assert work_precision.error_max(samples, reference) == 0.125
    samples[2, 1] += 5.0
    assert work_precision.error_max(samples, reference) == 0.5
    assert math.isnan(work_precision.error_max(samples[:2], reference))
    for value in (math.nan, 0.6):
        samples[1, 0] = value
        assert math.isnan(work_precision.error_max(samples, reference))


def test_worker_answers_and_says_why_not():
    """Other output is left out; after an answer that took too long it starts again."""
    script = "print('hello')\nprint('answer: 1.2 3.5')\nfor line in sys.stdin:\n"
    script += "    time.sleep(60 if line.split()[1] == '9' else 0)\n    print('answer: '"
    script += " + ('0.5 ok' if line.split()[1] == '7' else '0 too stiff for me'))"
    with workers.Worker(stand_in(script), SCENE) as worker:
        assert worker.seconds(1e-3, 7, 30.0) == 0.5
        assert (worker.version, worker.set_up_seconds) == ("1.2", 3.5)
        assert 1 < workers.peak_memory_of(worker.process) < 1000
        with pytest.raises(workers.SolverError, match="too stiff for me"):
            worker.seconds(1e-3, 8, 30.0)
        with pytest.raises(workers.TimeLimitError, match=r"longer than 0\.2 s"):
            worker.seconds(1e-3, 9, 0.2)
        assert worker.seconds(1e-3, 7, 30.0) == 0.5


@pytest.mark.parametrize("blocks", [1, 3])
def test_chain_is_the_same_for_both_solvers(blocks):
    """For JiTCDDE theta, u and ln v of one block after another."""
    apart = {"theta": 0.1, "u": 0.2, "ln_v": 0.3}
    chain = chains.settings_of(blocks, 0.8, disturbance=apart)
    groups, worker = chains.groups_of(chain, 1e-6), chains.jitcdde_worker(chain, 50.0)
    assert groups["scene"]["model"]["blocks"] == blocks
    assert worker.command[-3:] == ["1.0", "free", "40.0"]
    *parameters, t_end, interval = map(float, worker.scene.line().split())
    assert (*parameters[:4], t_end, interval) == (10.0, 0.5, 0.8, 0.8, 50.0, 0.5)
    past = np.reshape(parameters[4:], (blocks, 3))
    names, values = groups["histories"]["names"], groups["histories"]["values"]
    assert names == ["theta", "u", "v"]
    theirs = np.column_stack([past[:, :2], np.exp(past[:, 2])])
    np.testing.assert_allclose(theirs.ravel(), values, rtol=1e-15)
    assert np.unique(past).size == 3 * blocks


def test_solver_that_is_missing_says_what_it_needs(monkeypatch):
    monkeypatch.setitem(workers.SOLVERS, "radar5", workers.Solver(["none"], "--hairer FOLDER"))
    monkeypatch.setitem(workers.SOLVERS, workers.OURS, workers.Solver([sys.executable]))
    with pytest.raises(SystemExit, match="radar5 is missing; it needs --hairer FOLDER"):
        workers.chosen_solvers(["radar5"])


def test_solvers_are_given_what_the_cell_says(monkeypatch):
    """RADAR5 gets derivatives where this solver has more than f, deSolve f of the block alone."""
    asked = []

    def measure(pair, *_):
        asked.append([worker.command for worker in pair.values()])
        return [{"solver": name, "status": "failed"} for name in pair]

    monkeypatch.setattr(peers, "measure", measure)
    monkeypatch.setattr(workers.Worker, "samples", lambda *_: np.zeros((1, 4)))
    rows = peers.cell_rows("gamma 1e6", "series", ["radar5", "desolve"], 1, 30.0, count=False)
    assert [row["solver"] for row in rows] == [
        solver for solver in ("radar5", "desolve") for _ in peers.LEVELS
    ]
    [(ours, radar5, desolve)] = asked
    assert ours[1:] == ["auto", "series"]
    assert radar5[1:] == ["jacobian"]
    assert desolve == workers.SOLVERS["desolve"].command
    peers.cell_rows("enzyme", "f", ["radar5"], 1, 30.0, count=False)
    assert [command[0].rsplit("/")[-1] for command in asked[1]] == ["dde_enzyme", "radar5_enzyme"]
    assert asked[1][1][1:] == ["f"]


def test_spread_is_that_of_single_turns():
    turns = {"ours": [1.0, 2.0, 1.0], "other": [2.0, 2.0, 3.0]}
    rows = [
        {"solver": name, "status": "ok", "error_max": 1e-5, "turns": found}
        for name, found in turns.items()
    ]
    assert work_precision.spread(rows, 1e-4, "other") == (1.0, 3.0)
    assert work_precision.spread(rows, 1e-6, "other") is None


def test_worst_cells_are_shown_first(capsys):
    rows = [
        {"case": name, "given": "f", "solver": "retard", "error": level}
        | {"ratio": ratio, "least": ratio, "most": ratio}
        for name, ratio in (("torus", 2.0), ("chaos", 0.5), ("infection", None))
        for level in peers.LEVELS
    ]
    peers.show(rows)
    _, title, _, *lines = capsys.readouterr().out.splitlines()
    assert title == "retard over this solver, f: geometric mean 1.00, least 0.50"
    assert [line.split()[0] for line in lines] == ["chaos", "torus", "infection"]
    assert lines[0].split()[1:3] == ["0.50", "(0.50-0.50)"]


def test_picture_is_drawn_of_a_table(tmp_path, monkeypatch):
    """And the program that writes the table is named where there is none."""
    monkeypatch.setattr(sys, "argv", ["picture.py", "--output", str(tmp_path)])
    with pytest.raises(SystemExit, match=r"peers\.tsv is missing; run peers writes it"):
        picture.main()
    rows = [
        {"case": "torus", "given": given, "solver": "retard", "error": 1e-3, "ratio": ratio}
        for given, ratio in (("series", 0.5), ("f", None))
    ]
    measuring.write_table(tmp_path / "peers.tsv", rows, ["a header"])
    picture.main()
    assert (tmp_path / "peers.png").stat().st_size > 1000


def test_packages_of_debian_are_installed_on_request_alone(tmp_path):
    (tmp_path / "dpkg-query").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "dpkg-query").chmod(0o755)
    run = subprocess.run(
        [measuring.HERE.parents[2] / "benchmarks" / "run"],
        env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    assert "r-cran-desolve; --install installs them" in run.stderr


def test_problems_of_other_solvers_are_known():
    """Each case has a program; its number is the one that the compiler is given."""
    build = (measuring.HERE / "CMakeLists.txt").read_text()
    names = re.search(r"foreach\(problem ([\w ]+)\)", build)[1].split()
    assert {case.problem for case in peers.CASES.values()} == set(names)


def test_error_of_dense_output_counts_by_the_run_where_it_is_worst():
    """Over the error at steps, or the tolerance if that is larger; a run that failed is counted."""
    errors = np.array([[1e-3, 1e-2], [1e-9, 1e-5], [2e-6, 4e-5], [math.nan, math.nan]])
    row = dense.worst(errors, 1e-6, np.array([1.0, 2.0, 3.0, 4.0]))
    assert list(row.values()) == pytest.approx([4, 1, 20.0, 3.0, 2e-6, 4e-5])


@pytest.mark.parametrize("layer", ["decay", "switch"])
def test_error_of_scipy_is_that_of_its_solution(layer):
    """BDF follows layers without delay."""
    assert max(dense.their_errors("BDF", layer, 1e-9, 10.0)) < 1e-7


def test_run_of_scipy_that_stalls_fails(monkeypatch):
    monkeypatch.setattr(dense, "MOST_EVALUATIONS", 10)
    assert np.isnan(dense.their_errors("BDF", "decay", 1e-9, 10.0)).all()


def test_answer_of_biftool_is_read():
    said = (
        "BR_CONTN warning: boundary hit.\nbranch 10 4.0 1.0 2e-9\nfold 0.5 6.25\n\n"
        "branch 10 2.0 1.0 1e-6\ntorus 0.75 8.5\n"
    )
    row, points = cycles.read_answer("a line", said)
    assert list(row.values()) == ["a line", "DDE-BIFTOOL", 20, 0.4, 1e-6]
    assert points == [("fold", 0.5), ("torus", 0.75)]
    assert cycles.read_answer("a line", "nothing")[0]["seconds_per_orbit"] is None


def test_special_points_are_paired_by_kind_and_place():
    """The nearest of one kind; a point that one of the two has alone keeps its row."""
    ours = [("fold", 0.5), ("torus", 0.75)]
    theirs = [("fold", 0.5004), ("fold", 0.5000001), ("period_doubling", 0.75)]
    rows = [tuple(row.values())[1:] for row in cycles.side_by_side("a line", ours, theirs)]
    assert rows == [
        ("fold", "0.5", "0.5000001", pytest.approx(1e-7)),
        ("torus", "0.75", "", None),
        ("fold", "", "0.5004", None),
        ("period_doubling", "", "0.75", None),
    ]


def test_folder_without_biftool_is_refused(monkeypatch, tmp_path, capsys):
    """Before anything is computed."""
    monkeypatch.setattr(sys, "argv", ["cycles.py", "--biftool", str(tmp_path)])
    with pytest.raises(SystemExit):
        cycles.main()
    assert f"{tmp_path}: a folder with ddebiftool/br_contn.m expected" in capsys.readouterr().err


def test_folder_without_a_source_of_radar5_is_refused(tmp_path):
    """In one line, before anything is set up."""
    for name in ("radar5", "contr5", "decsol", "retard"):
        (tmp_path / f"{name}.f").touch()
    command = [measuring.HERE / "run", "peers", "--hairer", tmp_path]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr == f"benchmarks: {tmp_path}/dc_decdel.f is missing\n"

"""The benchmarks where they need no other solver: ratios, scenes, workers, tables."""

import dataclasses
import math
import subprocess
import sys

import compare
import cycles
import exponents
import measuring
import numpy as np
import pytest
import solvers
from conftest import ROOT, write_script

from scripts.files.tsv import read_table
from scripts.tables.accuracy import Reference

SCENE = solvers.Scene(
    name="torus",
    tau=10.0,
    epsilon=0.5,
    xi=0.8,
    gamma=0.8,
    past=(0.0, 0.0, 0.25),
    t_end=1.0,
    sample_interval=0.5,
)


@pytest.fixture
def reference() -> Reference:
    """Zero but for a large theta at the end, and longer than the scene."""
    state = np.zeros((3, 4))
    state[0, 2] = -10.0
    return Reference(
        status="ok",
        time=0.5 * np.arange(4.0),
        state=state,
        uncertainty=np.zeros(4),
        amplification=np.ones(4),
    )


def samples_of(reference: Reference) -> np.ndarray:
    """Samples of a run over the scene without errors."""
    return np.column_stack([reference.time, reference.state.T])[:3]


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
    """From errors and seconds in the order of their tolerances."""
    assert compare.seconds_at(level, points) == (expected and pytest.approx(expected))


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
    rows = [{"scene": "torus", **dict(zip(names, run, strict=True))} for run in runs]
    found = compare.ratio_rows(rows, ["slow", "bad"])
    assert [row["error"] for row in found] == pytest.approx([10.0**-k for k in range(4, 13)])
    assert (found[0]["our_seconds"], found[0]["slow"]) == (1.0, 20.0)
    assert found[4]["slow"] == pytest.approx(30.0)
    assert [row["slow"] for row in found[5:]] == [None] * 4
    assert {row["bad"] for row in found} == {None}


def test_scenes_are_those_of_work_against_precision():
    """With their histories, up to when they can be trusted."""
    study = solvers.read_study()
    names = tuple(study["cases"])
    assert names == ("fixed_point", "oscillation", "torus", "chaos", "stick", "stiff")
    horizons = {name: 100.0 + i for i, name in enumerate(names)}
    torus, stiff = (solvers.scene_of(study, horizons, name) for name in ("torus", "stiff"))
    assert (torus.tau, torus.epsilon, torus.t_end, torus.sample_interval) == (10.0, 0.5, 102.0, 1.0)
    assert torus.past == (0.0, 0.0, math.log(1.1))
    assert stiff.line() == f"1 0.69999999999999996 0.5 1000000 0 0 {math.log(1.1):.17g} 105 1"


def test_reference_is_the_one_of_the_workflow(smoke, monkeypatch):
    """Under its name, with the start of the scene."""
    monkeypatch.setattr(solvers, "ROOT", smoke.folder)
    monkeypatch.setattr(solvers, "HORIZONS", smoke.folder / "results/tables/trusted-horizons.tsv")
    scene = solvers.scene_of(solvers.read_study(), solvers.read_horizons(), "torus")
    found = solvers.read_reference("torus")
    assert found.time[0] == 0.0
    assert found.time[-1] >= scene.t_end > 0.0
    assert found.state[:, 0] == pytest.approx(scene.past)


def test_error_is_the_largest_of_all_samples(reference):
    """Relative where the reference is above 1; its later samples do not count."""
    samples = samples_of(reference)
    assert solvers.error_max(samples, SCENE, reference) == 0.0
    samples[1, 3] = 0.125
    assert solvers.error_max(samples, SCENE, reference) == 0.125
    samples[2, 1] += 5.0
    reference.state[:, 3] = 9.0
    assert solvers.error_max(samples, SCENE, reference) == 0.5


@pytest.mark.parametrize(
    ("place", "value"), [((1, 0), math.nan), ((1, 2), math.nan), ((1, 0), 0.6)]
)
def test_samples_missing_or_at_other_times_have_no_error(reference, place, value):
    """A wrong number is not taken for an accurate one."""
    samples = samples_of(reference)
    assert math.isnan(solvers.error_max(samples[:2], SCENE, reference))
    samples[place] = value
    assert math.isnan(solvers.error_max(samples, SCENE, reference))


def test_worker_answers_and_says_why_not():
    """Other output is left out; its memory can be asked while it runs."""
    script = "print('hello')\nprint('answer: 1.2')\nfor line in sys.stdin:\n    print('answer: '"
    script += " + ('0.5 ok' if line.split()[1] == '7' else '0 too stiff for me'))"
    with solvers.Worker(stand_in(script), SCENE) as worker:
        assert worker.seconds(1e-3, 7, 30.0) == 0.5
        assert worker.version == "1.2"
        assert 1 < worker.peak_memory() < 1000
        with pytest.raises(solvers.SolverError, match="too stiff for me"):
            worker.seconds(1e-3, 8, 30.0)


def test_worker_starts_again_after_its_end():
    """After it ended by itself, and after it took too long."""
    script = "print('answer: 1')\nline = input()\nif line.split()[1] == '1':\n    sys.exit(3)\n"
    script += "if line.split()[1] == '2':\n    time.sleep(60)\nprint('answer: 0.5 ok')"
    with solvers.Worker(stand_in(script), SCENE) as worker:
        with pytest.raises(solvers.SolverError, match="status 3"):
            worker.seconds(1e-3, 1, 30.0)
        with pytest.raises(solvers.TimeLimitError, match=r"longer than 0\.2 s"):
            worker.seconds(1e-3, 2, 0.2)
        assert worker.seconds(1e-3, 3, 30.0) == 0.5


def test_no_tighter_tolerance_after_one_that_took_too_long(reference):
    """The other failures do not stop the series."""
    script = (
        "print('answer: 1')\nfor line in sys.stdin:\n    tolerance, runs, path = line.split()\n"
    )
    script += "    time.sleep(60 if tolerance == '1e-05' else 0)\n"
    script += "    value = 'nan' if tolerance == '0.0001' else '0.25'\n"
    script += "    open(path, 'w').write(f'0\\t0\\t0\\t{value}\\n')\n    print('answer: 0 ok')"
    start = dataclasses.replace(SCENE, t_end=0.0)
    with solvers.Worker(stand_in(script), start) as worker:
        rows = compare.measure_errors(worker, reference, 0.5)
    assert rows[0]["error_max"] == 0.25
    assert "not a number" in rows[1]["status"]
    assert rows[2]["status"] == "longer than 0.5 s"
    assert {row["status"] for row in rows[3:]} == {"not tried: 1e-05 took too long"}


def test_seconds_are_the_median_of_turns():
    """One that fails in its turn keeps its words and has no time; a long one is measured once."""
    scripts = {
        "good": "for n, line in enumerate(sys.stdin):\n    print('answer:', n, 'ok')",
        "bad": "for line in sys.stdin:\n    print('answer: 0 no more')",
        "long": "for n, line in enumerate(sys.stdin):\n    print('answer:', 10 + n, 'ok')",
    }
    row = {"tolerance": 1e-3, "status": "ok", "error_max": 1.0, "seconds": None}
    rows = [{"solver": name, **row} for name in scripts]
    workers = {
        name: solvers.Worker(stand_in(f"print('answer: 1')\n{script}"), SCENE)
        for name, script in scripts.items()
    }
    try:
        compare.measure_seconds(rows, workers, 5, 30.0)
    finally:
        for worker in workers.values():
            worker.stop()
    assert [one["status"] for one in rows] == ["ok", "no more", "ok"]
    assert [one["seconds"] for one in rows] == [3.0, None, 10.0]


@pytest.mark.parametrize(("seconds", "runs"), [(1.0, 1), (0.03, 4), (1e-3, 100), (0.0, 100)])
def test_short_runs_are_repeated(seconds, runs):
    """For about a tenth of a second."""
    assert compare.runs_of(seconds) == runs


def test_table_has_a_header_and_empty_cells(tmp_path):
    """Comments, names, four digits; line ends within words are gone."""
    rows = [{"a": 1.23456e-7, "b": None}, {"a": "two\nwords", "b": 3}]
    path = tmp_path / "new" / "table.tsv"
    measuring.write_table(path, rows, ["made here"])
    assert path.read_text() == "# made here\na\tb\n1.235e-07\t\ntwo words\t3\n"
    assert [row["a"] for row in read_table(path)] == [1.235e-7, "two words"]


def test_run_says_how_it_is_used(tmp_path):
    """From any folder, before anything is set up."""
    run = subprocess.run(
        [ROOT / "benchmarks" / "run", "--help"], cwd=tmp_path, capture_output=True, text=True
    )
    assert run.returncode == 0
    for option in ("output", "scenes", "solvers", "time-limit", "repeats", "biftool"):
        assert f"--{option} " in run.stdout


def test_answer_of_the_worker_is_read(monkeypatch, tmp_path):
    """The time, and a table of values and errors for each number of pieces."""
    lines = "read request\necho 100.0\n"
    lines += "for i in 1 2 3; do echo 1 1 $i 0.5 0.1; done\n"
    lines += "for piece in 1 2; do for i in 1 2 3; do echo 2 $piece $i 0.4 0.$i; done; done"
    write_script(tmp_path / "exponents_worker", lines)
    monkeypatch.setattr(exponents, "BUILD", tmp_path)
    passed, pieces = exponents.measure_pieces("cycle", [1, 2])
    assert passed == 100.0
    assert pieces[1].tolist() == [[[0.5, 0.1]] * 3]
    assert pieces[2][1].tolist() == [[0.4, 0.1], [0.4, 0.2], [0.4, 0.3]]


def test_command_that_fails_says_why(tmp_path):
    """In its own words."""
    write_script(tmp_path / "program", "echo stopped at t = 7 >&2\nexit 1")
    with pytest.raises(SystemExit, match="program: stopped at t = 7"):
        measuring.measure_command([tmp_path / "program"])


def test_answer_of_biftool_is_read():
    """Branches are added up; words of DDE-BIFTOOL are passed over."""
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

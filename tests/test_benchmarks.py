"""The benchmarks where they need no other solver: ratios, scenes, long runs, options, tables."""

import dataclasses
import math
import subprocess
import sys

import classes
import compare
import cycles
import exponents
import long_runs
import numpy as np
import pytest
import ratios
import scenes
import workers
import xarray as xr
from conftest import ROOT

from scripts.files.tsv import read_table
from scripts.tables.accuracy import Reference

SCENE = scenes.Scene(
    name="torus",
    tau=10.0,
    epsilon=0.5,
    xi=0.8,
    gamma=0.8,
    past=(0.0, 0.0, 0.25),
    t_end=1.0,
    sample_interval=0.5,
)
NAMES = ("fixed_point", "oscillation", "torus", "chaos", "stick", "stiff")


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
    """Those of a run over the scene without errors."""
    return np.column_stack([reference.time, reference.state.T])[:3]


def stand_in(script: str) -> list[str]:
    """The command of a solver that is a few lines of Python."""
    return [sys.executable, "-u", "-c", f"import sys, time\nscene = input()\n{script}"]


def test_time_between_points_is_logarithmic():
    """Halfway between 1e-4 and 1e-6 the time is the geometric mean."""
    points = [(1e-4, 1.0), (1e-6, 4.0)]
    assert ratios.seconds_at(1e-5, points) == pytest.approx(2.0)
    assert ratios.seconds_at(1e-6, points) == 4.0


def test_easy_level_costs_the_loosest_point():
    """No time is made up beyond the points."""
    assert ratios.seconds_at(1e-2, [(1e-4, 1.0), (1e-6, 4.0)]) == 1.0


def test_level_not_reached_has_no_time():
    """Nor has one without points."""
    assert ratios.seconds_at(1e-7, [(1e-4, 1.0), (1e-6, 4.0)]) is None
    assert ratios.seconds_at(1e-7, []) is None


def test_least_time_counts_where_errors_go_up_and_down():
    """Of two ways to one error the cheaper one."""
    points = [(1e-3, 1.0), (1e-5, 2.0), (1e-4, 3.0), (1e-6, 8.0)]
    assert ratios.seconds_at(1e-5, points) == 2.0


def test_ratios_are_of_runs_that_ended_well():
    """A solver that stopped has none; at equal error time over ours."""
    row = {"scene": "torus", "status": "ok"}
    rows = [
        {**row, "solver": "ours", "error_max": 1e-4, "seconds": 1.0},
        {**row, "solver": "ours", "error_max": 1e-8, "seconds": 2.0},
        {**row, "solver": "slow", "error_max": 1e-4, "seconds": 20.0},
        {**row, "solver": "slow", "error_max": 1e-8, "seconds": 60.0},
        {**row, "solver": "bad", "status": "stopped", "error_max": 1e-9, "seconds": 1.0},
    ]
    found = ratios.ratio_rows(rows, "ours", ["slow", "bad"])
    assert [row["error"] for row in found] == pytest.approx([10.0**-k for k in range(4, 13)])
    assert (found[0]["our_seconds"], found[0]["slow"]) == (1.0, 20.0)
    assert found[4]["slow"] == pytest.approx(30.0)
    assert [row["slow"] for row in found[5:]] == [None] * 4
    assert {row["bad"] for row in found} == {None}


def test_scenes_are_those_of_work_against_precision():
    """With their histories, up to when they can be trusted."""
    study = scenes.read_study()
    assert tuple(study["cases"]) == NAMES
    horizons = [{"scene": name, "horizon": 100.0 + i} for i, name in enumerate(NAMES)]
    found = {name: scenes.scene_of(study, horizons, name) for name in NAMES}
    torus = found["torus"]
    assert (torus.tau, torus.epsilon, torus.t_end, torus.sample_interval) == (10.0, 0.5, 102.0, 1.0)
    assert torus.past == (0.0, 0.0, math.log(1.1))
    assert found["stick"].past == found["chaos"].past == (0.0, 0.0, math.log(1.1))
    assert (
        found["stiff"].line() == f"1 0.69999999999999996 0.5 1000000 0 0 {math.log(1.1):.17g} 105 1"
    )


def test_reference_is_the_one_of_the_workflow(smoke, monkeypatch):
    """Under its name, with the start of the scene."""
    monkeypatch.setattr(scenes, "ROOT", smoke.folder)
    monkeypatch.setattr(scenes, "HORIZONS", smoke.folder / "results/tables/trusted-horizons.tsv")
    scene = scenes.scene_of(scenes.read_study(), scenes.read_horizons(), "torus")
    found = scenes.reference_of(scene)
    assert found.time[0] == 0.0
    assert found.time[-1] >= scene.t_end == 30.0
    assert found.state[:, 0] == pytest.approx(scene.past)


def test_error_is_the_largest_of_all_samples(reference):
    """Relative where the reference is above 1; its later samples do not count."""
    samples = samples_of(reference)
    samples[1, 3] = 0.125
    assert scenes.error_max(samples, SCENE, reference) == 0.125
    samples[2, 1] += 5.0
    assert scenes.error_max(samples, SCENE, reference) == 0.5
    reference.state[:, 3] = 9.0
    assert scenes.error_max(samples, SCENE, reference) == 0.5


def test_samples_missing_or_at_other_times_have_no_error(reference):
    """Nor have those that are not numbers."""
    samples = samples_of(reference)
    assert scenes.error_max(samples, SCENE, reference) == 0.0
    assert math.isnan(scenes.error_max(samples[:2], SCENE, reference))
    for place in ((1, 0), (1, 2)):
        spoiled = samples.copy()
        spoiled[place] = math.nan
        assert math.isnan(scenes.error_max(spoiled, SCENE, reference))
    samples[1, 0] = 0.6
    assert math.isnan(scenes.error_max(samples, SCENE, reference))


def test_long_runs_differ_in_their_last_time_only(tmp_path, monkeypatch):
    """Each in a process that is told scene and tolerance, and answers seconds, steps, memory."""
    program = tmp_path / "long_run"
    program.write_text('#!/bin/sh\nread line\necho "$line" >> said\necho 0.5 2500 3000\n')
    program.chmod(0o755)
    monkeypatch.setattr(long_runs, "BUILD", tmp_path)
    monkeypatch.chdir(tmp_path)
    rows = long_runs.rows_of_long_runs(SCENE)
    said = [line.split() for line in (tmp_path / "said").read_text().splitlines()]
    assert [line[7:] for line in said] == [[f"{10**k}", "0.5", "1e-08"] for k in range(3, 7)]
    assert all(set(row) == set(long_runs.COLUMNS) for row in rows)
    assert rows[0]["seconds_per_time"] == 5e-4
    assert (rows[0]["steps"], rows[0]["peak_memory_mb"]) == (2500, pytest.approx(3.072))


def test_long_run_that_stops_says_why(tmp_path, monkeypatch):
    """In its own words."""
    program = tmp_path / "long_run"
    program.write_text("#!/bin/sh\necho stopped at t = 7 >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setattr(long_runs, "BUILD", tmp_path)
    with pytest.raises(workers.SolverError, match="stopped at t = 7"):
        long_runs.rows_of_long_runs(SCENE)


def test_worker_answers_and_says_why_not():
    """What it says besides its answers is left out."""
    script = "print('hello')\nprint('answer: 1.2')\nfor line in sys.stdin:\n    print('answer: '"
    script += " + ('0.5 ok' if line.split()[1] == '7' else '0 too stiff for me'))"
    with workers.Worker(stand_in(script), SCENE) as worker:
        assert worker.seconds(1e-3, 7, 30.0) == 0.5
        assert worker.version == "1.2"
        with pytest.raises(workers.SolverError, match="too stiff for me"):
            worker.seconds(1e-3, 8, 30.0)


def test_worker_starts_again_after_its_end():
    """Whether it ended by itself or took too long."""
    script = "print('answer: 1')\nline = input()\nif line.split()[1] == '1':\n    sys.exit(3)\n"
    script += "if line.split()[1] == '2':\n    time.sleep(60)\nprint('answer: 0.5 ok')"
    with workers.Worker(stand_in(script), SCENE) as worker:
        with pytest.raises(workers.SolverError, match="status 3"):
            worker.seconds(1e-3, 1, 30.0)
        with pytest.raises(workers.TimeLimitError, match=r"longer than 0\.2 s"):
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
    with workers.Worker(stand_in(script), start) as worker:
        rows = compare.errors(worker, reference, 0.5)
    assert rows[0]["error_max"] == 0.25
    assert "not a number" in rows[1]["status"]
    assert rows[2]["status"] == "longer than 0.5 s"
    assert {row["status"] for row in rows[3:]} == {"not tried: 1e-05 took too long"}


def test_seconds_are_the_median_of_turns():
    """Solvers take turns; one that fails in its turn keeps its words and has no time."""
    good = "print('answer: 1')\nfor n, line in enumerate(sys.stdin):\n    print('answer:', n, 'ok')"
    bad = "print('answer: 1')\nfor line in sys.stdin:\n    print('answer: 0 no more')"
    rows = [
        {"solver": name, "tolerance": 1e-3, "status": "ok", "error_max": 1.0}
        for name in ("good", "bad")
    ]
    found = {
        name: workers.Worker(stand_in(script), SCENE)
        for name, script in (("good", good), ("bad", bad))
    }
    try:
        compare.measure(rows, found, 5, 30.0)
    finally:
        for worker in found.values():
            worker.stop()
    assert (rows[0]["status"], rows[0]["seconds"]) == ("ok", 3.0)
    assert rows[1]["status"] == "no more"
    assert "seconds" not in rows[1]


@pytest.mark.parametrize(
    ("seconds", "runs"), [(10.0, 0), (1.0, 1), (0.03, 4), (1e-3, 100), (0.0, 100)]
)
def test_short_runs_are_repeated(seconds, runs):
    """Long ones are measured once, by the run that showed their length."""
    assert compare.runs_of(seconds) == runs


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (["--scenes", "torus,nonsense"], "'nonsense'"),
        (["--solvers", "radau"], "'radau'"),
        (["--time-limit", "0"], "'0'"),
        (["--time-limit", "inf"], "'inf'"),
        (["--time-limit", "soon"], "'soon'"),
        (["--repeats", "1.5"], "'1.5'"),
        (["--repeats", "0"], "'0'"),
        (["nonsense"], "nonsense"),
    ],
)
def test_bad_options_are_refused(given, said, capsys):
    """With the option and the value met."""
    with pytest.raises(SystemExit) as refusal:
        compare.arguments(given, NAMES)
    assert refusal.value.code == 2
    assert said in capsys.readouterr().err


def test_options_choose_scenes_and_solvers():
    """In the order of the tables, each once."""
    options = compare.arguments(
        ["--scenes", "stiff,torus,stiff", "--solvers", "jitcdde,ours"], NAMES
    )
    assert options.scenes == ["torus", "stiff"]
    assert options.solvers == ["ours", "jitcdde"]


def test_table_has_a_header_and_empty_cells(tmp_path):
    """Comments, names, four digits; line ends within words are gone."""
    rows = [{"a": 1.23456e-7, "b": None}, {"a": "two\nwords"}]
    compare.write_table(tmp_path / "new" / "table.tsv", ["a", "b"], rows, ["made here"])
    text = (tmp_path / "new" / "table.tsv").read_text()
    assert text == "# made here\na\tb\n1.235e-07\t\ntwo words\t\n"
    assert [row["a"] for row in read_table(tmp_path / "new" / "table.tsv")] == [
        1.235e-7,
        "two words",
    ]


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_run_says_how_it_is_used(option, tmp_path):
    """From any folder, before anything is set up, with every option."""
    run = subprocess.run(
        [ROOT / "benchmarks" / "run", option], cwd=tmp_path, capture_output=True, text=True
    )
    assert run.returncode == 0
    options = compare.arguments([], NAMES)
    assert all(f"--{name.replace('_', '-')} " in run.stdout for name in vars(options))


def growth_of(logarithm) -> dict:
    """Growth of one vector over intervals of uneven length, by the logarithm of its norm."""
    edges = 5.0 * np.arange(1001.0) + 0.2 * np.sin(np.arange(1001.0) ** 2)
    return {"growth": np.diff(logarithm(edges))[:, None], "length": np.diff(edges)}


def test_constant_growth_is_its_own_mean():
    """In each piece, with either weights."""
    for smooth in (False, True):
        values = exponents.means(growth_of(lambda t: 0.25 * t), 4, smooth)
        assert values == pytest.approx(np.full((4, 1), 0.25))


def test_smooth_ends_take_out_a_swing():
    """To a hundredth of what level weights leave of it."""
    swings = growth_of(lambda t: np.sin(0.1 * t))
    level, smooth = (exponents.rms(exponents.means(swings, 4, each)) for each in (False, True))
    assert 1e-5 < level < 1e-2
    assert smooth < level / 100


def test_answer_of_the_worker_is_read(monkeypatch, tmp_path):
    """Seconds, time, and a table of values and errors for each number of pieces."""
    script = tmp_path / "exponents_worker"
    script.write_text(
        "#!/bin/sh\nread request\necho 2.0 100.0\necho 1 1 1 0.5 0.1\necho 1 1 2 -0.5 0.2\n"
        "for piece in 1 2; do echo 2 $piece 1 0.4 0.3; echo 2 $piece 2 -0.4 0.4; done\n"
    )
    script.chmod(0o755)
    monkeypatch.setattr(exponents, "BUILD", tmp_path)
    seconds, passed, pieces = exponents.ours(exponents.CHAOS, 1e-8, 100.0, 2, [1, 2], True)
    assert (seconds, passed) == (2.0, 100.0)
    assert pieces[1].tolist() == [[[0.5, 0.1], [-0.5, 0.2]]]
    assert pieces[2][1].tolist() == [[0.4, 0.3], [-0.4, 0.4]]


def attractors_of(found: list[int], maxima: list[float]) -> xr.Dataset:
    """Points with these classes and smallest maxima."""
    run = xr.Dataset({"class": ("point", found), "smallest_maximum": ("point", maxima)})
    run["class"].attrs["flag_meanings"] = "undecided fixed_point cycle torus chaos"
    return run


def test_classes_are_compared_where_both_are_known():
    """Undecided points are counted by themselves; a point at rest has no spurious maximum."""
    found = attractors_of([0, 1, 2, 3, 4], [1.0, 0.0, 1e-6, 0.5, 0.5])
    best = attractors_of([2, 1, 2, 4, 0], [1.0] * 5)
    assert classes.row_of(1e-6, 10.0, found, best) == {
        "tolerance": 1e-6,
        "seconds_per_point": 2.0,
        "undecided": 1,
        "other_class": 1,
        "spurious_maxima": 1,
    }


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
    """The nearest of one kind; what one of the two has alone keeps its row."""
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

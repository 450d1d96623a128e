"""Progress: nothing when short, otherwise a line after a second and one every 5 per cent."""

import re
import signal
import subprocess
import time
from typing import IO

import pytest

from conftest import Programs

TOLD = re.compile(
    r"trajectory of torus \(about 33 MB before compression\): "
    r"(\d+) %, (\d+) of (\d+), (?:\d+ (?:h|min) )?\d+ (?:min|s) (left|in all)"
)
"""A line of progress: per cent, samples done, samples in all."""


@pytest.fixture
def long_run(programs, good_inputs) -> Programs:
    """Programs beside the namelist of a trajectory of about a second."""
    long = {**good_inputs["trajectory"], "t_end": 1e6, "sample_interval": 0.5, "variables": ["v"]}
    programs.write({"scene": long})
    return programs


def held_up_run(programs: Programs, stderr: int | IO[str]) -> subprocess.Popen[str]:
    """A trajectory that was stopped until it has something to say, on a fast machine too."""
    run = programs.begin("trajectory", stderr=stderr, text=True)
    time.sleep(0.1)
    run.send_signal(signal.SIGSTOP)
    time.sleep(2.5)
    run.send_signal(signal.SIGCONT)
    return run


def numbers_in(lines: list[str]) -> list[tuple[int, int, int]]:
    """Per cent, done and total of lines, all of which tell of progress."""
    found = [TOLD.fullmatch(line) for line in lines]
    assert all(found), lines
    return [tuple(map(int, match.groups()[:3])) for match in found]


def test_log_gets_a_line_every_five_per_cent(long_run):
    """Done and total make the per cent; the last line says how long it took."""
    run = held_up_run(long_run, subprocess.PIPE)
    lines = run.communicate(timeout=60)[1].splitlines()
    assert run.returncode == 0
    told = numbers_in(lines)
    assert len(told) >= 2
    assert [percent // 5 for percent, *_ in told] == list(range(21 - len(told), 21))
    assert all(percent == 100 * done // total for percent, done, total in told)
    assert {total for *_, total in told} == {2000001}
    assert [line.endswith(" in all") for line in lines] == [False] * (len(lines) - 1) + [True]


def test_forecast_comes_at_once(programs, good_inputs):
    """Of a run of hours, long before its first 5 per cent."""
    endless = {**good_inputs["trajectory"], "t_end": 1e9, "sample_interval": 500.0}
    programs.write({"scene": {**endless, "variables": ["v"]}})
    with programs.begin("trajectory", stderr=subprocess.PIPE, text=True) as run:
        (told,) = numbers_in([run.stderr.readline().rstrip("\n")])
        run.kill()
    assert told[0] == 0
    assert told[2] == 2000001


def test_standard_error_that_takes_nothing_does_not_stop_the_work(long_run):
    """A log on a full disk: the result is whole."""
    with open("/dev/full", "w") as full:
        run = held_up_run(long_run, full)
    assert run.wait(timeout=60) == 0
    assert long_run.left_behind() == ["output.nc"]

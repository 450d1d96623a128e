"""What ./reproduce shows: a line of progress, the words of failing jobs, errors of one line."""

import os
import pty
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import ROOT, wait_for
from disks import READ_ONLY, on_disk

from scripts.console.error_words import in_one_line
from scripts.console.run_progress import how_far

SNAKEFILE = """
from scripts.workflow import snakemake_internals
snakemake_internals.make_missing_files_again()
rule all:
    input: "results/index.html"
rule figure:
    output: "results/figures/figure_5.pdf"
    log: "results/logs/figure_5.log"
    shell: "echo '[1/4] x' > {log}; echo 'a warning' >&2; sleep 1; touch {output}"
rule page:
    input: "results/figures/figure_5.pdf"
    output: page="results/index.html", claims="results/claims.json"
    shell: "cp claims {output.claims}; touch {output.page}"
rule bad:
    output: "results/bad.nc"
    log: "results/logs/bad.log"
    shell: "echo 'error: it cannot go on' >&2; exit 1"
rule long:
    output: "results/{scene,torus|chaos}.nc"
    shell: '''python3 -c "from time import sleep; open('begun', 'w'); sleep(60)"'''
"""
CLAIMS = '[{"verdict": "reproduced"}, {"verdict": "not reproduced"}, {"verdict": "reproduced"}]'
FIRST = r"(\d+ jobs?); all messages are in (\.snakemake/log/\S+)"
"""What a run begins with."""


@pytest.fixture
def workflow(tmp_path) -> Path:
    """A folder with a workflow of jobs that succeed, fail and take long."""
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    (tmp_path / "claims").write_text(CLAIMS)
    return tmp_path


def command(*arguments: str) -> list[str]:
    """What ./reproduce calls after the set-up."""
    script = ROOT / "scripts" / "console" / "reproduce.py"
    return [sys.executable, str(script), "--cores", "2", *arguments]


def lines_of(folder: Path, *arguments: str) -> tuple[int, list[str]]:
    """Exit status and lines on standard error, which is not a terminal."""
    run = subprocess.run(
        command(*arguments), cwd=folder, stderr=subprocess.PIPE, text=True, timeout=300
    )
    assert re.search(r"[\r\x1b]", run.stderr) is None
    return run.returncode, run.stderr.splitlines()


def on_a_terminal(folder: Path) -> tuple[int, str]:
    """Exit status of a run, and what a terminal of 60 columns receives."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        ["bash", "-c", 'stty cols 60 && exec "$@"', "bash", *command()],
        cwd=folder,
        stdin=theirs,
        stderr=theirs,
        env={**os.environ, "TERM": "xterm"},
    ) as run:
        os.close(theirs)
        received = b""
        try:
            while some := os.read(ours, 1024):
                received += some
        except OSError:
            pass  # the other end was closed
        os.close(ours)
    return run.returncode, received.decode().replace("\r\n", "\n")


def test_terminal_gets_one_line_of_progress_and_the_end(workflow):
    """Cut to the width; words of jobs stay; at the end verdicts, time and page."""
    status, received = on_a_terminal(workflow)
    assert status == 0
    *shown, last = received.split("\r\x1b[K")
    progress = [text.rpartition("\n")[2] for text in shown[1:]]
    # between two jobs none is named
    assert all(re.match(r"\[[= ]{20}\] [0-3] of 3 jobs, \d+ s(: |$)", text) for text in progress)
    named = [text for text in progress if ": " in text]
    assert re.match(r"\[ {20}\] 0 of 3 jobs, \d+ s: figures/fig", named[0])
    assert max(map(len, named)) == 59
    assert re.search(rf"(?m)^{FIRST}$", received)
    assert {"a warning", "made results/figures/figure_5.pdf"} <= set(
        received.replace("\r\x1b[K", "\n").split("\n")
    )
    counted, took, page = last.splitlines()
    assert counted == ("3 claims: 2 reproduced, 1 not reproduced; see results/claims.tsv")
    assert re.fullmatch(r"done in \d+ s", took)
    assert page == "open results/index.html"


def test_page_is_named_only_where_it_was_asked_for(workflow):
    """Where nothing is to be done, too; by its path from the user's folder."""
    figure, page = "results/figures/figure_5.pdf", "open results/index.html"
    status, lines = lines_of(workflow, figure)
    assert status == 0
    assert re.fullmatch(FIRST, lines[0])
    assert lines[1:3] == ["a warning", f"made {figure}"]
    assert re.fullmatch(r"done in \d+ s", lines[3])
    assert len(lines) == 4
    assert lines_of(workflow)[1][-1] == page
    elsewhere = workflow.parent
    places = (f"--snakefile={workflow}/Snakefile", f"--directory={workflow}")
    page = f"open {workflow.name}/results/index.html"
    assert lines_of(elsewhere, *places) == (0, ["nothing to do: all results are up to date", page])


def test_failing_job_is_shown_with_its_words_and_log(workflow):
    """The words are in the log of the run too."""
    status, lines = lines_of(workflow, "bad")
    assert status == 1
    first = re.fullmatch(FIRST, lines[0])
    assert first[1] == "1 job"
    assert lines[1:3] == [
        "error: it cannot go on",
        "failed: results/bad.nc (rule bad); log: results/logs/bad.log",
    ]
    assert re.fullmatch(rf"1 job failed after \d+ s; all messages are in {first[2]}", lines[3])
    assert len(lines) == 4
    log = (workflow / first[2]).read_text()
    assert "error: it cannot go on" in log
    assert "rule bad:" in log


def test_interrupted_run_says_how_to_continue(workflow):
    """Ctrl-C reaches Snakemake and its jobs; where those were is in the log of the run."""
    run = subprocess.Popen(
        command("results/torus.nc"),
        cwd=workflow,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # a shell lets its background jobs, and these tests among them, ignore the signal
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    wait_for(lambda: (workflow / "begun").exists())
    os.killpg(run.pid, signal.SIGINT)
    said = run.communicate(timeout=60)[1]
    assert run.returncode != 0
    first, last = said.splitlines()
    assert "run the same command again to continue" in last
    log = workflow / re.fullmatch(FIRST, first)[2]
    assert "KeyboardInterrupt" in log.read_text()


@pytest.mark.parametrize(
    ("target", "suggested"),
    [
        ("figur", "; did you mean 'figure'?"),
        ("results/trus.nc", "; did you mean 'results/torus.nc'?"),
        ("zzz", ""),
    ],
)
def test_unknown_target_gets_a_suggestion(workflow, target, suggested):
    """In one line: a rule, or a file by the words that a wildcard may stand for."""
    words = f"error: no rule makes '{target}'{suggested} (./reproduce --list shows all targets)"
    assert lines_of(workflow, target) == (1, [words])


def test_snakemakes_own_messages_can_be_had(workflow):
    """By its own options."""
    status, lines = lines_of(workflow, "--printshellcmds", "results/figures/figure_5.pdf")
    assert status == 0
    assert "localrule figure:" in lines or "rule figure:" in lines


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--kep-going"],
            "error: unrecognized arguments: --kep-going; did you mean '--keep-going'?",
        ),
        (["--cores"], "error: --cores is ''; expected 1, 2, ..., or all"),
        (["--cores", "0"], "error: --cores is '0'; expected 1, 2, ..., or all"),
        (["-cx"], "error: --cores is 'x'; expected 1, 2, ..., or all"),
        (["--snakefile=none"], 'error: Snakefile "none" not found.'),
        (["--profile", "nope"], "error: profile directory given (nope), but no profile.yaml"),
        (["--profile", "broken"], "error: Couldn't parse config file: while parsing a flow node"),
        (["--config", "1"], "error: Invalid config definition: Config entries have to be defined"),
    ],
)
def test_wrong_option_is_refused_in_one_line(workflow, arguments, words):
    """Snakemake alone prints all its options or waits without end."""
    (workflow / "broken").mkdir()
    (workflow / "broken" / "config.yaml").write_text("cores: [")
    status, (line,) = lines_of(workflow, *arguments)
    assert status in (1, 2)
    assert line.startswith(words)


def test_profile_of_the_environment_that_is_not_there_is_named(workflow, monkeypatch):
    """In the same words as one of the command line."""
    monkeypatch.setenv("SNAKEMAKE_PROFILE", "nope")
    status, (line,) = lines_of(workflow, "figure")
    assert status == 1
    assert line.startswith("error: profile directory given (nope), but no profile.yaml")


def test_folder_that_cannot_be_written_is_refused_in_one_line(workflow):
    """Also where Snakemake would have its log."""
    run = on_disk(READ_ONLY, ".snakemake", workflow, *command())
    assert run.returncode == 1
    (line,) = run.stderr.splitlines()
    assert line.startswith("error: nothing can be written in .snakemake; see that")


@pytest.mark.parametrize(
    ("message", "line"),
    [
        ("WorkflowError:\nmine.yaml, line 3: bad", "error: mine.yaml, line 3: bad"),
        ('WorkflowError in file "/a b/rules/common.smk", line 30:\nbad', "error: bad"),
        ('WorkflowError:\nbad\n  File "/a/dag.py", line 3, in __init__', "error: bad"),
        ('Traceback (most recent call last):\n\n  File "a"\n\nValueError: bad\n', "error: bad"),
        ("Error: Snakefile not found", "error: Snakefile not found"),
        ("WorkflowError:\nit is refused:\na\nb", "error: it is refused: (1) a (2) b"),
    ],
)
def test_error_of_snakemake_becomes_one_line(message, line):
    """Its reason alone."""
    assert in_one_line(message) == line


@pytest.mark.parametrize(
    ("log", "said"),
    [
        ("torus: 5 %, 1 of 20, 2 s left\ntorus: 35 %, 7 of 20, 1 s left\n", " 35 %"),
        ("[3/60] Building Fortran object a.f90.o\n", " 5 %"),
        ("words", ""),
        ("", ""),
    ],
)
def test_progress_of_a_job_is_read_from_its_log(tmp_path, log, said):
    """Of a program and of a build."""
    (tmp_path / "log").write_text(log)
    assert how_far([str(tmp_path / "log")]) == said
    assert how_far([]) == how_far([str(tmp_path / "none")]) == ""


def test_lines_come_every_so_often_without_a_terminal(tmp_path):
    """With the pause shortened."""
    script = (
        "import os, sys, time; sys.path[:0] = sys.argv[1:]\n"
        "import snakemake_logger_plugin_progress as plugin\n"
        "plugin.TICK = plugin.PAUSE = 0.1\n"
        "handler = plugin.LogHandler(None, None)\n"
        "handler.run.total, handler.run.done = 4, 1\n"
        "time.sleep(1); handler.run.done = 4; handler.close()\n"
    )
    folders = [str(ROOT / "scripts" / "console"), str(ROOT)]
    begun = time.monotonic()
    run = subprocess.run(
        [sys.executable, "-c", script, *folders], stderr=subprocess.PIPE, text=True, timeout=60
    )
    *told, last = run.stderr.splitlines()
    assert last.startswith("done in ")
    assert 1 <= len(told) <= 10 * (time.monotonic() - begun)
    assert all(re.fullmatch(r"1 of 4 jobs, \d+ s", line) for line in told)

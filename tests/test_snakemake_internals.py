"""Where Snakemake lacks what the workflow uses of its internals, the error names it."""

import subprocess
import sys
from types import SimpleNamespace

import pytest
import snakemake

from scripts.workflow import snakemake_internals as internals
from scripts.workflow.packages import PackageError


def made_up_workflow() -> SimpleNamespace:
    """What is used of Snakemake's workflow, in a form that can be taken apart."""
    here = []
    proxy = SimpleNamespace(
        rule=SimpleNamespace(benchmark="{scene,a|b}.tsv"), benchmark="{scene}.tsv"
    )
    return SimpleNamespace(
        proxy=proxy,
        rules_of_snakefile=SimpleNamespace(_rules={"short": proxy}),
        modifier=SimpleNamespace(namespace=None, skip_configfile=False),
        pathvars={"results": "results"},
        dryrun=False,
        execution_settings=SimpleNamespace(lock=True),
        persistence=SimpleNamespace(locked=False),
        scheduling_settings=SimpleNamespace(max_jobs_per_timespan="100/1s"),
        dag=SimpleNamespace(needrun_jobs=lambda **_: [SimpleNamespace(output=["a", "b"])]),
        configfiles=["mine.yaml", "config.yaml"],
        config_settings=SimpleNamespace(
            configfiles=["mine.yaml"], config_args=None, replace_workflow_config=False
        ),
        rules=[
            SimpleNamespace(name="long", docstring=None),
            SimpleNamespace(name="short", docstring="Short."),
        ],
        here=here,
        localrules=lambda *names: here.extend(names),
    )


def run_here(workflow: SimpleNamespace) -> None:
    """All but one rule."""
    internals.run_here_all_but(workflow, {"long"})


def benchmarks_of(workflow: SimpleNamespace) -> dict[str, str]:
    """Of its rules."""
    return internals.benchmarks_of(workflow.rules_of_snakefile)


def describe(workflow: SimpleNamespace) -> None:
    """One of its rules."""
    internals.describe(workflow, {"long": "Long."})


@pytest.mark.parametrize(
    ("holder", "gone", "named"),
    [
        (snakemake.dag.DAG, "check_incomplete", r"DAG\.check_incomplete"),
        (snakemake.dag.DAG, "init", r"DAG\.init"),
        (snakemake.workflow, "DAG", r"snakemake\.workflow\.DAG"),
    ],
)
def test_snakemake_that_judges_otherwise_is_refused(monkeypatch, holder, gone, named):
    """Missing files would stay missing in silence."""
    monkeypatch.setattr(snakemake.workflow, "DAG", snakemake.dag.DAG)
    monkeypatch.delattr(holder, gone)
    with pytest.raises(PackageError, match=rf"^Snakemake 9\S+ has no {named}, by which missing"):
        internals.make_missing_files_again()


@pytest.mark.parametrize(
    ("use", "path"),
    [
        (internals.start_jobs_at_once, "scheduling_settings"),
        (internals.start_jobs_at_once, "scheduling_settings.max_jobs_per_timespan"),
        (internals.lock_folder, "dryrun"),
        (internals.lock_folder, "execution_settings"),
        (internals.lock_folder, "execution_settings.lock"),
        (internals.lock_folder, "persistence"),
        (internals.lock_folder, "persistence.locked"),
        (internals.results_made, "dag"),
        (internals.results_made, "dag.needrun_jobs"),
        (internals.is_module, "modifier"),
        (internals.is_module, "modifier.namespace"),
        (internals.has_config_of_module, "modifier.skip_configfile"),
        (internals.folder_of_results, "pathvars"),
        (internals.config_sources, "configfiles"),
        (internals.config_sources, "config_settings"),
        (internals.config_sources, "config_settings.configfiles"),
        (internals.config_sources, "config_settings.config_args"),
        (internals.config_sources, "config_settings.replace_workflow_config"),
        (describe, "rules"),
        (describe, "rules.docstring"),
        (run_here, "rules"),
        (run_here, "localrules"),
        (benchmarks_of, "rules_of_snakefile._rules"),
        (benchmarks_of, "proxy.rule"),
        (benchmarks_of, "proxy.rule.benchmark"),
    ],
)
def test_name_that_snakemake_lacks_is_named(use, path, tmp_path, monkeypatch):
    """One missing at a time."""
    monkeypatch.chdir(tmp_path)
    holder = workflow = made_up_workflow()
    *parents, gone = path.split(".")
    for parent in parents:
        holder = getattr(holder, parent)
    delattr(holder[-1] if isinstance(holder, list) else holder, gone)
    with pytest.raises(PackageError, match=rf"^Snakemake 9\S+ has no \w+\.{gone}, .* ./reproduce"):
        use(workflow)


TIMERS = """
import sys, threading
from unittest.mock import patch
from snakemake.cli import main
with patch.object(threading, "Timer", wraps=threading.Timer) as timers:
    try:
        main(sys.argv[1:])
    except SystemExit as end:
        print("ended", end.code, "timers", timers.call_count)
"""


def test_scheduler_is_not_woken_by_timers(project):
    """With the limit of jobs per second, which is Snakemake's default, each job starts a timer."""
    wanted = [
        f"results/namelists/hopf/{plane}.nml" for plane in ("xi_of_epsilon", "tau_of_epsilon")
    ]
    run = subprocess.run(
        [sys.executable, "-c", TIMERS, "--cores", "1", *wanted],
        cwd=project.folder,
        capture_output=True,
        text=True,
    )
    assert run.stdout.endswith("ended 0 timers 0\n"), run.stdout + run.stderr


def test_names_that_are_there_are_used():
    """The limit goes, the user's file is merged last, all but the long rules run here."""
    workflow = made_up_workflow()
    internals.start_jobs_at_once(workflow)
    assert workflow.scheduling_settings.max_jobs_per_timespan is None
    assert internals.config_sources(workflow) == (["config.yaml"], ["mine.yaml"], [])
    describe(workflow)
    assert [rule.docstring for rule in workflow.rules] == ["Long.", "Short."]
    assert internals.results_made(workflow) == ["a", "b"]
    assert not internals.is_module(workflow)
    assert not internals.has_config_of_module(workflow)
    assert internals.folder_of_results(workflow) == "results"
    run_here(workflow)
    assert workflow.here == ["short"]
    assert benchmarks_of(workflow) == {"short": "{scene}.tsv"}


def test_file_in_place_of_the_configuration_is_read_alone():
    """Snakemake's option --replace-workflow-config."""
    workflow = made_up_workflow()
    workflow.config_settings.replace_workflow_config = True
    assert internals.config_sources(workflow) == ([], ["mine.yaml"], [])

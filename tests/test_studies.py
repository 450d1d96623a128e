"""A study is a folder: what it reads it declares, and what nobody reads can be deleted."""

import re
import shutil
from types import SimpleNamespace

import pytest

from conftest import ROOT, SMOKE, copy_of_project
from scripts.claims import declare, ledger
from scripts.files.read_config import ConfigError, read
from scripts.plans import studies
from scripts.plans.declare import Figure, Study, Table
from scripts.workflow.plan import read_plan
from scripts.workflow.script_imports import modules_of

NAMES = sorted(studies.studies())
READ = {other for study in studies.studies().values() for other in study.reads}
REMOVABLE = sorted(set(NAMES) - READ)
CACHED = (
    *(studies.files_of, studies.studies, studies.entries, studies.paper_figures),
    *(studies.data, studies.kinds_of_results, studies.schema),
)
"""What is found once in a process."""


@pytest.fixture
def hide(monkeypatch):
    """Hide the folder of a study, and the claims that it has declared."""
    there = studies.files_of.__wrapped__

    def forget() -> None:
        for function in CACHED:
            getattr(function, "cache_clear", lambda: None)()

    def hide(name: str) -> None:
        def files_of(file: str) -> list:
            return [path for path in there(file) if path.parent.name != name]

        monkeypatch.setattr(studies, "files_of", files_of)
        forget()
        tests = {key: test for key, test in declare.TESTS.items() if study_of(key) != name}
        claims = {
            key: (number, about)
            for key, (number, about) in declare._CLAIMS.items()
            if {*about.get("test", {})} <= {*tests}
        }
        monkeypatch.setattr(declare, "_CLAIMS", claims)
        monkeypatch.setattr(declare, "TESTS", tests)
        monkeypatch.setattr(ledger, "TESTS", tests)

    yield hide
    monkeypatch.undo()
    forget()


def study_of(test: str) -> str:
    """The study that has a test of claims."""
    return declare.TESTS[test].find.__module__.split(".")[2]


def texts_of(name: str) -> list[str]:
    """Templates of the captions of a study."""
    return [path.read_text() for path in (studies.FOLDER / name).glob("*.rst")]


def read_by(name: str, config: dict) -> set[str]:
    """Results that a study reads, by their paths, in its runs, tables, figures and claims."""
    study = studies.studies()[name]
    named = {test for test in declare.TESTS if study_of(test) == name}
    claims = {
        key: about
        for key, about in read_plan({}).claims.items()
        if {*about.get("test", {})} & named
    }
    values = {key: value.split("|")[0] for key, value in studies.wildcards(config).items()}
    inputs = [
        ledger.inputs_for(claims, config),
        *(run.needs for run in study.runs),
        *(figure.inputs_of(config) for figure in study.figures),
    ]
    for table in study.tables:
        names = {key: values[key] for key in re.findall(r"{(\w+)}", table.output)}
        inputs.append(table.inputs(config, **names))
    listed = [paths for given in inputs for paths in given.values()]
    return {path for paths in listed for path in ([paths] if isinstance(paths, str) else paths)}


def makers_of(path: str, config: dict) -> set[str]:
    """Studies that make a result."""
    values = studies.wildcards(config)

    def makes(output: str) -> bool:
        pattern = re.sub(r"\\{(\w+)\\}", lambda found: f"({values[found[1]]})", re.escape(output))
        return re.fullmatch(f"(<results>/)?{pattern}", path) is not None

    return {
        name
        for name, study in studies.studies().items()
        for one in (*study.runs, *study.tables)
        if makes(one.output)
    }


@pytest.mark.parametrize("name", NAMES)
def test_study_declares_what_it_reads(name, filled_config):
    """Of others it reads results and verdicts of those that its plan names."""
    found = {
        other for path in read_by(name, filled_config) for other in makers_of(path, filled_config)
    }
    shown = {
        claim
        for text in texts_of(name)
        for claim in re.findall(r"{{ verdict\(\"(\w+)\"\) }}", text)
    }
    left_out = {claim for text in texts_of(name) for claim in re.findall(r"if \"(\w+)\" in", text)}
    claims = ledger.paper_claims()
    for claim in shown - left_out:
        found |= {study_of(test) for test in claims[claim]["test"]}
    finding = studies.load_parts("finding").get(name)
    for data in finding.READS if finding else ():
        found |= makers_of(f"<results>/{studies.data()[data].output}", filled_config)
    assert found - {name} <= {*studies.studies()[name].reads}


@pytest.mark.parametrize("name", REMOVABLE)
def test_study_that_no_other_reads_can_be_deleted(name, hide):
    """What is left is planned: the paper, a user's file, claims and findings."""
    figures, claims = read_plan({}).figures, read_plan({}).claims
    hide(name)
    paper = read_plan({})
    assert {*paper.figures} == {key for key, one in figures.items() if one.study != name}
    assert {*paper.claims} <= {*claims}
    assert ledger.inputs_for(paper.claims, paper.config)
    read_plan({"user_file": str(ROOT / "config" / "new.yaml")})
    assert name not in studies.load_parts("finding")


def test_study_that_another_one_reads_is_missed_by_name(hide):
    hide("basins")
    words = "studies/basins/ is missing: the plans of atlas, linear_stability read it"
    with pytest.raises(ConfigError, match=words):
        read_plan({})


def test_missing_caption_is_named(monkeypatch):
    study = Study(figures=(Figure("mine", category="Atlas", place=1),))
    plan = SimpleNamespace(STUDY=study, __doc__="Mine.")
    monkeypatch.setattr(studies, "load_parts", lambda _part: {"mine": plan})
    words = "scripts/studies/mine/caption.rst is missing: the caption of the figure mine"
    with pytest.raises(ConfigError, match=words):
        studies.studies.__wrapped__()


def test_project_without_studies_that_no_other_reads(tmp_path):
    """All of them deleted: a dry run, the targets, and the tests of the others are found."""
    project = copy_of_project(tmp_path / "project")
    for name in REMOVABLE:
        shutil.rmtree(project.folder / "scripts" / "studies" / name)
    smoke = [path for path in SMOKE if (project.folder / path).exists() or path.startswith("-")]
    run = project.snakemake("--dry-run", "all", *smoke)
    assert run.returncode == 0, run.stdout
    listed = project.snakemake("--list-target-rules").stdout
    assert {"all", "hopf_points", "atlas", "claims"} <= {*re.findall(r"^\w+", listed, re.MULTILINE)}
    deleted = {"synchrony", "event_sizes_table"}
    assert not deleted & {*re.findall(r"^\w+", listed, re.MULTILINE)}


def test_study_of_the_document_works(scratch):
    """The one that CONTRIBUTING.md walks through: its table, figure and caption."""
    text = (ROOT / "CONTRIBUTING.md").read_text().partition("## Add a study")[2]
    files = ("plan.py", "table.py", "figure.py", "caption.rst", "test_fastest.py")
    blocks = re.findall(r"^```(?:python|rst)\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    folder = scratch.folder / "scripts" / "studies" / "fastest"
    folder.mkdir()
    for name, block in zip(files, blocks, strict=True):
        (folder / name).write_text(block)
    run = scratch.snakemake("fastest", "captions", *SMOKE)
    assert run.returncode == 0, run.stdout
    caption = (scratch.folder / "results" / "figures" / "fastest.rst").read_text()
    assert re.search(r"The largest of all is .+\.$", caption.strip())


def modules_in(script: str) -> set[str]:
    """Paths of the modules that a script depends on."""
    return {
        path.relative_to(ROOT).as_posix().removeprefix("scripts/") for path in modules_of(script)
    }


def test_modules_found_by_name_enter_the_digests():
    """A claim of any study is stale once its module changes, or one that this imports."""
    found = modules_in("claims/ledger.py")
    every = {f"studies/{path.parent.name}/claims.py" for path in studies.FOLDER.glob("*/claims.py")}
    assert every | {"tables/roots_of_5.py", "studies/formulas/printed_formulas.py"} <= found
    shown = {f"studies/{path.parent.name}/finding.py" for path in studies.files_of("finding.py")}
    assert shown <= modules_in("page/write_page.py")


def test_names_are_given_once():
    """Rules, figures, and sections: a second one would take the place of the first."""
    every = studies.studies().values()
    for names in (
        [one.rule for study in every for one in (*study.runs, *study.tables)],
        [figure.name for study in every for figure in study.figures],
        [(kind.name, kind.shows_entry) for study in every for kind in study.kinds],
        [name for study in every for name in (*study.entries, *study.wildcards)],
    ):
        assert len(names) == len({*names})


def test_scripts_of_tables_exist():
    for path, table in studies.tables():
        assert isinstance(table, Table)
        assert (ROOT / "scripts" / path).is_file()


def test_entries_of_the_configuration_stand_in_one_file():
    """A section that is in two files has other entries in each."""
    seen: dict[tuple, str] = {}

    def leaves(values: dict, path: tuple = ()):
        for key, value in values.items():
            yield from leaves(value, (*path, key)) if isinstance(value, dict) else [(*path, key)]

    for file in (ROOT / "config" / "config.yaml", *studies.files_of("config.yaml")):
        for leaf in leaves(read(file)):
            assert leaf not in seen, (leaf, file, seen[leaf])
            seen[leaf] = str(file)

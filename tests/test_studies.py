"""A study is a folder: what it reads it declares, and what nobody reads can be deleted."""

import re
import shutil
from types import SimpleNamespace

import pytest

from conftest import ROOT, SMOKE
from scripts.claims import declare, ledger
from scripts.files.read_config import ConfigError, read
from scripts.plans import studies
from scripts.plans.declare import Figure, Study
from scripts.workflow.plan import read_plan

NAMES = sorted(studies.studies())
READ = {other for study in studies.studies().values() for other in study.reads}
REMOVABLE = sorted(set(NAMES) - READ)


def study_of(test: str) -> str:
    """The study that has a test of claims."""
    return declare.tests()[test].study


def texts_of(name: str) -> list[str]:
    """Templates of the captions of a study."""
    return [path.read_text() for path in (studies.FOLDER / name).glob("*.rst")]


def read_by(name: str, config: dict) -> set[str]:
    """Results that a study reads, by their paths, in its runs, tables, figures and claims."""
    study = studies.studies()[name]
    named = {test for test in declare.tests() if study_of(test) == name}
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


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"reads": ("other",)}, "studies/other/ is missing: the plans of mine read it"),
        (
            {"figures": (Figure("mine", category="Atlas", place=1),)},
            "studies/mine/caption.rst is missing: the caption of the figure mine",
        ),
    ],
)
def test_what_a_study_misses_is_named(monkeypatch, values, words):
    plan = SimpleNamespace(STUDY=Study(**values), __doc__="Mine.")
    monkeypatch.setattr(studies, "load_parts", lambda _part: {"mine": plan})
    with pytest.raises(ConfigError, match=words):
        studies.studies.__wrapped__()


def test_project_without_studies_that_no_other_reads(project):
    """The paper with its claims, and a user's file, are planned."""
    for name in REMOVABLE:
        shutil.rmtree(project.folder / "scripts" / "studies" / name)
    smoke = [path for path in SMOKE if (project.folder / path).exists() or path.startswith("-")]
    for words in (["all", *smoke], ["--config", "user_file=config/new.yaml"]):
        run = project.snakemake("--dry-run", *words)
        assert run.returncode == 0, run.stdout
    listed = {*re.findall(r"^\w+", project.snakemake("--list-target-rules").stdout, re.MULTILINE)}
    assert {"all", "hopf_points", "atlas", "claims"} <= listed
    assert not {"synchrony", "event_sizes_table"} & listed


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

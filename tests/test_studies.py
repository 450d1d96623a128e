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

NAMES = sorted(studies.studies())
READ = {other for study in studies.studies().values() for other in study.reads}
REMOVABLE = sorted(set(NAMES) - READ)


def test_study_declares_what_it_reads(planned):
    """Of others it reads results and verdicts of those that its plan names."""
    owner, maker_of = {}, {}
    for name, study in studies.studies().items():
        for one in (*study.runs, *study.tables):
            owner[one.rule], maker_of[one.output] = name, name
        owner |= {figure.name: name for figure in study.figures}
    made_by = {path: owner.get(job.rule) for job in planned for path in job.made}
    read = {name: set() for name in studies.studies()}
    for job in planned:
        if job.rule in owner:
            read[owner[job.rule]] |= {made_by.get(path) for path in job.given}
    of_data = {data: maker_of[maker.output] for data, maker in studies.data().items()}
    for test in declare.tests().values():
        read[test.study] |= {of_data[data] for data in test.reads}
    for name, finding in studies.load_parts("finding").items():
        read[name] |= {of_data[data] for data in finding.READS}
    claims = ledger.paper_claims()
    for name in studies.studies():
        text = "".join(path.read_text() for path in (studies.FOLDER / name).glob("*.rst"))
        shown = {*re.findall(r"{{ verdict\(\"(\w+)\"\) }}", text)}
        for claim in shown - {*re.findall(r"if \"(\w+)\" in", text)}:
            read[name] |= {declare.tests()[test].study for test in claims[claim]["test"]}
        assert read[name] - {name, None} <= {*studies.studies()[name].reads}, name


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

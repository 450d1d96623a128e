"""What the documents name exists: links, files, targets, programs, config keys, other words of the
code; and no sentence stands twice."""

import copy
import json
import re
import subprocess
from fnmatch import fnmatch
from functools import cache
from pathlib import PurePath

import pytest
from snakemake.utils import update_config

from conftest import ROOT, project_files
from scripts.claims.ledger import check_user_claims
from scripts.config.check_config import checked
from scripts.files.read_config import parse, read
from scripts.models.models import block_parameters, built_in, chain_parameters
from scripts.plans import studies
from scripts.workflow import document_numbers
from scripts.workflow.check_run import targets_of

RESULTS = "results/README.md"
"""Stands beside what it names, and no other document links to it."""
DOCUMENTS = [
    "README.md",
    "CONTRIBUTING.md",
    "config/README.md",
    RESULTS,
    "fortran/dde/README.md",
    "fortran/src/methods/README.md",
    "generator/README.md",
    *(name for name in project_files() if fnmatch(name, "docs/*.md") and name != "docs/ford.md"),
]
ENDINGS = "c cff f90 in lock md mplstyle nc png py rst sh smk svg toml tsv txt yaml yml".split()
OF_THE_READER = {"mine.yaml", "mine.f90", "CMakeLists.txt"}
"""Files that the documents ask the reader to write."""
USERS_FIGURES = {"scenes", "exponents", "planes", "routes", "cycles", "atlas"}
"""Folders of the figures of a user's file."""

each = pytest.mark.parametrize("document", DOCUMENTS)


@cache
def text_of(document: str) -> str:
    return (ROOT / document).read_text()


def blocks_of(document: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", text_of(document), re.DOTALL | re.MULTILINE)


def prose_of(document: str) -> str:
    return re.sub(r"^```.*?^```$", "", text_of(document), flags=re.DOTALL | re.MULTILINE)


def ticked(document: str) -> list[str]:
    """What stands in backticks in its prose."""
    return re.findall(r"`([^`\n]+)`", prose_of(document))


def anchors_of(document: str) -> set[str]:
    headings = re.findall(r"^#+ (.*)$", prose_of(document), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@cache
def code() -> str:
    """All of the project's own text that is no document, and the names of its files."""
    names = [name for name in project_files() if not name.endswith((".md", ".lock", ".png"))]
    names = [name for name in names if not name.endswith(("LICENSE", "tests/test_documents.py"))]
    return "\n".join([*names, *((ROOT / name).read_text(errors="replace") for name in names)])


@cache
def words() -> set[str]:
    return set(re.findall(r"\w+", code()))


@cache
def rules() -> set[str]:
    workflow = "".join(path.read_text() for path in [ROOT / "Snakefile", *ROOT.glob("rules/*.smk")])
    return {
        *re.findall(r"^rule (\w+)", workflow, re.MULTILINE),
        *studies.paper_figures(),
        *(run.rule for run in studies.runs()),
        *(table.rule for _, table in studies.tables()),
    }


def is_made(path: str) -> bool:
    """Whether something makes a file: the code names it, or where files of its kind stand."""
    wanted = re.sub(r"^results/mine(/|$)", r"results/", path).rstrip("/")
    if wanted.endswith("/.venv"):
        return (ROOT / wanted).with_name("requirements.lock").is_file()
    folder = "/".join(wanted.split("/")[:2])
    kinds = {f"results/{kind}" for kind in studies.kinds_of_results()}
    if folder in kinds or (wanted.startswith("results/") and f"`{folder}/`" in text_of(RESULTS)):
        return not wanted.endswith(".tsv") or PurePath(wanted).name in code()
    return PurePath(wanted).name in code()


@cache
def files_and_folders() -> set[str]:
    files = {*project_files()}
    return files | {str(parent) for name in files for parent in PurePath(name).parents}


def exists(path: str) -> bool:
    """Whether a path, its end, or a pattern names a file or folder of the project."""
    wanted = path.removeprefix("./").rstrip("/")
    return any(fnmatch(f"/{name}", f"*/{wanted}") for name in files_and_folders())


def is_path(token: str) -> bool:
    if not re.fullmatch(r"[\w.*/-]+", token) or token.startswith(("-", ".f")):
        return False
    return "/" in token.strip(".") or token.rpartition(".")[2] in ENDINGS


def targets_in(text: str) -> set[str]:
    """What commands that call Snakemake or ./reproduce ask for, but for words such as TARGET.

    Not all have the plugin of a profile; help and --verify have no targets.
    """
    lines = re.findall(r"(?:snakemake|\./reproduce)((?: [^\n`|&#]*)?)", text)
    words = [line.split() for line in lines if not re.search("--(help|verify)", line)]
    words = [line[2:] if line[:1] == ["--profile"] else line for line in words]
    return {one for line in words for one in targets_of(["snakemake", *line]) if not one.isupper()}


@each
def test_relative_links_resolve(document):
    """To a file, and to a heading where one is named."""
    for target in re.findall(r"\]\(([^)\s]+)\)", prose_of(document)):
        if re.match(r"\w+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (ROOT / document).parent / path if path else ROOT / document
        assert file.exists(), target
        named = file.resolve().relative_to(ROOT)
        if anchor:
            assert anchor in anchors_of(str(named)), target


@each
def test_files_that_are_named_exist(document):
    paths = {token for token in ticked(document) if is_path(token) and "NAME" not in token}
    paths -= OF_THE_READER
    paths = {path for path in paths if path.partition("/")[0] not in USERS_FIGURES}
    missing = [path for path in paths if not (exists(path) or is_made(path))]
    assert missing == []


@each
def test_words_of_code_exist(document):
    """Rules, programs, config keys, scenes, types: each stands somewhere in the code."""
    named = [token for token in ticked(document) if re.fullmatch(r"[A-Za-z]\w*", token)]
    assert [word for word in named if word not in words()] == []


@each
def test_targets_that_are_named_exist(document):
    targets = targets_in("\n".join([*blocks_of(document, "sh"), *ticked(document)]))
    targets -= {*rules(), "new", *OF_THE_READER}
    targets = {word for word in targets if word.partition("/")[0] not in USERS_FIGURES}
    assert [target for target in targets if not is_made(target)] == []


@each
def test_examples_of_config_are_accepted(document, default_config):
    for block in blocks_of(document, "yaml"):
        mine = parse(block)
        config = copy.deepcopy(default_config)
        # examples build on the scene that the first one adds
        scene = parse(blocks_of("config/README.md", "yaml")[0])
        update_config(config, scene)
        update_config(config, mine)
        config = checked(config)
        check_user_claims(config["claims"], config, set())


def test_keys_of_a_scene_are_those_of_the_schema():
    table = text_of("config/README.md").partition("## Keys of a scene")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
    named = {key for row in rows for key in re.findall(r"`(\w+)`", row)}
    schema = studies.schema()
    scene = schema["properties"]["scenes"]["additionalProperties"]
    if "$ref" in scene:
        for step in scene["$ref"].removeprefix("#/").split("/"):
            schema = schema[step]
        scene = schema
    of_models = {"model", *block_parameters(), *chain_parameters()}
    assert named == set(scene["properties"]) | of_models


def test_every_document_is_reached_from_the_readme():
    reached, waiting = set(), ["README.md"]
    while waiting:
        document = waiting.pop()
        reached.add(document)
        for target in re.findall(r"\]\(([^)\s#]+)", prose_of(document)):
            named = (ROOT / document).parent / target
            if target.endswith(".md") and named.exists():
                name = str(named.resolve().relative_to(ROOT))
                waiting += [name] if name not in reached else []
    assert set(DOCUMENTS) - {RESULTS} <= reached


def test_every_picture_is_shown_and_has_its_command():
    """Pictures in docs/ stand in a document; docs/small_picture.py says how each is drawn."""
    drawing = (ROOT / "docs" / "small_picture.py").read_text()
    for picture in [name for name in project_files() if fnmatch(name, "docs/*.png")]:
        name = PurePath(picture).name
        assert any(f"{name})" in text_of(document) for document in DOCUMENTS)
        assert name in drawing or f'"{name.removesuffix(".png")}"' in drawing or "figure-" in name


def cffconvert(*arguments: str) -> str:
    program = ROOT / "tests" / "formats" / ".venv" / "bin" / "cffconvert"
    if not program.exists():
        pytest.skip("`tools/setup/setup.sh tests/formats` sets it up, and so does ./test")
    command = [program, "--infile", ROOT / "CITATION.cff", *arguments]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def test_citation_is_valid_and_complete():
    """By its schema; BibTeX gets author, title and year; authors of the paper have first names."""
    assert "valid according to schema" in cffconvert("--validate")
    entry = cffconvert("--format", "bibtex")
    assert set(re.findall(r"^(\w+) = {.+}", entry, re.MULTILINE)) >= {"author", "title", "year"}
    [paper] = read(ROOT / "CITATION.cff")["references"]
    assert paper["title"] in entry
    names = [author["given-names"] for author in paper["authors"]]
    assert len(names) == 4
    assert not [name for name in names if "." in name]


def test_laws_on_the_page_are_those_of_the_project():
    rows = re.findall(r"^\| `(\w+)` \| .*\| .*\|$", text_of("docs/friction-law.md"), re.MULTILINE)
    assert set(built_in()) <= set(rows)


def test_numbers_are_those_of_the_results():
    """As the record has them, which has no others; one that is typed over is found."""
    record = json.loads(document_numbers.RECORD.read_text())
    texts = [path.read_text() for path in document_numbers.documents()]
    used = [source for text in texts for source in document_numbers.sources_in(text)]
    assert set(used) == set(record)
    assert all(document_numbers.fill(text, record) == text for text in texts)
    assert document_numbers.fill("0<!-- a; count -->", {"a; count": "26"}) == "26<!-- a; count -->"


def test_number_is_looked_up_in_its_table(tmp_path, monkeypatch):
    (tmp_path / "a.tsv").write_text("kind\tx\none\t0.125\nother\t0.5\nother\t2\n")
    monkeypatch.setattr(document_numbers, "FOLDERS", [tmp_path])
    assert document_numbers.look_up("a; kind = one; x .2f") == "0.12"
    assert document_numbers.look_up("a; kind = other; count") == "2"
    assert document_numbers.look_up("a; largest x g") == "2"
    with pytest.raises(ValueError, match="2 rows of a"):
        document_numbers.look_up("a; kind = other; x g")


@each
def test_rows_of_tables_have_as_many_cells_as_their_heading(document):
    for table in re.findall(r"(?:^\|.*\n)+", text_of(document), re.MULTILINE):
        cells = {len(re.findall(r"(?<!\\)\|", row)) for row in table.splitlines()}
        assert len(cells) == 1, table

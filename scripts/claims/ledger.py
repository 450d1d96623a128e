"""The ledger: verdicts on claims of the paper, answers to our questions, by files in results/."""

import json
from pathlib import Path

from scripts.claims.claims_results import ANSWERS, NOT_TESTABLE, read_results
from scripts.claims.declare import OURS, Test, declared_claims, tests
from scripts.config.check_config import in_words, validator_for
from scripts.files import marked_words
from scripts.files.outputs import logged, written
from scripts.files.read_config import ConfigError
from scripts.files.tsv import write_table
from scripts.plans import studies
from scripts.plans.declare import Table
from scripts.plans.studies import inside


def paper_claims() -> dict[str, dict]:
    """Claims of the paper and our questions, of all studies and of none, by name.

    There is nothing to look at if the study with the figure is not there.
    """
    shown = {*studies.paper_figures(), *tables_to_look_at()}
    return {
        name: {key: value for key, value in about.items() if key != "look_at" or value in shown}
        for name, about in declared_claims().items()
    }


def tables_to_look_at() -> list[str]:
    """Tables that a claim may tell the reader to look at."""
    outputs = [maker.output for maker in studies.data().values() if isinstance(maker, Table)]
    return [Path(path).name for path in outputs if path.endswith(".tsv") and "{" not in path]


def check_user_claims(said: dict, config: dict, shown: set[str]) -> dict:
    """Return the claims with the defaults of their tests; raise ConfigError otherwise.

    `said` are the claims of a checked configuration, `config` is that whose scenes, planes and
    routes they name. A reader may look at the figures `shown` and at the tables that tests read.
    """
    shown = {*shown, *tables_to_look_at()}
    document = {"claims": said}
    problems = [in_words(error) for error in validator_for(_rules(config)).iter_errors(document)]
    if not problems:
        for name, claim in said.items():
            problems += [f"config claims {name}{line}" for line in _contradictions(claim, shown)]
    if problems:
        raise ConfigError("\n".join(["the list of claims is refused:", *sorted(set(problems))]))
    return said


def _rules(config: dict) -> dict:
    """JSON schema of the tests of claims, with the names that the configuration has."""
    known = {kind: list(inside(config, keys)) for kind, keys in studies.entries().items()}
    rules = _allow_keys({name: _rules_of(test, known) for name, test in tests().items()})
    claim = {"properties": {"test": rules}}
    return {"properties": {"claims": {"additionalProperties": claim}}}


def _rules_of(test: Test, known: dict[str, list[str]]) -> dict:
    """JSON schema of the parameters of a test."""
    properties = {name: _schema_of(kind, known) for name, kind in test.kinds.items()}
    for name, value in test.defaults.items():
        properties[name]["default"] = value
    required = [name for name in properties if name not in test.defaults]
    words = f"parameters of the test: {', '.join(properties)}" if properties else "no parameters"
    return {**_allow_keys(properties), "required": required, "description": words}


def _schema_of(kind: str | dict, known: dict[str, list[str]]) -> dict:
    """JSON schema of a parameter, given the names that the configuration has."""
    if isinstance(kind, dict):
        return dict(kind)
    entry = kind.removesuffix("s")
    one = {"enum": known[entry], "description": f"name of a {entry}"}
    words = f"names of {entry}s, at least one, each once"
    several = {"type": "array", "minItems": 1, "uniqueItems": True, "items": one}
    return one if kind == entry else {**several, "description": words}


def _allow_keys(properties: dict[str, dict]) -> dict:
    """JSON schema of a mapping with these keys alone."""
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _contradictions(claim: dict, shown: set[str]):
    """Problems of one claim that involve more than one key."""
    given = [key for key in ("test", "not_testable") if key in claim]
    if len(given) != 1:
        yield f": {' and '.join(given) or 'neither'} given; expected either test or not_testable"
    elif ("look_at" in claim) != ("test" in claim):
        yield ": look_at expected beside test, and only there"
    elif "test" in claim:
        if claim["look_at"] not in shown:
            yield f": look_at = {claim['look_at']!r}; expected one of: {', '.join(sorted(shown))}"
        ((test, given),) = claim["test"].items()
        scenes, expected = given.get("scenes"), given.get("expected")
        if scenes and expected and len(scenes) != len(expected):
            yield (
                f" test {test}: {len(expected)} classes for {len(scenes)} scenes; expected one each"
            )
        if "least" in given and given["least"] > given["most"]:
            yield (
                f" test {test}: least = {given['least']}; expected a finite number <= most ="
                f" {given['most']}"
            )


def inputs_for(claims: dict, config: dict) -> dict[str, list[str]]:
    """Files that the tests of the claims read, by the names of the data."""
    files: dict[str, list[str]] = {}
    for test, parameters in _tests_of(claims):
        for data in test.reads:
            paths = files.setdefault(data, [])
            paths += [path for path in _paths(data, test, parameters, config) if path not in paths]
    return files


def _paths(data: str, test: Test, parameters: dict, config: dict) -> list[str]:
    """Files of these data that a test reads, of entries that it names or else of all.

    There is no table of what the configuration has no entries of.
    """
    maker = studies.data()[data]
    if isinstance(maker, Table) and is_empty(maker, config):
        return []
    path = f"<results>/{maker.output}"
    for kind, keys in studies.entries().items():
        if f"{{{kind}}}" in path:
            names = test.names_in(kind, parameters) or inside(config, keys)
            return [path.format(**{kind: name}) for name in names]
    return [path]


def is_empty(table: Table, config: dict) -> bool:
    """Whether the configuration has nothing that the table would list."""
    if "{" in table.output:
        return False
    given = table.inputs(config)
    if given and not any(given.values()):
        return True
    return table.wanted is not None and not table.wanted(config)


def names_in(claims: dict) -> dict[str, list[str]]:
    """Entries that the tests of the claims name, by the wildcards of their sections."""
    return {
        kind: [
            name
            for test, parameters in _tests_of(claims)
            for name in test.names_in(kind, parameters)
        ]
        for kind in studies.entries()
    }


def _tests_of(claims: dict) -> list[tuple[Test, dict]]:
    """Tests of the claims that have one, with their parameters."""
    return [
        (tests()[name], parameters)
        for claim in claims.values()
        for name, parameters in claim.get("test", {}).items()
    ]


def rows_of(claims: dict[str, dict], results: dict, folder: str) -> list[dict]:
    """One row a claim, in the order of the list; the results are in the folder."""
    return [
        {
            "id": name,
            "whose": claim.get("whose", "the user"),
            "place": claim["place"],
            "claim": claim["claim"],
            **found_of(claim, results),
            "look_at": path_of(claim.get("look_at", ""), folder),
        }
        for name, claim in claims.items()
    ]


def found_of(claim: dict, results: dict) -> dict:
    """What the claim's test finds, or why it has none, in columns; of our questions the answer."""
    from scripts.claims.decide import Finding, find  # not when claims are planned

    if "not_testable" in claim:
        return vars(Finding(NOT_TESTABLE, claim["not_testable"]))
    ((name, parameters),) = claim["test"].items()
    found = vars(find(name, results, **parameters))
    if claim.get("whose") == OURS:
        return found | {"verdict": ANSWERS[found["verdict"]]}
    return found


def path_of(shown: str, folder: str) -> str:
    """Path of the figure or table of this name, if there is a name."""
    if not shown:
        return ""
    is_table = shown.endswith(".tsv")
    return f"{folder}/tables/{shown}" if is_table else f"{folder}/figures/{shown}.png"


def write_ledger(rows: list[dict], tsv: str | Path, data: str | Path) -> None:
    """Write the rows in plain words to a table, and with marked mathematics to JSON."""
    plain = [{key: marked_words.to_plain(value) for key, value in row.items()} for row in rows]
    write_table(tsv, plain)
    with written(data) as unfinished:
        unfinished.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        output = snakemake.output
        results = read_results(dict(snakemake.input.items()), snakemake.params.law)
        folder = str(Path(output.tsv).parents[1])
        table = rows_of(snakemake.params.claims, results, folder)
        write_ledger(table, output.tsv, output.json)

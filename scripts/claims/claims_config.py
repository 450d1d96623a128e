"""Check the list of claims against its schema and the configuration, in words."""

from pathlib import Path

from scripts.config.check_config import in_words, validator_of
from scripts.config.read_config import ConfigError, read

FOLDER = Path(__file__).parents[2] / "config"
CLAIMS = FOLDER / "claims.yaml"
SCHEMA = FOLDER / "claims-schema.yaml"

KEYS_OF = {
    "scene": ("scene", "periodic"),
    "plane": ("plane", "at_fixed_xi", "at_fixed_tau"),
    "route": ("route",),
}
"""Parameters of tests that name one scene, one plane or one route."""

DATA_OF = {
    "single_peak": "spectra",
    "spectrum_class": "spectra",
    "aperiodic_events": "slip_events",
    "power_law_of_sizes": "slip_events",
    "relaxation": "slip_events",
}
"""Tests that read data of the scenes they name, and which."""


def listed() -> dict:
    """What the file says, unchecked."""
    return read(CLAIMS)


def checked(said: dict, config: dict, shown: set[str]) -> dict:
    """Return the claims with the defaults of their tests; raise ConfigError otherwise.

    `config` is the configuration whose scenes and planes they name, `shown` what they may tell
    the reader to look at.
    """
    problems = [in_words(error) for error in validator_of(SCHEMA).iter_errors(said)]
    if not problems:
        for name, claim in said["claims"].items():
            problems += [f"config claims {name}{line}" for line in _wrong(claim, config, shown)]
    if problems:
        raise ConfigError("\n".join(["the list of claims is refused:", *sorted(set(problems))]))
    return said["claims"]


def named_test(claim: dict) -> tuple[str, dict]:
    """Name and parameters of a claim's test."""
    ((name, parameters),) = claim["test"].items()
    return name, parameters


def scenes_for(data: str, claims: dict) -> list[str]:
    """Scenes whose data of this kind the claims need, each once."""
    tested = [named_test(claim) for claim in claims.values() if "test" in claim]
    named = (parameters for test, parameters in tested if DATA_OF.get(test) == data)
    return list(dict.fromkeys(name for parameters in named for name in _named("scene", parameters)))


def _named(kind: str, parameters: dict) -> list[str]:
    """Scenes, planes or routes that parameters name."""
    return [
        *(parameters[key] for key in KEYS_OF[kind] if key in parameters),
        *parameters.get(f"{kind}s", []),
    ]


def _wrong(claim: dict, config: dict, shown: set[str]):
    """Problems of one claim that involve more than one key."""
    given = [key for key in ("test", "not_testable") if key in claim]
    if len(given) != 1:
        yield f": {' and '.join(given) or 'neither'} given; expected either test or not_testable"
    elif ("look_at" in claim) != ("test" in claim):
        yield ": look_at expected beside test, and only there"
    elif "test" in claim:
        if claim["look_at"] not in shown:
            yield f": look_at = {claim['look_at']!r}; expected one of: {', '.join(sorted(shown))}"
        test, parameters = named_test(claim)
        for line in (*_unknown_names(parameters, config), *_contradictions(test, parameters)):
            yield f" test {test}: {line}"


def _unknown_names(parameters: dict, config: dict):
    """Scenes, planes and routes that the configuration does not have."""
    for kind, known in (
        ("scene", config["scenes"]),
        ("plane", config["hopf_curves"]),
        ("route", config["routes"]["lines"]),
    ):
        for name in _named(kind, parameters):
            if name not in known:
                yield f"{kind} {name!r}; expected one of: {', '.join(known)}"


def _contradictions(test: str, parameters: dict):
    """Parameters that do not go together."""
    if {"scenes", "expected"} <= parameters.keys() and len(parameters["scenes"]) != len(
        parameters["expected"]
    ):
        yield (
            f"{len(parameters['expected'])} classes for {len(parameters['scenes'])} scenes;"
            " expected one each"
        )
    if "least" in parameters and "most" in parameters and parameters["least"] > parameters["most"]:
        yield (
            f"least = {parameters['least']}; expected a finite number <= most ="
            f" {parameters['most']}"
        )

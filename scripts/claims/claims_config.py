"""Check the list of claims against its schema and the configuration, in words."""

from pathlib import Path

from scripts.config.check_config import in_words, validator_of
from scripts.config.read_config import ConfigError, read
from scripts.results.paths import cycles_of_lines, exponents_of_scenes, runs_of_basins

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
    **dict.fromkeys(
        [
            *("equation_3", "equation_4", "equation_6", "equation_8", "equation_9", "equation_10"),
            *("hopf_curves", "hopf_depends_on", "kinds_of_hopf", "pairs_gained_and_lost"),
            "lag_of_the_plate",
        ],
        ("curves",),
    ),
    **dict.fromkeys(["hopf_by_delay", "delay_destabilises"], ("linear_stability",)),
    "amplitude_death": ("linear_stability", "basins"),
    "hopf_only_by_delay": ("hopf_points", "linear_stability"),
    "hopf_by_delay_at_faults": ("fault_limit",),
    "roots_decide": ("atlas", "attractors", "basins"),
    "independent_of_spring": ("curves", "routes"),
    "attractor_class": ("attractors", "exponents", "linear_stability"),
    "positive_exponent": ("attractors", "exponents"),
    "route": ("routes",),
    "leads_to": ("routes",),
    "delays_in_turn": ("attractors", "linear_stability", "routes", "cycle_points"),
    "chaos_by_a_and_b": ("routes",),
    "torus_route": ("routes", "cycle_points"),
    "quasiperiodic_route": ("routes", "cycle_points", "atlas"),
    "two_supercritical_hopfs": ("curves", "routes", "cycle_points"),
    "torus_of_scene": ("attractors", "exponents", "linear_stability", "cycles"),
    "second_hopf": ("attractors", "linear_stability", "cycles", "cycle_points"),
    "single_peak": ("spectra",),
    "spectrum_class": ("spectra",),
    **dict.fromkeys(["aperiodic_events", "equal_events", "relaxation"], ("slip_events",)),
    **dict.fromkeys(["out_of_reach", "stiffness_forbids", "stationary_state"], ("stability",)),
    **dict.fromkeys(
        [
            *("mu0_is_steady_friction", "same_state_law", "velocity_step"),
            "friction_falls_with_epsilon",
        ],
        ("friction",),
    ),
}
"""What each test reads, by the names of `Results`."""
FILES = {
    "friction": "<results>/friction/velocity_step.nc",
    "hopf_points": "<results>/tables/hopf-points.tsv",
    "fault_limit": "<results>/tables/fault-limit.tsv",
    "linear_stability": "<results>/tables/linear-stability.tsv",
    "stability": "<results>/tables/stability.tsv",
    "attractors": "<results>/tables/attractors.tsv",
    "exponents": "<results>/tables/exponents.tsv",
    "atlas": "<results>/tables/atlas.tsv",
    "basins": "<results>/tables/basins.tsv",
    "cycle_points": "<results>/tables/cycle-points.tsv",
}
"""What is in one file."""
FILES_OF = {
    "curves": ("plane", "<results>/hopf/{}.nc"),
    "routes": ("route", "<results>/tables/routes/{}.tsv"),
    "spectra": ("scene", "<results>/spectra/{}.nc"),
    "slip_events": ("scene", "<results>/slip_events/{}.nc"),
}
"""What is in one file for each plane, route or scene that a test names."""


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


def files_for(claims: dict, config: dict) -> dict[str, str | list[str]]:
    """What the tests of the claims read, by the names of `Results`; of what none reads, no file.

    Of cycles it is what the configuration lists, and tables of exponents and basins are read if it
    lists some.
    """
    tested = [named_test(claim) for claim in claims.values() if "test" in claim]
    read_by_some = {data for test, _ in tested for data in DATA_OF[test]}
    files = {data: path if data in read_by_some else [] for data, path in FILES.items()}
    for data, (kind, path) in FILES_OF.items():
        named = (_named(kind, parameters) for test, parameters in tested if data in DATA_OF[test])
        files[data] = list(dict.fromkeys(path.format(name) for names in named for name in names))
    for data, made_of in (("exponents", exponents_of_scenes), ("basins", runs_of_basins)):
        if files[data] and not made_of(config):
            files[data] = []
    files["cycles"] = cycles_of_lines(config) if "cycles" in read_by_some else []
    return files


def names_in(claims: dict) -> dict[str, list[str]]:
    """Scenes, planes and routes that the tests of the claims name."""
    tested = [named_test(claim)[1] for claim in claims.values() if "test" in claim]
    return {
        f"{kind}s": [name for each in tested for name in _named(kind, each)] for kind in KEYS_OF
    }


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

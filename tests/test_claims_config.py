"""The list of claims: what it must hold, and how it is refused."""

import copy
import inspect

import pytest

from scripts.claims import claims_config, ledger
from scripts.config.check_config import checked
from scripts.config.read_config import ConfigError, read

SHOWN = {"figure_2", "hopf-points.tsv"}
TESTED = {"place": "Figure 2", "claim": "Something is so.", "look_at": "figure_2"}
UNTESTED = {"place": "section 5", "claim": "Something is so.", "not_testable": "No data."}
GOOD = {
    "equation_10": {"plane": "tau_of_epsilon"},
    "hopf_curves": {"planes": ["tau_of_epsilon", "xi_of_epsilon"], "limit": 1e-9},
    "kinds_of_hopf": {"planes": ["tau_of_epsilon"], "expected": ["supercritical"]},
    "roots_decide": {"least_motion": 1e-3},
    "hopf_by_delay": {"scenes": ["torus", "chaos"]},
    "hopf_depends_on": {
        "at_fixed_xi": "tau_of_epsilon",
        "at_fixed_tau": "xi_of_epsilon",
        "limit": 1e-3,
    },
    "single_peak": {"scene": "oscillation"},
    "spectrum_class": {"scene": "torus", "expected": "quasiperiodic"},
    "aperiodic_events": {"scene": "chaos", "periodic": "oscillation"},
    "equal_events": {"scenes": ["chaos"]},
    "same_state_law": {"limit": 1e-6},
    "independent_of_spring": {"plane": "xi_of_epsilon", "route": "chaos_in_xi", "limit": 1e-3},
    "hopf_only_by_delay": {"plane": "xi_of_epsilon", "scenes": ["chaos"]},
    "lag_of_the_plate": {"plane": "tau_of_epsilon"},
    "quasiperiodic_route": {"routes": ["chaos_in_tau"]},
    "chaos_by_a_and_b": {"routes": ["chaos_in_xi"]},
    "two_supercritical_hopfs": {"routes": ["chaos_in_tau"], "planes": ["tau_of_epsilon"]},
    "attractor_class": {"scene": "torus", "expected": "torus"},
    "positive_exponent": {"scene": "chaos"},
    "route": {"routes": ["chaos_in_tau"], "expected": ["cycle", "torus"]},
    "leads_to": {"routes": ["chaos_in_tau"], "before": ["cycle"], "after": "chaos"},
    "delays_in_turn": {
        "scenes": ["torus", "chaos"],
        "expected": ["torus", "chaos"],
        "route": "torus_in_tau",
    },
    "torus_route": {"routes": ["chaos_in_tau"], "expected": ["cycle", "torus"]},
    "torus_of_scene": {"scene": "torus"},
    "second_hopf": {"scene": "torus"},
    "out_of_reach": {"method": "auto", "least": 1e4, "most": 1e12},
    "stiffness_forbids": {"method": "auto", "least": 1e4, "most": 1e12},
    "relaxation": {"scenes": ["stick_slip"], "ratio": 10.0, "stick": 0.9},
    "stationary_state": {"within": 1e-6},
    "velocity_step": {},
}
"""Tests with parameters that are accepted."""


def one(claim: dict) -> dict:
    """A list of one claim."""
    return {"claims": {"mine": copy.deepcopy(claim)}}


def with_test(test: str, **values) -> dict:
    """A list of one claim with this test, some of its parameters changed; None takes one out."""
    parameters = {**GOOD[test], **values}
    kept = {key: value for key, value in parameters.items() if value is not None}
    return one({**TESTED, "test": {test: kept}})


@pytest.fixture
def accept(default_config):
    """Check a list against the default configuration."""
    config = checked(copy.deepcopy(default_config))
    return lambda said, shown=SHOWN: claims_config.checked(said, config, shown)


def refusal(accept, said) -> str:
    """The one line with which a list is refused."""
    with pytest.raises(ConfigError) as caught:
        accept(said)
    head, line = str(caught.value).splitlines()
    assert head == "the list of claims is refused:"
    return line


def schema() -> dict:
    """The schema as it stands in the file."""
    return read(claims_config.SCHEMA)


def parameters_in_schema() -> dict:
    """Parameters of each test in the schema, references followed."""
    rules = schema()
    claim = rules["properties"]["claims"]["additionalProperties"]["properties"]
    tests = claim["test"]["properties"]
    return {
        name: rules["$defs"][test["$ref"].split("/")[-1]] if "$ref" in test else test
        for name, test in tests.items()
    }


def test_schema_and_functions_are_the_same_tests():
    """With the same parameters by name."""
    parameters = {
        name: list(inspect.signature(test).parameters)[1:] for name, test in ledger.TESTS.items()
    }
    assert {
        name: list(test["properties"]) for name, test in parameters_in_schema().items()
    } == parameters


def test_every_test_is_used_and_every_claim_stands_somewhere():
    """The list in the file."""
    listed = claims_config.listed()["claims"]
    used = {name for claim in listed.values() for name in claim.get("test", {})}
    assert used == set(ledger.TESTS)
    assert len(listed) >= 20
    assert len({claim["claim"] for claim in listed.values()}) == len(listed)


def test_data_of_scenes_are_known():
    """Of every test; and each claim's scenes are found, once."""
    assert set(claims_config.DATA_OF) == set(ledger.TESTS)
    known = {*claims_config.FILES, *claims_config.FILES_OF, "cycles"}
    assert {data for read in claims_config.DATA_OF.values() for data in read} == known
    named = ["single_peak", "spectrum_class", "aperiodic_events", "equal_events"]
    claims = {name: with_test(name)["claims"]["mine"] for name in [*named, "equation_10"]}
    claims["untested"] = UNTESTED
    files = claims_config.files_for(claims, {})
    assert files["spectra"] == [f"<results>/spectra/{name}.nc" for name in ("oscillation", "torus")]
    events = [f"<results>/slip_events/{name}.nc" for name in ("chaos", "oscillation")]
    assert files["slip_events"] == events
    assert files["friction"] == files["atlas"] == files["routes"] == []
    assert claims_config.names_in(claims)["scenes"] == [
        *("oscillation", "torus", "chaos", "oscillation", "chaos")
    ]


def test_no_verdict_is_written_in_the_list():
    """Nor in the schema: but for what cannot be tested."""
    claim = schema()["properties"]["claims"]["additionalProperties"]["properties"]
    assert set(claim) == {"place", "claim", "look_at", "not_testable", "test"}


@pytest.mark.parametrize("test", GOOD)
def test_good_parameters_are_accepted(accept, test):
    """Unchanged, but for defaults."""
    accepted = accept(with_test(test))["mine"]
    name, parameters = claims_config.named_test(accepted)
    assert name == test
    assert parameters.items() >= GOOD[test].items()


def test_limit_has_a_default(accept):
    """Of equations, not of the spread of epsilon."""
    (_, parameters) = claims_config.named_test(accept(with_test("equation_10"))["mine"])
    assert parameters == {"plane": "tau_of_epsilon", "limit": 1e-10}
    line = refusal(accept, with_test("independent_of_spring", limit=None))
    assert line == "config claims mine test independent_of_spring: key ['limit'] is missing"


def test_untested_claim_is_accepted(accept):
    """With a reason."""
    assert accept(one(UNTESTED)) == {"mine": UNTESTED}


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (None, "value = None; expected"),
        ({}, "config: key ['claims'] is missing"),
        ({"claims": {}}, "config: claims = {}; expected claims of the paper by name"),
        ({"claims": {"mine": None}}, "mine = None; expected a claim: place, claim"),
        ({"claims": {"Mine": UNTESTED}}, "name 'Mine'; expected small letters"),
        (one({**UNTESTED, "verdict": "reproduced"}), "unknown key ['verdict']; allowed: place"),
        (one({"claim": "x", "not_testable": "y"}), "key ['place'] is missing"),
        (one({**UNTESTED, "place": ""}), "place = ''; expected where in the paper"),
        (one({**UNTESTED, "claim": 5}), "claim = 5; expected what the paper says"),
        (one({**UNTESTED, "not_testable": ""}), "not_testable = ''; expected why"),
        (one({**TESTED, "test": {}}), "test = {}; expected the name of one test"),
        (one({**TESTED, "test": "route"}), "test = 'route'; expected the name of one test"),
        (one({**TESTED, "test": {"magic": {}}}), "unknown key ['magic']; allowed: equation_3"),
        (
            one({**TESTED, "test": {"velocity_step": {}, "stationary_state": {"within": 1.0}}}),
            "expected the name of one test",
        ),
        (one({**TESTED, "test": {"route": None}}), "route = None; expected parameters"),
        (one(TESTED), "neither given; expected either test or not_testable"),
        (
            one({**TESTED, "test": {"velocity_step": {}}, "not_testable": "x"}),
            "test and not_testable given",
        ),
        (one({**UNTESTED, "look_at": "figure_2"}), "look_at expected beside test"),
        (
            one({**TESTED, "look_at": "figure_9", "test": {"velocity_step": {}}}),
            "look_at = 'figure_9'; expected one of: figure_2, hopf-points.tsv",
        ),
        (
            one({"place": "a", "claim": "b", "test": {"velocity_step": {}}}),
            "look_at expected beside test",
        ),
    ],
)
def test_bad_claim_is_refused(accept, said, words):
    """In one line that names the place."""
    assert words in refusal(accept, said)


@pytest.mark.parametrize(
    ("test", "values", "words"),
    [
        ("equation_10", {"plane": None}, "key ['plane'] is missing"),
        ("equation_10", {"scene": "torus"}, "unknown key ['scene']; allowed: plane, limit"),
        ("equation_10", {"plane": "nowhere"}, "plane 'nowhere'; expected one of: tau_of_epsilon"),
        ("equation_10", {"limit": 0.0}, "limit = 0.0; expected residual"),
        ("equation_10", {"limit": 0.1}, "limit = 0.1; expected residual"),
        ("equation_10", {"limit": "1e-9"}, "write 1e-9 without quotes"),
        ("hopf_curves", {"planes": []}, "planes = []; expected names of planes"),
        ("hopf_curves", {"planes": ["nowhere"]}, "plane 'nowhere'; expected one of"),
        ("kinds_of_hopf", {"expected": ["critical"]}, "expected one of: supercritical"),
        ("kinds_of_hopf", {"expected": []}, "expected = []; expected kinds of Hopf"),
        ("second_hopf", {"scene": "nobody"}, "scene 'nobody'; expected one of: fixed_point"),
        ("delays_in_turn", {"route": "nowhere"}, "route 'nowhere'; expected one of: chaos_in_tau"),
        ("leads_to", {"routes": ["nowhere"]}, "route 'nowhere'; expected one of: chaos_in_tau"),
        ("leads_to", {"before": ["ring"]}, "expected one of: fixed point"),
        ("hopf_by_delay", {"scenes": ["nobody"]}, "scene 'nobody'; expected one of: fixed_point"),
        ("hopf_by_delay", {"scenes": []}, "scenes = []; expected names of scenes"),
        ("roots_decide", {"least_motion": 0.0}, "least_motion = 0.0; expected largest v - 1"),
        ("hopf_depends_on", {"at_fixed_xi": "nowhere"}, "plane 'nowhere'; expected one of: tau_of"),
        ("hopf_depends_on", {"at_fixed_tau": "nowhere"}, "plane 'nowhere'; expected one of: tau_o"),
        ("aperiodic_events", {"periodic": "nobody"}, "scene 'nobody'; expected one of: fixed_poin"),
        ("spectrum_class", {"expected": "torus"}, "expected = 'torus'; expected kind of a spectr"),
        ("same_state_law", {"limit": 0.0}, "limit = 0.0; expected largest difference"),
        ("independent_of_spring", {"limit": -1.0}, "limit = -1.0; expected spread"),
        ("attractor_class", {"expected": "ring"}, "expected = 'ring'; expected class"),
        ("attractor_class", {"expected": "undecided"}, "expected = 'undecided'; expected class"),
        ("delays_in_turn", {"expected": ["torus"]}, "1 classes for 2 scenes"),
        ("route", {"expected": []}, "expected = []; expected classes"),
        ("out_of_reach", {"method": "rk4"}, "method = 'rk4'; expected method of a run"),
        ("out_of_reach", {"least": 1e13}, "least = 10000000000000.0; expected a finite number <="),
        ("out_of_reach", {"most": -1.0}, "most = -1.0; expected largest gamma"),
        ("stiffness_forbids", {"least": 1e13}, "least = 10000000000000.0; expected a finite numb"),
        ("relaxation", {"ratio": 1.0}, "ratio = 1.0; expected largest velocity"),
        ("relaxation", {"stick": 1.0}, "stick = 1.0; expected least share"),
        ("stationary_state", {"within": 0.0}, "within = 0.0; expected distance"),
        ("velocity_step", {"plane": "tau_of_epsilon"}, "unknown key ['plane']"),
    ],
)
def test_bad_parameter_is_refused(accept, test, values, words):
    """The line names claim, test, key, value and what is allowed."""
    line = refusal(accept, with_test(test, **values))
    assert line.startswith(f"config claims mine test {test}")
    assert words in line


def test_all_that_is_wrong_is_told(accept):
    """A line each."""
    said = {"claims": {"one": {**UNTESTED, "place": ""}, "two": {**UNTESTED, "claim": ""}}}
    with pytest.raises(ConfigError) as caught:
        accept(said)
    assert len(str(caught.value).splitlines()) == 3

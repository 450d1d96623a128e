"""Checking a configuration: defaults filled in, and each refusal in words."""

import copy
from collections import defaultdict
from collections.abc import Iterator

import pytest
from wrong_values import Place, rules_in, wrong_values

from scripts.config.check_config import checked
from scripts.config.checks import FEWEST_SAMPLES
from scripts.files.read_config import ConfigError
from scripts.plans import studies

ROUTE = ("routes", "lines", "chaos_in_epsilon")
FAMILY = ("stability", "families", "growth")
DEFAULT = studies.merged("config.yaml")
RULES = studies.schema()["properties"]
with_families = pytest.mark.skipif("stability" not in DEFAULT, reason="no study has families")
SCENE = {"tau": 1.0, "epsilon": 0.7, "xi": 0.5, "gamma": 1.0, "t_end": 10.0}
LONG_NAMES = {"tau": [1.0], "epsilon": [0.5], "xi": [1.0], "gamma": [1.0, 1e4], "t_end": 1.0}
MANY = [float(i) for i in range(1000)]


def section_of(config: dict, path: Place) -> dict:
    """The section at a place."""
    for key in path:
        config = config[key]
    return config


def put(config: dict, path: Place, value) -> None:
    section_of(config, path[:-1])[path[-1]] = value


def places(config: dict, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Places of all values that are no mappings."""
    for key, value in config.items():
        if isinstance(value, dict):
            yield from places(value, (*path, key))
        else:
            yield (*path, key)


def refuse(config: dict) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        checked(config)
    title, *lines = str(caught.value).splitlines()
    assert title == "the configuration is refused:"
    return lines


def place_of(path: Place) -> str:
    """How a refusal begins."""
    if len(path) >= 2 and path[0] == "scenes":
        return " ".join([f"scene '{path[1]}'", *map(str, path[2:])])
    return " ".join(["config", *map(str, path)])


@pytest.fixture
def whole(config) -> dict:
    """A config in which every section with a default stands, to change."""
    config["atlas"]["history"] = {"v": 1.1}
    return checked(config)


def test_default_config_is_accepted_as_it_stands(config, default_config):
    scenes = checked(config)["scenes"]
    for name, scene in default_config["scenes"].items():
        given = {key: value for key, value in scene.items() if not isinstance(value, str)}
        found = {key: scenes[name][key] for key in given}
        inside = {key: {**found[key], **one} for key, one in given.items() if isinstance(one, dict)}
        assert found == given | inside


@pytest.mark.parametrize("name", ["smoke", "fine_atlas"])
def test_overlays_name_only_keys_that_there_are(config, name):
    """A misspelt key would change nothing."""
    overlay = studies.merged(f"{name}.yaml")
    assert set(places(overlay)) <= set(places(checked(config)))


def test_smoke_config_has_all_scenes(config):
    assert set(studies.merged("smoke.yaml")["scenes"]) == set(config["scenes"])


def test_missing_keys_get_their_defaults(config):
    """The least scene has the four parameters and t_end; no other scene shares its values."""
    for name in ("mine", "other"):
        config["scenes"][name] = {"tau": 1, "epsilon": 0.5, "xi": 1, "gamma": 1, "t_end": 10}
    scenes = checked(config)["scenes"]
    assert scenes["mine"] == {
        **{"tau": 1, "epsilon": 0.5, "xi": 1, "gamma": 1, "t_end": 10},
        **{"blocks": 1, "kappa": 0.0, "ends": "free", "disturbance": {"seed": 1, "block": 0}},
        "history": {"theta": 0.0, "u": 0.0, "v": 1.1},
        **{"t_transient": 0.0, "sample_interval": 0.05, "tolerance": 1e-9, "method": "auto"},
        "law": "slip_delayed_logarithm",
    }
    scenes["mine"]["history"]["v"] = 2.0
    assert scenes["other"]["history"]["v"] == 1.1


def test_whatever_the_schema_does_not_allow_is_refused(whole):
    """Each number, word, list and section in turn: the line names place, key, value and range."""
    rounds: dict[tuple[int, int], list] = defaultdict(list)
    for path, value, rules in rules_in(whole):
        # of those in SI: scripts/studies/si/test_si.py
        if path and "si" not in whole["scenes"].get(path[1] if path[1:] else "", ()):
            for i, (wrong, words) in enumerate(wrong_values(value, rules)):
                rounds[len(path), i].append((path, wrong, words))
    assert sum(map(len, rounds.values())) > 5000
    for spoils in rounds.values():
        spoiled = copy.deepcopy(whole)
        for path, wrong, _ in spoils:
            put(spoiled, path, wrong)
        lines = refuse(spoiled)
        for path, wrong, words in spoils:
            start = f"{place_of(path[:-1])}: {path[-1]} = {wrong!r}; expected "
            assert [line for line in lines if line.startswith(start) and words in line], (
                path,
                words,
            )


def test_keys_that_the_schema_does_not_know_are_refused(whole):
    """In every section of fixed keys: the line names section and key, and lists what is known."""
    closed = [
        path for path, _, rules in rules_in(whole) if rules.get("additionalProperties") is False
    ]
    assert len(closed) > 100
    for path in closed:
        section_of(whole, path)["colour"] = 1
    lines = refuse(whole)
    for path in closed:
        start = f"{place_of(path)}: unknown key ['colour']; allowed: "
        assert [line for line in lines if line.startswith(start)], path


REFUSED = [
    (("pathvars", "results"), "results/$(touch X)", "folder of the results"),
    *(
        (("pathvars", "results"), path, "folder of the results")
        for path in ("../outside/", "../outside", ".", ".git", "results/../..", "-x")
    ),
    # windows
    ((*ROUTE, "window"), [0.5, 0.5], "two ascending"),
    ((*ROUTE, "window"), [0.6, 0.5], "two ascending"),
    ((*ROUTE, "window"), [-1.0, 0.5], "> -1.0"),
    (("hopf_curves", "xi_of_epsilon", "abscissa_window"), [-0.5, 0.0], "no Hopf point"),
    (("attractors", "histories", "theta"), [-1e308, 1e308], "two ascending numbers"),
    (("atlas", "planes", "xi_05", "ordinate_window"), [-0.1, 5.0], ">= 0.0"),
    # values that contradict others: the range is what the other value leaves
    (("scenes", "torus", "t_transient"), 8000.0, "a finite number >= 0 and < t_end = 8000.0"),
    (("scenes", "torus", "sample_interval"), 8000.5, " and <= t_end = 8000.0"),
    (("scenes", "torus", "sample_interval"), 1e-7, ">= 8e-05 (100000000 samples) and <= t_end = "),
    (("scenes", "torus", "t_end"), 1e12, "interval = 0.05; expected a finite number >= 10000.0 ("),
    (("scenes", "torus", "exponents", "t_end"), 2000.0, "> t_transient = 2000.0 and > tau = 10.0"),
    (("scenes", "fixed_point", "exponents"), {"count": 4}, ">= 2 and <= 3 without delay"),
    (("figures", "true_torus", "rows", "a", "scene"), "no_delay", "with the key attractors"),
    (("figures", "figure_6", "rows", "a", "scene"), "nowhere", "expected one of: fixed_point, "),
    (("hopf_curves", "tau_of_epsilon", "xi"), 0.0, "xi = 0.0; expected spring constant"),
    (("routes", "histories", "up"), {}, "'up'; expected another, this is the name of a sweep"),
    ((*ROUTE, "epsilon"), 0.5, "epsilon = 0.5; expected no value, it is along epsilon"),
    (("cycles", "lines", "torus_in_tau", "starts"), [17.0], "expected a number in [0.05, 16.0]"),
    (("atlas", "parts"), 26, "parts = 26; expected a whole number >= 1 and <= ordinate_count = 25"),
    (("routes", "observation", "kept"), 0, "kept = 0; expected a "),
    (("work_precision", "scenes", "mine"), {"t_end": 1.0}, "'mine'; expected one of: fixed_point"),
    (("work_precision", "cases", "chaos"), SCENE, "'chaos'; expected a name that no scene has"),
    (
        ("stability", "reference"),
        {"tolerance": 1e-17, "check_tolerance": 1e-17},
        "check_tolerance = 1e-17; expected a finite number > tolerance = 1e-17",
    ),
    (("synchrony", "scenes"), ["nowhere"], "'nowhere'; expected one of"),
    (("synchrony", "s_window"), [0.5, 2.0], "s_window = [0.5, 2.0]; expected two ascending"),
    (("synchrony", "t_end"), 10.0, "t_end = 10.0; expected a finite number > t_transient"),
    ((*FAMILY, "tau"), MANY, "2000 combinations; expected at most 1000"),
    (("stability", "families", "abcdefghij" * 6), LONG_NAMES, "of 72 letters; expected at most 64"),
    ((*FAMILY, "reference"), "stationary", "t_end = 400.0; expected a finite number >= 10000.0"),
]
"""A place of the configuration, a value that is refused there, and words of the refusal."""


def is_there(path: Place) -> bool:
    """Whether a study has the section, or the figure."""
    section = DEFAULT.get(path[0], path[0] == "pathvars")
    return path[1] in section if path[0] == "figures" else bool(section or path[0] in RULES)


@pytest.mark.parametrize(("path", "value", "words"), [one for one in REFUSED if is_there(one[0])])
def test_bad_value_is_refused(whole, path, value, words):
    put(whole, path, value)
    lines = refuse(whole)
    start = place_of(path[:-1])
    assert [line for line in lines if line.startswith(start) and words in line], lines


@pytest.mark.parametrize(
    ("key", "hint"),
    [
        *(("taus", " (is it meant to be 'tau'?)"), ("ksi", " (is it meant to be 'xi'?)")),
        *(("colour", ""), (3, ""), (None, "")),
    ],
)
def test_unknown_key_may_be_misspelt(config, key, hint):
    config["scenes"]["torus"][key] = 1.0
    (line,) = refuse(config)
    assert line.startswith(f"scene 'torus': unknown key [{key!r}]; allowed: tau, epsilon, xi, ")
    assert line.partition(" (")[2] == hint.partition(" (")[2]


@pytest.mark.parametrize(
    "path",
    [
        *(("scenes",), ("scenes", "torus", "tau"), ("routes", "histories")),
        *((*ROUTE, "window"), (*ROUTE, "xi")),
        pytest.param((*FAMILY, "t_end"), marks=with_families),
    ],
)
def test_missing_key_is_named_once(config, path):
    del section_of(config, path[:-1])[path[-1]]
    assert refuse(config) == [f"{place_of(path[:-1])}: key ['{path[-1]}'] is missing"]


@pytest.mark.parametrize("path", [("scenes",), ("routes", "lines")])
def test_name_that_makes_no_file_name_is_refused(config, path):
    """Snakemake takes a name that ends with 20 equal parts for an endless recursion."""
    section = section_of(config, path)
    first = next(iter(section.values()))
    for name in ("a" * 19, "torus" + "_1" * 19, "a" * 40 + "b"):
        section[name] = copy.deepcopy(first)
    checked(copy.deepcopy(config))
    bad = ["Torus", "1st", "a b", "a/b", "", "torus\n", "a" * 65, "torus" + "_1" * 20]
    for names in (bad, [5, True]):
        spoiled = copy.deepcopy(config)
        for name in names:
            put(spoiled, (*path, name), copy.deepcopy(first))
        lines = refuse(spoiled)
        starts = [f"{place_of(path)}: name {name!r}; expected " for name in names]
        assert all(any(line.startswith(start) for line in lines) for start in starts), lines


def test_part_of_too_many_points_is_refused(config):
    """One run of the program takes a million of them."""
    config["atlas"] |= {
        "abscissa_count": 100000,
        "ordinate_count": 80,
        "parts": 7,
        "refinements": 0,
    }
    words = "config atlas: parts = 7 of 1200000 points; expected at most 1000000 in each"
    assert words in refuse(config)


@with_families
def test_endless_combinations_are_counted_not_made(config):
    """A family of 10^18 cases is refused at once."""
    many = [float(i) for i in range(1, 1001)]
    for key in ("tau", "xi", "gamma"):
        put(config, (*FAMILY, key), many)
    put(config, (*FAMILY, "history"), {"theta": many, "u": many, "v": many})
    put(config, (*FAMILY, "epsilon"), [0.5])
    assert f"{10**18} combinations; expected at most 1000" in refuse(config)[0]


@pytest.mark.parametrize("section", ["attractors", "atlas"])
def test_samples_of_an_observation_suffice_for_a_spectrum(config, section):
    """Eight segments that overlap by half are as long as four and a half."""
    given = {"kept": 10, "t_observed": 100.0, "sample_interval": 100.0 / (4.5 * FEWEST_SAMPLES)}
    config[section]["observation"] = given
    checked(copy.deepcopy(config))
    for interval, words in (
        (100.0 / (4.5 * FEWEST_SAMPLES - 2), f"at least {FEWEST_SAMPLES} samples"),
        (1e-7, "(100000000 samples)"),
        (1e-310, "(100000000 samples)"),
        (100.1, "<= t_observed = 100.0"),
    ):
        given["sample_interval"] = interval
        (line,) = refuse(copy.deepcopy(config))
        assert line.startswith(f"config {section} observation: sample_interval = {interval}; ")
        assert words in line

"""Checking a configuration: defaults filled in, and each refusal in words."""

from collections.abc import Iterator

import pytest
from config_refusals import line_about, put, refusal
from conftest import ROOT

from scripts.config.check_config import checked
from scripts.config.read_config import read
from scripts.figures import figure_1
from scripts.figures.registry import FIGURES, params_of, variables_used


def places(config: dict, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Places of all values."""
    for key, value in config.items():
        if isinstance(value, dict):
            yield from places(value, (*path, key))
        else:
            yield (*path, key)


def test_default_config_is_accepted_as_it_stands(config, default_config):
    """Nothing that the file says is changed."""
    scenes = checked(config)["scenes"]
    for name, scene in default_config["scenes"].items():
        assert {key: scenes[name][key] for key in scene} == scene


@pytest.mark.parametrize("name", ["smoke", "fine_atlas"])
def test_overlays_name_only_keys_that_there_are(config, name):
    """A misspelt key would change nothing."""
    overlay = read(ROOT / "config" / f"{name}.yaml")
    assert set(places(overlay)) <= {*places(checked(config)), ("pathvars", "results")}


def test_smoke_config_has_all_scenes(config):
    """None is computed at full length."""
    assert set(read(ROOT / "config" / "smoke.yaml")["scenes"]) == set(config["scenes"])


def test_missing_keys_get_their_defaults(config):
    """The least scene: the four parameters and t_end."""
    config["scenes"]["mine"] = {"tau": 1, "epsilon": 0.5, "xi": 1, "gamma": 1, "t_end": 10}
    assert checked(config)["scenes"]["mine"] == {
        "tau": 1,
        "epsilon": 0.5,
        "xi": 1,
        "gamma": 1,
        "t_end": 10,
        "history": {"theta": 0.0, "u": 0.0, "v": 1.1},
        "t_transient": 0.0,
        "sample_interval": 0.05,
        "tolerance": 1e-9,
        "method": "auto",
        "variables": ["theta", "u", "v"],
    }


def test_defaults_are_not_shared_between_scenes(config):
    """Changing one scene's history leaves the other's."""
    for name in ("one", "two"):
        config["scenes"][name] = {"tau": 1, "epsilon": 0.5, "xi": 1, "gamma": 1, "t_end": 10}
    scenes = checked(config)["scenes"]
    scenes["one"]["history"]["v"] = 2.0
    assert scenes["two"]["history"]["v"] == 1.1


@pytest.mark.parametrize(
    ("scene", "variables"),
    [
        ("fixed_point", ["u", "v"]),
        ("oscillation", ["u", "v"]),
        ("torus", ["u", "v"]),
        ("chaos", ["u", "v"]),
    ],
)
def test_scenes_store_what_their_figures_use(config, scene, variables):
    """Portraits need u and v, nothing needs theta."""
    assert checked(config)["scenes"][scene]["variables"] == variables


def test_scene_with_a_spectrum_only_stores_v(config):
    """A spectrum needs v alone."""
    config["figures"]["figure_5"]["rows"].pop("b")
    assert variables_used(config, "chaos") == {"v"}
    assert checked(config)["scenes"]["chaos"]["variables"] == ["v"]


def test_scenes_store_what_a_new_figure_draws(config, monkeypatch):
    """Its module names the trajectory and the variables."""
    inputs = {"trajectory": "<results>/trajectories/chaos.nc"}
    monkeypatch.setattr(figure_1, "inputs", lambda _: inputs, raising=False)
    monkeypatch.setattr(figure_1, "VARIABLES", ("theta",), raising=False)
    assert checked(config)["scenes"]["chaos"]["variables"] == ["theta", "u", "v"]


def test_figures_with_settings_are_those_of_the_schema(config):
    """Those that cannot do without the section."""
    settings = config.pop("figures")
    having = set()
    for name in FIGURES:
        try:
            params_of(name, config)
        except KeyError:
            having.add(name)
    assert having == set(settings)


def test_figures_of_the_paper_come_first():
    """All eight, in its order."""
    assert FIGURES[:8] == [f"figure_{number}" for number in range(1, 9)]


def test_variables_of_ones_own_are_kept(config):
    """A scene may store more than its figures use."""
    config["scenes"]["torus"]["variables"] = ["v", "u", "theta"]
    assert checked(config)["scenes"]["torus"]["variables"] == ["v", "u", "theta"]


def test_number_that_no_computer_holds_is_refused(config):
    """A whole number of 400 digits is as good as infinite."""
    config["scenes"]["torus"]["t_end"] = 10**400
    assert "t_end = " in refusal(config)


@pytest.mark.parametrize("t_transient", [8000.0, 8000.1])
def test_transient_as_long_as_the_run_is_refused(config, t_transient):
    """The range names t_end."""
    config["scenes"]["torus"]["t_transient"] = t_transient
    line = line_about(refusal(config), "t_transient")
    assert line.startswith(f"scene 'torus': t_transient = {t_transient!r}; expected ")
    assert "< t_end = 8000.0" in line


def test_samples_farther_apart_than_the_run_is_long_are_refused(config):
    """The range names t_end; one sample at each end is allowed."""
    config["scenes"]["torus"]["sample_interval"] = 8000.5
    line = line_about(refusal(config), "sample_interval")
    assert line.startswith("scene 'torus': sample_interval = 8000.5; expected ")
    assert "<= t_end = 8000.0" in line
    config["scenes"]["torus"]["sample_interval"] = 8000.0
    checked(config)


def test_variables_that_figures_lack_are_refused(config):
    """Figure 5 draws u."""
    config["scenes"]["torus"]["variables"] = ["theta", "v"]
    line = line_about(refusal(config), "variables")
    assert line == "scene 'torus': variables = ['theta', 'v']; its figures also use ['u']"


@pytest.mark.parametrize("value", ["1e-9", "1.5", "-3"])
def test_number_in_quotes_is_explained(config, value):
    """What the hint says to write is a number."""
    config["scenes"]["torus"]["tolerance"] = value
    line = line_about(refusal(config), "tolerance")
    assert f"tolerance = {value!r}; expected relative and absolute tolerance" in line
    assert line.endswith(f" (this is text; write {value} without quotes for the number)")


@pytest.mark.parametrize("value", ["inf", "nan", ".inf", "1:30", "1,5", "a: b", "[1", "yes", ""])
def test_text_that_is_no_finite_number_gets_no_hint(config, value):
    """What the hint would say to write would be refused again."""
    config["scenes"]["torus"]["tolerance"] = value
    line = line_about(refusal(config), "tolerance")
    assert f"tolerance = {value!r}; expected relative and absolute tolerance" in line
    assert "without quotes" not in line


@pytest.mark.parametrize("key", ["taus", "Tau", 3, None])
def test_unknown_key_of_a_scene_is_refused(config, key):
    """The line names scene and key, and lists what is known."""
    config["scenes"]["torus"][key] = 1.0
    words = refusal(config)
    assert f"scene 'torus': unknown key [{key!r}]; allowed: tau, epsilon, xi, gamma, " in words


@pytest.mark.parametrize(
    ("key", "near"),
    [("taus", "tau"), ("epsilom", "epsilon"), ("sample_intervall", "sample_interval")],
)
def test_nearest_key_is_named(config, key, near):
    """Most unknown keys are misspelt."""
    config["scenes"]["torus"][key] = 1.0
    assert f" (is it meant to be '{near}'?)" in refusal(config)


def test_no_key_is_named_where_none_is_near(config):
    """Rather than one that is not meant."""
    config["scenes"]["torus"]["colour"] = 1.0
    assert "meant" not in refusal(config)


def test_missing_keys_are_named_once(config):
    """Two missing keys make no four lines."""
    del config["scenes"]["torus"]["tau"], config["scenes"]["torus"]["xi"]
    lines = refusal(config).splitlines()[1:]
    assert len(lines) == len(set(lines))
    assert all(any(f"'{key}'" in line for line in lines) for key in ("tau", "xi"))


@pytest.mark.parametrize("value", [None, 5, "torus", []])
@pytest.mark.parametrize(
    "path", [("scenes",), ("scenes", "torus"), ("scenes", "torus", "history"), ("figures",)]
)
def test_section_that_is_no_mapping_is_refused(config, path, value):
    """The line names it and the value."""
    put(config, path, value)
    assert f"{path[-1]} = {value!r}" in refusal(config)


@pytest.mark.parametrize(
    "name",
    [
        *("Torus", "1st", "a b", "a-b", "a/b", "", "torus\n", "a" * 65),
        # Snakemake takes them for an endless recursion
        *("a" * 64, "torus" + "_1" * 20),
    ],
)
def test_scene_name_that_makes_no_file_name_is_refused(config, name):
    """The line names the scene and says what a name may hold."""
    config["scenes"][name] = dict(config["scenes"]["torus"])
    assert f"config scenes: name {name!r}; expected small letters" in refusal(config)


@pytest.mark.parametrize("name", ["a" * 19, "torus" + "_1" * 19, "a" * 40 + "b"])
def test_scene_name_of_equal_parts_is_accepted(config, name):
    """Up to 19 of them at the end."""
    config["scenes"][name] = dict(config["scenes"]["torus"])
    assert name in checked(config)["scenes"]


@pytest.mark.parametrize(
    "folder",
    [
        *("results/$(touch X)", ".", "../outside", "/abs", ".git", "scripts", "build"),
        *("results/a b", "results/logs", "results/mine", "results/", "results\n", "", "<build>"),
    ],
)
def test_other_folder_of_results_is_refused(config, folder):
    """The folder is named after the file, or the paper's results are replaced."""
    config["pathvars"] = {"results": folder}
    assert f"config pathvars: results = {folder!r}; expected results (" in refusal(config)


@pytest.mark.parametrize("name", ["build", "resources", "logs", "benchmarks"])
def test_other_folder_is_refused(config, name):
    """Of the programs, or one that Snakemake knows."""
    config["pathvars"] = {"results": "results", name: "elsewhere"}
    assert f"config pathvars: unknown key ['{name}']; allowed: results" in refusal(config)


@pytest.mark.parametrize("name", [5, True, 1.5])
def test_scene_name_that_is_no_text_is_refused(config, name):
    """YAML reads `5:` and `yes:` as other things than text."""
    config["scenes"][name] = dict(config["scenes"]["torus"])
    assert f"config scenes: name {name!r}; expected " in refusal(config)


def test_all_problems_are_listed_at_once(config):
    """One run of the check is enough to mend a file."""
    config["scenes"]["torus"]["tau"] = -1.0
    config["scenes"]["chaos"]["xi"] = "much"
    config["spectra"]["segments"] = 0
    config["threads"] = 4
    words = refusal(config).splitlines()
    assert words[0] == "the configuration is refused:"
    assert len(words) == 5
    for part in ("tau = -1.0", "xi = 'much'", "segments = 0", "unknown key ['threads']"):
        assert sum(part in line for line in words) == 1


def test_contradictions_are_listed_at_once(config):
    """The same for what involves more than one key."""
    config["scenes"]["torus"]["t_transient"] = 9000.0
    config["scenes"]["chaos"]["sample_interval"] = 1e6
    assert len(refusal(config).splitlines()) == 3


@pytest.mark.parametrize("nothing", [None, [], "text", 5])
def test_config_that_is_no_mapping_is_refused(nothing):
    """An empty file, a list, a word."""
    assert repr(nothing) in refusal(nothing)

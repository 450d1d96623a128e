"""Networks of a user in the configuration: what is refused, and what programs get."""

import copy
from pathlib import Path

import numpy as np
import pytest

from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError
from scripts.models import network_numbers, networks
from scripts.models.compiled import objects_of
from scripts.models.models import model_of
from scripts.requests.program_groups import scene_groups

PHASES = {
    "size": {"i": 2},
    "parameters": {
        **{"w": {"default": [1.0, 2.0]}, "a": {"at_least": 0, "csv": "a.csv"}},
        **{"Ω": {}, "N": {}},
    },
    "states": {"P": ""},
    "equations": {"P[i]": "Ω*w[i] + N*sum(j, a[i, j]*P[j](t - 1))"},
}
AT = {"N": 0.1}
ALONG = {"along": "Ω", "window": [1, 2], "history": {"P": 1}, "N": 1}
PLANE = {
    **{"abscissa": "Ω", "abscissa_window": [1, 2]},
    **{"ordinate": "N", "ordinate_window": [1, 2]},
}
SQUARE = "0, 1\n\n2, 3\n"


@pytest.fixture
def with_network(config, tmp_path, monkeypatch) -> dict:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.csv").write_text(SQUARE)
    config["models"] = {"phases": copy.deepcopy(PHASES)}
    scene = {"model": "phases", "Ω": 1.0, "N": 1.0, "history": {"P": [3.0, 4.0]}, "t_end": 50.0}
    config["scenes"]["mine"] = scene
    return config


def test_network_reaches_the_program(with_network, tmp_path):
    """Its scalars and a history of each node, not the number of these, which its file has."""
    config = checked(with_network)
    groups = scene_groups(config, "mine")
    model = {"name": "phases", "parameters": ["Ω", "N"], "values": [1.0, 1.0]}
    assert groups["scene"]["model"] == {**model, "own_units": True}
    assert groups["histories"] == {"names": ["P"], "values": [3.0, 4.0]}
    network = model_of(config, {"law": "phases"}).network
    assert networks.files_of(network) == ["a.csv"]
    network_numbers.write(tmp_path / "phases.network", network)
    content = (tmp_path / "phases.network").read_bytes()
    counts = np.frombuffer(content, np.int32, 4 + 3 + 3)
    assert counts.tolist() == [2, 1, 1, 3, *(1, 2, 4), *(2, 1, 2)]
    assert np.frombuffer(content[40:]).tolist() == [1, 2, 1, 2, 3]
    assert objects_of({"phases"}, config, "here", True)[1] == "here/models_quad/phases.network"


@pytest.mark.parametrize(
    ("changes", "text", "words"),
    [
        ({"size": {}}, SQUARE, "size = {}; exp"),
        ({"size": {"j": 2}}, SQUARE, "size = {'j': 2}; expected { i: number of nodes }"),
        ({"size": {"i": 1}}, SQUARE, "i = 1; expected a whole number >= 2"),
        ({"equations": {"P": "-P"}}, SQUARE, "size = {'i': 2}; expected none without an index"),
        ({"steady_state": {"P": 0}}, SQUARE, "steady_state: {'P': 0}; expected none of a network"),
        ({}, "0,1\n", "a: a.csv: 1 x 2 numbers; expected 2 rows of 2 numbers"),
        ({}, "", "a.csv: 0 x 0 numbers; expected 2 rows of 2 numbers"),
        ({}, "0,1\n2\n", "a.csv, row 2: 1 numbers; expected 2 rows of 2"),
        ({}, "0,1\n2,3\n4,5\n", "a.csv, row 3: 2 numbers; expected 2 rows of 2"),
        ({}, "0,1\n2,x\n", "a.csv, row 2, column 2: 'x'; expected a finite number"),
        ({}, "0,1\n2,nan\n", "a.csv, row 2, column 2: 'nan'; expected a finite number"),
        (
            {},
            "0,1\n-2,3\n",
            "parameter a[1, 0] = -2; expected a, nondimensional, a finite number >=",
        ),
        ({}, None, "a: a.csv: is no regular file; expected 2 rows of 2 numbers"),
        ({"w": {}}, SQUARE, "w: has an index; expected default or csv, 2 numbers, one for each"),
        ({"w": {"default": [1]}}, SQUARE, "w: 1 numbers; expected 2 numbers, one for each node"),
        ({"w": {"default": [[1, 2], 3]}}, SQUARE, "w: rows of unequal length; expected 2 numbers"),
        ({"Ω": {"default": [1, 2]}}, SQUARE, "default of parameter Ω: [1, 2]; expected a number"),
        ({"Ω": {"csv": "a.csv"}}, SQUARE, "parameter Ω: {'csv': 'a.csv'}; expected keys of"),
    ],
)
def test_wrong_network_is_refused(with_network, changes, text, words):
    """By file, row and column, or by the name of the parameter."""
    model = with_network["models"]["phases"]
    for key, value in changes.items():
        (model["parameters"] if key in model["parameters"] else model)[key] = value
    Path("a.csv").unlink() if text is None else Path("a.csv").write_text(text)
    with pytest.raises(ConfigError) as refused:
        checked(with_network)
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("path", "entry", "words"),
    [
        (("scenes", "mine", "attractors"), {}, "scene 'mine' attractors: model = 'phases'; exp"),
        (("scenes", "mine", "blocks"), 3, "blocks = 3, ends = free; expected neither"),
        (("scenes", "mine", "w"), 1.0, "w is no parameter of the model phases; it has Ω, N"),
        (("scenes", "mine", "history"), {"P": [1]}, "P has 1 numbers; expected one number, or 2,"),
        (("event_sizes", "scenes"), ["mine"], "event_sizes scenes: 'mine'; expected one of: "),
        (
            ("work_precision", "scenes"),
            {"mine": {"t_end": 9.0}},
            "work_precision scenes: 'mine'; expected",
        ),
        (("routes", "lines", "mine"), {**ALONG, "count": 2}, "lines mine: model ="),
        (("cycles", "lines", "mine"), ALONG, "cycles lines mine: model ="),
        (
            ("atlas", "planes", "mine"),
            {**PLANE, "history": {"P": 1}},
            "atlas planes mine: model = 'phases'; expected a",
        ),
        (("hopf_curves", "mine"), PLANE, "hopf_curves mine: model ="),
        (
            ("basins", "places", "mine"),
            {**AT, "Ω": 1, "histories": {"seed": 1, "P": [0, 1]}},
            "places mine: model = 'phases'; expected a model without an index",
        ),
        (
            ("stability", "families", "mine"),
            {**AT, "Ω": 1, "history": {"P": 1.0}, "t_end": 5.0, "reference": "none"},
            "families mine: model = 'phases'; expected a model without an index",
        ),
    ],
)
def test_what_networks_have_not_is_refused(with_network, path, entry, words):
    """Networks have trajectories and exponents."""
    *place, key = path
    section = with_network
    for step in place:
        section = section[step]
    section[key] = {"model": "phases", **entry} if key == "mine" else entry
    with pytest.raises(ConfigError) as refused:
        checked(with_network)
    assert words in str(refused.value)

"""Parts of the atlas, and their namelists."""

import pytest

from scripts.namelists.laws import PAPER
from scripts.studies.atlas.parts import part_of
from scripts.studies.atlas.plan import groups


@pytest.mark.parametrize(
    ("count", "parts", "distance"),
    [*((1, 1, 1), (16, 4, 1), (7, 7, 1), (61, 8, 1), (51, 7, 2), (9, 9, 16), (1000, 31, 16))],
)
def test_parts_hold_every_row_once(count, parts, distance):
    """All parts but the last end with a line that is computed first; sizes are nearly the same."""
    ends = [part_of(count, parts, part, distance) for part in range(1, parts + 1)]
    rows = [row for first, last in ends for row in range(first, last + 1)]
    assert rows == list(range(1, count + 1))
    assert all((last - first) % distance == 0 for first, last in ends[:-1])
    sizes = [last - first + 1 for first, last in ends]
    assert max(sizes) - min(sizes) <= (1 if distance == 1 else 2 * distance - 1)


def test_parts_of_the_atlas_divide_its_delays(own_config):
    """All of epsilon in each part, both windows as a whole, at xi and gamma of the plane."""
    settings = own_config["atlas"]
    delays = []
    for part in range(1, settings["parts"] + 1):
        points = groups(own_config, "fault", str(part))["points"]
        columns, lines = points["axes"]
        assert (columns["along"], lines["along"]) == ("epsilon", "tau")
        assert columns["part"] == [1, settings["abscissa_count"]]
        assert columns["window"] == settings["abscissa_window"]
        assert lines["window"] == settings["planes"]["fault"]["ordinate_window"]
        assert points["refinements"] == settings["refinements"]
        model = {"name": PAPER, "parameters": ["xi", "gamma"], "values": [0.5, 1e8]}
        assert points["model"] == model
        delays += range(lines["part"][0], lines["part"][1] + 1)
    assert delays == list(range(1, settings["ordinate_count"] + 1))


@pytest.mark.parametrize(
    ("columns", "lines", "refinements"),
    [(9, 7, 0), (1, 40, 0), (12, 40, 0), (13, 40, 1), (37, 25, 2), (200, 200, 2)],
)
def test_first_lines_of_a_small_atlas_are_not_too_far_apart(
    own_config, columns, lines, refinements
):
    """At least six distances in each direction, and never more refinements than asked for."""
    counts = {"abscissa_count": columns, "ordinate_count": lines}
    own_config["atlas"] |= {**counts, "parts": 1, "refinements": 2}
    points = groups(own_config, "fault", "1")["points"]
    assert points["refinements"] == refinements

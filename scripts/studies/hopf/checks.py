"""Keys of planes of Hopf curves that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_plane, check_rest, wrong


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the axes."""
    for name, plane in config["hopf_curves"].items():
        place = f"config hopf_curves {name}"
        yield from check_plane(config, place, plane)
        yield from check_rest(config, place, plane)
        # below epsilon = 0 steady sliding of the block is stable
        if plane["abscissa"] == "epsilon" and plane["abscissa_window"][1] <= 0:
            expected = "an end > 0: up to epsilon = 0 there is no Hopf point"
            yield wrong(place, plane, "abscissa_window", expected)

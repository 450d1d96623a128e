"""Parts of a plane of the atlas, each a run of its own."""

LEAST_DISTANCES = 6
"""Distances between the lines of a plane that are computed in full: those of the default grid, of
which it is known how many points get another class than if computed."""


def refinements_of(atlas: dict) -> int:
    """The refinements of the file, or as many as leave enough distances of its first lines."""
    fewest = min(atlas["abscissa_count"], atlas["ordinate_count"]) - 1
    return min(atlas["refinements"], max(0, (fewest // LEAST_DISTANCES).bit_length() - 1))


def part_of(count: int, parts: int, part: int, distance: int = 1) -> list[int]:
    """First and last of `count` lines in part 1..parts, all about as large.

    From the first to the last line of a part but the last, there is a whole number of distances.
    """
    steps = (count - parts) // distance
    first, after = (i * steps // parts * distance + i + 1 for i in (part - 1, part))
    return [first, count if part == parts else after - 1]

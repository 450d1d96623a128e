"""Where a longer delay restores stability."""

import xarray as xr


def amplitude_death(stability: xr.Dataset) -> list[tuple[float, float]]:
    """Delays between which a state that is unstable without delay is stable."""
    if "tau_of_change" not in stability or stability.attrs["unstable_roots_without_delay"] == 0:
        return []
    places = stability.tau_of_change.values
    ends = [*places[1:], float(stability.attrs["tau_most"])]
    roots = stability.tau_change_roots_after.values
    return [
        (float(begin), float(end))
        for begin, end, unstable in zip(places, ends, roots, strict=False)
        if unstable == 0
    ]

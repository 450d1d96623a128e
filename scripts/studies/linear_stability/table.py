"""Linear stability of steady sliding in all scenes, as one table."""

from pathlib import Path

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.tables.amplitude_death import amplitude_death

ROOTS_SHOWN = 3
"""Leading roots in the table, of pairs the one above the real axis."""


def row_of(scene: str, stability: xr.Dataset) -> dict:
    """One scene; several values in a cell are separated by semicolons."""
    known = stability.attrs
    return {
        "scene": scene,
        **{key: float(known[key]) for key in PARAMETERS if key in known},
        "law": law_of(known),
        "unstable_roots": int(known["unstable_roots"]),
        "root_bound": float(known["root_bound"]),
        "roots_above_bound": stability.sizes["root"],
        "leading_roots": leading_roots(stability),
        **{f"{key}_of_changes": changes(stability, key) for key in ("tau", "epsilon")},
        "amplitude_death": "; ".join(
            f"{begin:.12g} to {end:.12g}" for begin, end in amplitude_death(stability)
        ),
    }


def leading_roots(stability: xr.Dataset) -> str:
    """The rightmost roots with their imaginary parts."""
    roots = zip(stability.root_real.values, stability.root_imag.values, strict=True)
    shown = [
        f"{real:.10g} +- {imag:.10g} i" if imag > 0 else f"{real:.10g}"
        for real, imag in roots
        if imag >= 0
    ]
    return "; ".join(shown[:ROOTS_SHOWN])


def changes(stability: xr.Dataset, parameter: str) -> str:
    """Where a pair crosses the axis, with the number of unstable roots before and after.

    Of a user's model it is not looked for.
    """
    if f"{parameter}_of_change" not in stability:
        return ""
    return "; ".join(
        f"{place:.12g} ({before} -> {after})"
        for place, before, after in zip(
            stability[f"{parameter}_of_change"].values,
            stability[f"{parameter}_change_roots_before"].values,
            stability[f"{parameter}_change_roots_after"].values,
            strict=True,
        )
    )


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_table(
            snakemake.output[0],
            [row_of(Path(path).stem, read(path)) for path in snakemake.input.scenes],
        )

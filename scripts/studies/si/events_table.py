"""Slip events of a scene that is given in SI, with units, as text with commas between columns."""

import xarray as xr

from scripts.config.si import in_si, units_of
from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import as_digits, write_table


def columns_of(events: xr.Dataset, si: dict) -> dict:
    """Values of all events by column.

    The force of the spring in (2) is -k u, and u grows by the slip less the way of the plate: in an
    event, v > v0, the stress drops by k (slip - v0 duration).
    """
    values = in_si(si)
    units = units_of(values)
    duration, slip = events.duration.values * units["s"], events.slip.values * units["m"]
    return {
        "onset_s": events.onset.values * units["s"],
        "duration_s": duration,
        "slip_m": slip,
        "peak_velocity_m_per_s": events.peak_velocity.values * units["m/s"],
        "stress_drop_Pa": values["k"] * (slip - values["v0"] * duration),
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        found = columns_of(read(snakemake.input.events), snakemake.params.si)
        rows = zip(
            *([as_digits(x, 12, zero=0) for x in one] for one in found.values()), strict=True
        )
        rows = [dict(zip(found, row, strict=True)) for row in rows]
        write_table(snakemake.output[0], rows, list(found))

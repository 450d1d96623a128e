"""Slip events of a scene that is given in SI, with units, as text with commas between columns."""

import xarray as xr

from scripts.config.si import in_si, units_of
from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import as_digits, write_table

COLUMNS = {
    "onset_s": ("onset", "s"),
    "duration_s": ("duration", "s"),
    "recurrence_time_s": ("recurrence_time", "s"),
    "slip_m": ("slip", "m"),
    "peak_velocity_m_per_s": ("peak_velocity", "m/s"),
}
"""For each column its variable in the results, and its unit."""


def columns_of(events: xr.Dataset, si: dict) -> dict:
    """Values of all events by column.

    The force of the spring in (2) is -k u, and u grows by the slip less the way of the plate: in an
    event, v > v0, the stress drops by k (slip - v0 duration).
    """
    values = in_si(si)
    units = units_of(values)
    columns = {name: events[key].values * units[unit] for name, (key, unit) in COLUMNS.items()}
    grown = columns["slip_m"] - values["v0"] * columns["duration_s"]
    return {**columns, "stress_drop_Pa": values["k"] * grown}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        found = columns_of(read(snakemake.input.events), snakemake.params.si)
        rows = [
            {key: as_digits(value, 12, zero=0) for key, value in zip(found, row, strict=True)}
            for row in zip(*found.values(), strict=True)
        ]
        write_table(snakemake.output[0], rows, list(found))

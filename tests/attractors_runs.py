"""Groups that the program `attractors` accepts, and how tests run it."""

import copy

import xarray as xr

from scripts.namelists.write_namelist import write_groups

OBSERVATION = {
    "t_transient": 100.0,
    "t_observed": 200.0,
    "t_turning": 20.0,
    "interval": 5.0,
    "blocks": 2,
    "exponents": 4,
    "zero_level": 1e-4,
    "longest_bar": 1e-3,
    "doublings": 0,
    "sample_interval": 0.1,
    "window": "hann",
    "segments": 2,
    "overlap": 0.5,
    "peak_floor": 1e-6,
    "peak_prominence": 10.0,
    "tolerance": 1e-6,
    "method": "auto",
    "most_steps": 100000,
}
POINTS = {
    "name": "a part",
    "xi": 0.8,
    "gamma": 0.8,
    "epsilon_window": [0.1, 0.5],
    "epsilon_count": 3,
    "epsilon_part": [2, 3],
    "tau_window": [0.0, 10.0],
    "tau_count": 2,
    "tau_part": [1, 2],
    "theta": [0.0, 0.5],
    "u": [0.0, -0.5],
    "v": [1.1, 1.5],
    "kept": 100,
}


def good_groups() -> dict[str, dict]:
    """Namelist groups that the program accepts, to change."""
    return copy.deepcopy({"observation": OBSERVATION, "points": POINTS})


def run(programs, groups: dict[str, dict]):
    """Run the program with these groups."""
    write_groups(programs.folder / "input.nml", groups)
    return programs.run("attractors", "input.nml", programs.output.name)


def made(programs, groups: dict[str, dict]) -> xr.Dataset:
    """What the program makes of good groups."""
    done = run(programs, groups)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert programs.left_behind() == ["output.nc"]
    return xr.load_dataset(programs.output)

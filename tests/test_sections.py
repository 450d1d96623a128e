"""Each section of the schema in a file of one's own: alone, all, with nothing to show."""

import json

import pytest

from scripts.files.read_config import merge
from scripts.plans.studies import schema
from scripts.workflow.plan import read_plan

PLACE = {"tau": 7.0, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
AT_REST = {**PLACE, "tau": 1.0, "epsilon": 0.1}
SLAB = {"a": 0.01, "b": 0.02, "sigma": "50 MPa", "D_c": "1 cm", "v0": "1e-9 m/s"}
SLAB |= {"G": "30 GPa", "W": "1.5 km", "rho": "2700 kg/m^3"}
PLANE = {"xi": 0.5, "gamma": 0.8}
LINE = {"along": "tau", "epsilon": 0.7, **PLANE}
OBSERVED = {"t_transient": 100.0, "t_observed": 100.0, "t_lasting": 50.0, "t_turning": 20.0}
QUICK = {"observation": {**OBSERVED, "doublings": 0}}
SHORT = {"t_end": 200.0, "t_transient": 50.0}
SECTIONS = {
    "scenes": {
        "s": {**PLACE, **SHORT, "sample_interval": 0.1, "exponents": {}},
        "chain": {**PLACE, **SHORT, "blocks": 3, "kappa": 0.1, "exponents": {}},
        "in_si": {"si": SLAB, "tau": "2.2 years", **SHORT, "sample_interval": "10 days"},
    },
    "hopf_curves": {
        "p": {"ordinate": "tau", **PLANE, "abscissa_window": [0, 1], "ordinate_window": [0, 10]}
    },
    "routes": {**QUICK, "lines": {"r": {**LINE, "window": [1, 3], "count": 2}}},
    "cycles": {"most_orbits": 5, "lines": {"c": {**LINE, "window": [1.0, 2.5]}}},
    "atlas": {
        **{**QUICK, "abscissa_count": 3, "ordinate_count": 3, "parts": 1},
        "planes": {"a": {**PLANE, "ordinate_window": [0, 10]}},
    },
    "claims": {
        "k": {
            **{"place": "here", "claim": "It is chaos.", "look_at": "attractors.tsv"},
            "test": {"attractor_class": {"scene": "chaos", "expected": "chaos"}},
        }
    },
    "chain_modes": {
        **{"blocks": 3, "cells": 10},
        "planes": {"m": {**PLANE, "epsilon_window": [0, 1], "tau_window": [0, 5]}},
    },
    "basins": {**QUICK, "count": 3, "places": {"b": PLACE}},
    "work_precision": {"scenes": {"torus": {"t_end": 20.0}}},
    "stability": {"families": {"f": {**{k: [v] for k, v in PLACE.items()}, "t_end": 10.0}}},
}
NOTHING = {
    "scenes": {
        "s": {**AT_REST, **SHORT, "history": {"v": 1.0, "u": 0.0, "theta": 0.0}},
        "chain": {**AT_REST, **SHORT, "blocks": 3, "kappa": 0.1},
    },
    "hopf_curves": {"p": {**SECTIONS["hopf_curves"]["p"], "abscissa_window": [0, 0.1]}},
    "cycles": {"lines": {"c": {**LINE, "epsilon": 0.1, "window": [0.1, 0.2]}}},
    "chain_modes": merge(SECTIONS["chain_modes"], {"planes": {"m": {"epsilon_window": [0, 0.05]}}}),
}
"""Motions at rest, planes and lines without Hopf points."""
SECTIONS, NOTHING = (
    {name: part for name, part in sections.items() if name in schema()["properties"]}
    for sections in (SECTIONS, NOTHING)
)
"""Those that a study has."""
SETTINGS = {"attractors": QUICK, "exponents": {"t_turning": 50.0, "batches": 3}}


def test_section_is_planned_alone(tmp_path):
    path = tmp_path / "mine.yaml"
    for name, section in SECTIONS.items():
        path.write_text(json.dumps({name: section}))
        assert "<results>/index.html" in read_plan({"user_file": str(path)}).targets()


EACH = [{name: part[name]} for part in (SECTIONS, NOTHING) for name in part]


@pytest.mark.long
@pytest.mark.parametrize(
    "values",
    [*EACH, *({**part, "event_sizes": {"scenes": ["chain"]}} for part in (SECTIONS, NOTHING))],
)
def test_sections_have_a_page(scratch, values):
    """With all figures that the file asks for; alone, and all together."""
    path, results = scratch.folder / "mine.yaml", scratch.folder / "results" / "mine"
    path.write_text(json.dumps(merge(SETTINGS, values)))
    run = scratch.snakemake("--config", "user_file=mine.yaml")
    assert run.returncode == 0, run.stdout
    page = (results / "index.html").read_text()
    for figure in read_plan({"user_file": str(path)}).figures:
        assert f"figures/{figure}.svg" in page
        assert (results / "figures" / f"{figure}.svg").exists()

"""A small page made up for tests, with every part that a page can have."""

import shutil
from pathlib import Path

import numpy as np
import xarray as xr
from conftest import ROOT

from scripts.claims.claims_results import VERDICTS
from scripts.page import page_content, page_views, write_page
from scripts.tables.motion_rows import COLOURS

TEMPLATE = ROOT / "page" / "index.html.jinja"
EQUATIONS = ROOT / "page" / "equations.yaml"
PICTURE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40"><path d="M0 0h9v9"/></svg>'
)


def claim(name: str, verdict: str = VERDICTS[0], **given) -> dict:
    """A row of the ledger."""
    row = {"id": name, "place": "section 1", "claim": f"It is {name}.", "verdict": verdict}
    return {**row, "evidence": "0 < 1 & so on", "instead": "", "look_at": "", **given}


def figure(name: str, category: str = "Figures", *data: str) -> dict:
    """A figure as the rule describes it."""
    caption = str(ROOT / "scripts" / "figures" / "figure_1.rst")
    return {"name": name, "category": category, "caption": caption, "data": list(data)}


def attractor(epsilon: float, tau: float, **given) -> dict:
    """A row of a table of attractors."""
    row = {"epsilon": epsilon, "tau": tau, "xi": 0.5, "gamma": 0.8, "class": "cycle"}
    row |= {f"exponent_{i}": -0.01 * i for i in (1, 2, 3)}
    row |= {f"error_{i}": 0.001 for i in (1, 2, 3)}
    return {**row, "period": 1.0, "reason": np.nan, "problem": np.nan, **given}


def run(count: int = 30001, interval: float = 0.05) -> xr.Dataset:
    """A trajectory of the scene `my_scene`."""
    time = interval * np.arange(count)
    values = {"v": ("time", 1 + 0.5 * np.cos(time)), "u": ("time", 0.5 * np.sin(time))}
    parameters = {"epsilon": 0.5, "tau": 10.0, "xi": 0.8, "gamma": 0.8}
    attributes = {"scene": "my_scene", "sample_interval": interval, **parameters}
    return xr.Dataset(values, {"time": time}, attributes)


def content(**given) -> dict:
    """What the template needs, some of it given."""
    figures = [figure("figure_1"), figure("atlas", "Atlas", "results/tables/a.tsv")]
    claims = [claim(f"claim {i}", verdict) for i, verdict in enumerate(VERDICTS)]
    claims.append(claim("beside", look_at="results/figures/figure_1.png"))
    claims.append(claim("folded", VERDICTS[2], look_at="results/figures/atlas.png"))
    claims.append(claim("equation_8", VERDICTS[1], instead="It is gamma^2."))
    equations = page_content.equations(EQUATIONS, claims)
    others = page_content.beside_figures(claims, equations)
    cells = [attractor(0.1 * i, float(j)) for j in range(3) for i in range(4)]
    own = [
        {**attractor(0.5, 10.0), "scene": scene, "history": 1.0}
        for scene in ("my_scene", "without_u")
    ]
    runs = [run(), run().drop_vars("u").assign_attrs(scene="without_u", tau=11.0)]
    return {
        "opening": "What it is about.",
        "findings": [{"title": "Found.", "words": "At tau = 2.", "claims": claims[:1]}],
        "block": None,
        "hero": page_content.sections([figure("hero")], [])["Figures"][0],
        "equations": equations,
        "figures": page_content.sections(figures, others),
        "unplaced": page_content.claims_by_figure(figures, others)[""],
        "verdicts": page_content.tally(claims),
        "trajectories": [page_views.trajectory(one, own) for one in runs],
        "atlas": page_views.atlas(cells),
        "colours": COLOURS,
        "commit": "unknown",
        "programs": [{"version": "1.0", "compiler": "a compiler", "files": 2}],
        "packages": {"Python": "3.11"},
        "cited": {"licence": "MIT", "works": ["One (2020). A work."]},
        "seconds": [{"rule": "one", "jobs": 2, "seconds": 3.0, "longest": 2.0, "memory": None}],
        **given,
    }


def written_to(folder: Path, assets: Path) -> Path:
    """The page in a folder, with the files it links to and those beside a real page."""
    index = folder / "index.html"
    index.write_text(write_page.rendered(TEMPLATE, **content()))
    shutil.copytree(assets, folder / "page")
    (folder / "figures").mkdir()
    for name in ("figure_1", "atlas", "hero"):
        for ending in ("svg", "pdf", "png"):
            (folder / "figures" / f"{name}.{ending}").write_text(PICTURE)
    (folder / "tables").mkdir()
    for name in ("a.tsv", "claims.tsv", "claims.json"):
        (folder / "tables" / name).write_text("")
    return index

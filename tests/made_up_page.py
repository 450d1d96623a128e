"""A small page made up for tests, with every part that a page can have."""

import shutil
from pathlib import Path

import numpy as np
import xarray as xr
from conftest import ROOT

from scripts.claims.claims_results import VERDICTS
from scripts.page import page_content, page_views, play_data, write_page
from scripts.tables.motion_rows import COLOURS

EQUATIONS = ROOT / "page" / "equations.yaml"
PICTURE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60pt" height="40pt" viewBox="0 0 60 40">'
    '<path d="M0 0h9v9"/></svg>'
)


def claim(name: str, verdict: str = VERDICTS[0], **values) -> dict:
    row = {"id": name, "place": "section 1", "claim": f"It is {name}.", "verdict": verdict}
    row |= {"evidence": "0 < 1 & so on", "instead": "", "look_at": "", "table": ""}
    return {**row, **values}


def figure(folder: Path, name: str, category: str = "Figures", *data: str) -> dict:
    """A figure as the rule describes it; its drawing is in the folder."""
    drawing = folder / "drawing.svg"
    drawing.write_text(PICTURE)
    caption = ROOT / "scripts" / "figures" / "figure_1.rst"
    files = {"caption": str(caption), "drawing": str(drawing), "data": list(data)}
    return {"name": name, "category": category, "shows_classes": False, **files}


def attractor(epsilon: float, tau: float, **given) -> dict:
    row = {"epsilon": epsilon, "tau": tau, "xi": 0.5, "gamma": 0.8, "class": "cycle"}
    row |= {f"exponent_{i}": -0.01 * i for i in (1, 2, 3)}
    row |= {f"error_{i}": 0.001 for i in (1, 2, 3)}
    return {**row, "period": 1.0, "reason": np.nan, "problem": np.nan, **given}


def run(count: int = 30001, interval: float = 0.05) -> xr.Dataset:
    time = interval * np.arange(count)
    values = {"v": ("t", 1 + 0.5 * np.cos(time)), "u": ("t", 0.5 * np.sin(time))}
    parameters = {"epsilon": 0.5, "tau": 10.0, "xi": 0.8, "gamma": 0.8}
    attributes = {"scene": "my_scene", "sample_interval": interval, **parameters}
    return xr.Dataset(values, {"t": time}, attributes)


def atlas_run(*paths: np.ndarray | None) -> xr.Dataset:
    """A part of the atlas with these paths, as far as the page reads it."""
    moving = [path for path in paths if path is not None]
    lengths = [0 if path is None else path.shape[1] for path in paths]
    values = {"path_length": ("point", lengths)}
    if moving:
        columns = np.concatenate(moving, axis=1)
        names = ("path_time", "path_u", "path_ln_v")
        values |= {
            name: ("path_point", column) for name, column in zip(names, columns, strict=True)
        }
    return xr.Dataset(values, attrs={"t_path": 60.0})


def turn(period: float, largest: float) -> np.ndarray:
    """One period of a made-up cycle: time, u and ln v."""
    time = np.linspace(0, period, 41)
    phase = 2 * np.pi * time / period
    return np.array([time, -largest * np.cos(phase), np.log(largest) * np.sin(phase)])


def play() -> str:
    """Two planes: classes change with epsilon; the last point of the first was not computed."""
    none = {f"exponent_{i}": np.nan for i in (1, 2, 3)}
    rows, paths = [], []
    for xi in (0.5, 0.8):
        for tau in (0.0, 5.0):
            rows += [
                attractor(0.1, tau, xi=xi, **{"class": "fixed point"}, f1=np.nan, f2=np.nan),
                attractor(0.2, tau, xi=xi, f1=0.1, f2=np.nan),
                attractor(0.3, tau, xi=xi, period=2.0, f1=0.05, f2=np.nan),
                attractor(0.4, tau, xi=xi, **{"class": "chaos"}, f1=np.nan, f2=np.nan),
            ]
            later = np.add(turn(30.0, 90.0), [[30.0], [0.0], [0.0]])
            longer = np.concatenate([turn(30.0, 40.0), later], axis=1)
            paths += [None, turn(10.0, 3.0), turn(20.0, 5.0), longer]
    rows[7] |= {"computed": "no", **none}
    paths[7] = None
    scenes = {"my_scene": {"xi": 0.8, "gamma": 0.8, "epsilon": 0.21, "tau": 4.0}}
    return play_data.write_script(rows, [atlas_run(*paths[:3]), atlas_run(*paths[3:])], scenes)


def content(folder: Path, **values) -> dict:
    """What the template needs for the page of the paper, some of it given."""
    claims = [claim(f"claim {i}", verdict) for i, verdict in enumerate(VERDICTS)]
    beside = [
        claim("beside", look_at="results/figures/figure_1.png"),
        claim("folded", VERDICTS[2], look_at="results/figures/atlas.png"),
    ]
    about_equations = [claim("equation_8", VERDICTS[1], instead="It is $gamma^2$.")]
    names = ("figure_1", "Figures"), ("atlas", "Atlas", "results/tables/a.tsv"), ("hero", "Atlas")
    given = [figure(folder, *name) for name in names]
    first, atlas, hero = page_content.describe_figures(given, beside, Path("results"))
    motions = [
        {**attractor(0.5, 10.0), "scene": scene, "history": 1.0}
        for scene in ("my_scene", "without_u")
    ]
    runs = [run(), run().drop_vars("u").assign_attrs(scene="without_u", tau=11.0)]
    all_claims = claims + beside + about_equations
    paper = {
        "opening": "What it is about.",
        "main_claims": [],
        "findings": [{"title": "Found.", "words": "At $tau = 2$.", "claims": claims[:1]}],
        "block": None,
        "hero": hero,
        "cited": {"licence": "MIT", "works": ["One (2020). A work."]},
        **page_content.set_equations(EQUATIONS, all_claims),
    }
    return {
        "name": "mine",
        "paper": paper,
        "sections": {"The paper in its order": [first]},
        "appendices": {"Atlas": [atlas]},
        "claims": all_claims,
        "verdicts": page_content.tally(all_claims),
        "unplaced": claims,
        "tables": [],
        "trajectories": [page_views.describe_run(one, motions) for one in runs],
        "atlas": "atlas",
        "history": {"theta": 0.0, "u": 0.0, "v": 1.5},
        "colours": COLOURS,
        "commit": "unknown",
        "programs": [{"version": "1.0", "compiler": "a compiler", "files": 2}],
        "packages": {"Python": "3.11"},
        **values,
    }


def written_to(folder: Path, assets: Path) -> Path:
    """The page in a folder, with the files it links to and those beside a real page."""
    index = folder / "index.html"
    index.write_text(write_page.render("index.html.jinja", **content(folder)))
    shutil.copytree(assets, folder / "page")
    (folder / "page" / "play-data.js").write_text(play())
    (folder / "times.html").write_text("")
    (folder / "figures").mkdir()
    for name in ("figure_1", "atlas", "hero"):
        for ending in ("svg", "pdf", "png"):
            (folder / "figures" / f"{name}.{ending}").write_text(PICTURE)
    (folder / "tables").mkdir()
    for name in ("a.tsv", "claims.tsv", "claims.json"):
        (folder / "tables" / name).write_text("")
    return index

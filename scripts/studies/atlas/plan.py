"""Figure of the atlas: classes of motion and the largest exponent over epsilon and tau.

Formulas and sources: `attractors.f90`, `motion_classes.f90`, `section_motion.f90`,
`refined_grid.f90`; motions on the page `motion_path.f90`.
"""

from pathlib import PurePath

from scripts.plans.declare import LONG_RUN, Figure, Run, Study, Table
from scripts.plans.scenes import curves_of, marked_scenes, plane_of
from scripts.requests.attractor_surveys import survey_groups

LEAST_DISTANCES = 6
"""Distances between the lines of a plane that are computed in full: those of the default grid, of
which it is known how many points get another class than if computed."""


def groups(config: dict, atlas_plane: str, part: str) -> dict:
    """Namelist of a part of the atlas: some lines of a plane.

    A part is refined by itself, from every 2**refinements-th of its lines and from the last.
    """
    atlas = config["atlas"]
    settings, refinements = atlas["planes"][atlas_plane], refinements_of(atlas)
    count = atlas["ordinate_count"]
    shown = part_of(count, atlas["parts"], int(part), 2**refinements)
    window = settings.get("abscissa_window", atlas["abscissa_window"])
    columns = {"window": window, "count": atlas["abscissa_count"]}
    lines = {"window": settings["ordinate_window"], "count": count, "part": shown}
    name = f"{atlas_plane} part {int(part)} of {atlas['parts']}"
    place = {**settings, settings["abscissa"]: columns, settings["ordinate"]: lines}
    histories = [settings.get("history", atlas["history"])]
    return survey_groups(
        config, "atlas", name, place=place, histories=histories, refinements=refinements
    )


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


def parts_of_plane(config: dict, atlas_plane: str) -> list[str]:
    """Parts of a plane."""
    parts = range(1, config["atlas"]["parts"] + 1)
    return [f"<results>/attractors/atlas/{atlas_plane}/{part:04}.nc" for part in parts]


def parts_of_atlas(config: dict) -> list[str]:
    """Parts of all planes."""
    return [path for plane in config["atlas"]["planes"] for path in parts_of_plane(config, plane)]


def table_of_atlas(config: dict) -> str:
    """The table of all planes; that of a plane if it is the only one."""
    planes = list(config["atlas"]["planes"])
    return f"<results>/tables/atlas{'/' + planes[0] if len(planes) == 1 else ''}.tsv"


def within(config: dict, kind: str, entries: dict[str, dict]) -> list[str]:
    """Results of one kind about entries that lie in planes of the atlas."""
    planes = [plane_of(config, plane) for plane in config["atlas"]["planes"].values()]
    return [
        f"<results>/{kind}/{name}.nc"
        for name, entry in entries.items()
        if plane_of(config, entry) in planes
    ]


def curves_of_atlas(config: dict) -> list[str]:
    """Hopf curves that lie in planes of the atlas."""
    return within(config, "hopf", config["hopf_curves"])


def lines_with_curves(config: dict) -> dict[str, dict]:
    """Lines of cycles with curves over two parameters, as planes of these."""
    lines = config["cycles"]["lines"]
    axes = {name: list(curves_of(config, line) or ()) for name, line in lines.items()}
    return {
        name: {**lines[name], "abscissa": two[0], "ordinate": two[1]}
        for name, two in axes.items()
        if lines[name]["along"] in two
    }


def inputs(config: dict) -> dict:
    """Classes of motion, and the Hopf curves and curves of cycles in the same planes."""
    return {
        "table": table_of_atlas(config),
        "curves": curves_of_atlas(config),
        "cycles": within(config, "cycles", lines_with_curves(config)),
    }


FIGURE = {
    "category": "Atlas",
    "inputs": inputs,
    "params": lambda config: {"scenes": marked_scenes(config)},
}
STUDY = Study(
    reads=("attractors", "basins", "cycles", "hopf", "routes", "scenes"),
    entries={"atlas_plane": ("atlas", "planes")},
    wildcards={"part": r"\d+"},
    runs=(
        Run(
            *("atlas_runs", "attractors", "attractors/atlas/{atlas_plane}/{part}.nc", groups),
            **LONG_RUN,
        ),
    ),
    tables=(
        Table(
            *("atlas_table", "tables/atlas.tsv"),
            lambda config: {"runs": parts_of_atlas(config)},
            params={"of": lambda _config: "atlas"},
            script="tables/attractor_tables.py",
        ),
        Table(
            *("atlas_plane_table", "tables/atlas/{atlas_plane}.tsv"),
            lambda config, atlas_plane: {"runs": parts_of_plane(config, atlas_plane)},
            params={"of": lambda _config, **_: "atlas"},
            script="tables/attractor_tables.py",
        ),
        Table(
            *("play_data", "page/play-data.js"),
            lambda config: {"runs": parts_of_atlas(config), "tables": [table_of_atlas(config)]},
            params={"scenes": marked_scenes},
            script="play_data.py",
        ),
    ),
    figures=(Figure("atlas", place=310, **FIGURE),),
    kinds=(Figure("atlas", place=60, shows=("atlas", "planes"), **FIGURE),),
    uses=lambda config: {"plane": [PurePath(path).stem for path in curves_of_atlas(config)]},
)

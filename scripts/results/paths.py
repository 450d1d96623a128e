"""Paths of results, and what figures mark of scenes, by the configuration.

In paths `<results>` stands for the folder of the results.
"""

from scripts.namelists.chains import motion_chains, stiffness_of_modes
from scripts.namelists.laws import OWN, law_in_words, own_parameters, own_place
from scripts.namelists.study_cases import HISTORY, PARAMETERS


def scenes_of(config: dict, figure: str) -> list[str]:
    """Scenes of a figure's rows, in order."""
    return [row["scene"] for row in config["figures"][figure]["rows"].values()]


def paths_of_scenes(kind: str, scenes: list[str]) -> list[str]:
    """The results of scenes, of one kind: the name of their folder."""
    return [f"<results>/{kind}/{scene}.nc" for scene in scenes]


def scenes_with(config: dict, key: str) -> list[str]:
    """Scenes that ask for `exponents` or `attractors`, or that are given in `si`."""
    return [name for name, scene in config["scenes"].items() if key in scene]


def exponents_of_scenes(config: dict) -> list[str]:
    """Exponents of all scenes that ask for them."""
    return paths_of_scenes("exponents", scenes_with(config, "exponents"))


def runs_of_route(config: dict, line: str) -> list[str]:
    """Runs along a route: from each history, and sweeps of a parameter."""
    routes = config["routes"]
    swept = [] if routes["lines"][line]["along"] in HISTORY else routes["sweeps"]
    runs = [*routes["histories"], *swept]
    return [f"<results>/attractors/routes/{line}/{run}.nc" for run in runs]


def runs_of_routes(config: dict) -> list[str]:
    """Runs along all routes."""
    return [path for line in config["routes"]["lines"] for path in runs_of_route(config, line)]


def tables_of_routes(config: dict) -> list[str]:
    """Tables of all routes."""
    return [f"<results>/tables/routes/{line}.tsv" for line in config["routes"]["lines"]]


def cycles_of_lines(config: dict) -> list[str]:
    """Cycles followed along all lines."""
    return [f"<results>/cycles/{line}.nc" for line in config["cycles"]["lines"]]


def sweeps_on_lines(config: dict) -> dict[str, list[str]]:
    """Sweeps on each line of cycles: those of the route with the widest window."""
    keys = ("along", *PARAMETERS)

    def place(settings: dict) -> dict:
        return {key: settings.get(key) for key in keys} | own_place(config, settings)

    found = {}
    for line, settings in config["cycles"]["lines"].items():
        routes = [
            (route["window"][1] - route["window"][0], name)
            for name, route in config["routes"]["lines"].items()
            if place(route) == place(settings)
        ]
        found[line] = [
            f"<results>/attractors/routes/{name}/{run}.nc"
            for _, name in sorted(routes)[-1:]
            for run in config["routes"]["sweeps"]
        ]
    return found


def runs_of_basins(config: dict) -> list[str]:
    """Runs at the places where motions coexist."""
    return [f"<results>/attractors/basins/{place}.nc" for place in config["basins"]["places"]]


def parts_of_plane(config: dict, plane: str) -> list[str]:
    """Parts of a plane of the atlas."""
    parts = range(1, config["atlas"]["parts"] + 1)
    return [f"<results>/attractors/atlas/{plane}/{part:04}.nc" for part in parts]


def parts_of_atlas(config: dict) -> list[str]:
    """Parts of all planes of the atlas."""
    return [path for plane in config["atlas"]["planes"] for path in parts_of_plane(config, plane)]


def runs_of_laws(config: dict) -> list[str]:
    """Runs of all laws of friction that are compared: a plane or a scene each."""
    study = config["friction_laws"]
    return [
        f"<results>/attractors/laws/{law}/{part}.nc"
        for law in study["laws"]
        for part in [*study["planes"], *study["scenes"]]
    ]


def curves_of_modes(config: dict) -> list[str]:
    """Hopf curves of the modes of a chain, plane by plane."""
    study = config["chain_modes"]
    modes = range(len(stiffness_of_modes(study)))
    return [f"<results>/modes/{plane}/{mode}.nc" for plane in study["planes"] for mode in modes]


def runs_of_motions(config: dict) -> dict[str, list[str]]:
    """Trajectories and exponents of chains of scenes, in the same order."""
    names = motion_chains(config)
    return {
        "trajectories": [f"<results>/chain_motions/{name}.nc" for name in names],
        "exponents": [f"<results>/chain_exponents/{name}.nc" for name in names],
    }


def slips_of_chains(config: dict) -> list[str]:
    """Slips of the blocks of chains whose events are sized."""
    return [f"<results>/chain_slips/{name}.nc" for name in config["event_sizes"]["chains"]]


def events_of_chains(config: dict) -> list[str]:
    """Tables of the events of these chains."""
    return [f"<results>/tables/chain-events/{name}.tsv" for name in config["event_sizes"]["chains"]]


def table_of_atlas(config: dict) -> str:
    """The table of all planes of the atlas; that of a plane if it is the only one."""
    planes = list(config["atlas"]["planes"])
    return f"<results>/tables/atlas{'/' + planes[0] if len(planes) == 1 else ''}.tsv"


def curves_of_atlas(config: dict) -> list[str]:
    """Hopf curves that lie in planes of the atlas."""
    atlas = config["atlas"]
    planes = [_plane(config, plane) for plane in atlas["planes"].values()]
    return [
        f"<results>/hopf/{name}.nc"
        for name, plane in config["hopf_curves"].items()
        if _plane(config, plane) in planes
    ]


def cycles_in_atlas(config: dict) -> list[str]:
    """Cycles followed along lines that lie in planes of the atlas."""
    planes = [_plane(config, plane) for plane in config["atlas"]["planes"].values()]
    return [
        f"<results>/cycles/{name}.nc"
        for name, line in config["cycles"]["lines"].items()
        if _plane(config, line, "tau") in planes
    ]


def _plane(config: dict, settings: dict, ordinate: str = "") -> dict:
    """What an entry has fixed in a plane of epsilon and an ordinate, by default its own."""
    axes = ("epsilon", ordinate or settings["ordinate"])
    place = {key: settings.get(key) for key in PARAMETERS} | own_place(config, settings)
    return {**{key: value for key, value in place.items() if key not in axes}, "ordinate": axes[1]}


def own_values(config: dict, settings: dict) -> dict[str, float]:
    """The law's own parameters of an entry by their keys in results."""
    return {f"{OWN}{key}": settings[key] for key in own_parameters(config, settings["law"])}


def places_in_atlas(config: dict) -> dict[str, dict]:
    """Parameters of the scenes that the atlas marks: those whose attractors are looked for."""
    return {
        scene: {
            **{key: config["scenes"][scene][key] for key in PARAMETERS},
            "law": law_in_words(config, config["scenes"][scene]),
            **own_values(config, config["scenes"][scene]),
        }
        for scene in scenes_with(config, "attractors")
    }


def places_in_plane(config: dict, plane: str) -> dict[str, dict]:
    """Parameters of the scenes that lie in a plane of Hopf curves."""
    settings = config["hopf_curves"][plane]
    return {
        scene: place
        for scene, place in places_in_atlas(config).items()
        if _plane(config, config["scenes"][scene], settings["ordinate"]) == _plane(config, settings)
    }

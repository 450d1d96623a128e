"""Results of scenes by their paths, and what figures mark of scenes, by the configuration."""

from scripts.models.models import model_of
from scripts.models.records import place_of, record_of


def scenes_of(config: dict, figure: str) -> list[str]:
    """Scenes of a figure's rows, in order."""
    return [row["scene"] for row in config["figures"][figure]["rows"].values()]


def paths_of_scenes(kind: str, scenes: list[str]) -> list[str]:
    """The results of scenes, of one kind: the name of their folder."""
    return [f"<results>/{kind}/{scene}.nc" for scene in scenes]


def scenes_with(config: dict, key: str) -> list[str]:
    """Scenes that ask for `exponents` or `attractors`, or that are given in `si`."""
    return [name for name, scene in config["scenes"].items() if key in scene]


def plane_of(config: dict, settings: dict, axes: tuple[str, str] = ()) -> dict:
    """What an entry has fixed in a plane of two parameters, by default of its own axes."""
    axes = axes or (settings["abscissa"], settings["ordinate"])
    place = place_of(config, settings)
    fixed = {key: value for key, value in place.items() if key not in axes}
    return {**fixed, "abscissa": axes[0], "ordinate": axes[1]}


def is_chain(config: dict, scene: str) -> bool:
    """Whether a scene has more than one block."""
    return config["scenes"][scene]["blocks"] > 1 and not is_network(config, scene)


def is_network(config: dict, scene: str) -> bool:
    """Whether a scene has nodes."""
    return bool(model_of(config, config["scenes"][scene]).network)


def is_block(config: dict, scene: str) -> bool:
    """Whether a scene has one block."""
    return config["scenes"][scene]["blocks"] == 1


def blocks_of(config: dict) -> list[str]:
    """Scenes of one block."""
    return [name for name in config["scenes"] if is_block(config, name)]


def roots_of_scenes(config: dict) -> list[str]:
    """Roots of the scenes of one block whose model declares a state at rest."""
    scenes = config["scenes"]
    names = [name for name in blocks_of(config) if model_of(config, scenes[name]).has_rest]
    return paths_of_scenes("linear_stability", names)


def marked_scenes(config: dict) -> dict[str, dict]:
    """Records of the scenes that figures mark: of one block, with attractors looked for."""
    names = [name for name in scenes_with(config, "attractors") if is_block(config, name)]
    return {name: record_of(config, config["scenes"][name]) for name in names}


def scenes_in_plane(config: dict, settings: dict) -> dict[str, dict]:
    """Records of the marked scenes that lie in a plane."""
    axes = (settings["abscissa"], settings["ordinate"])
    return {
        name: place
        for name, place in marked_scenes(config).items()
        if plane_of(config, config["scenes"][name], axes) == plane_of(config, settings)
    }


def curves_of(config: dict, line: dict) -> dict | None:
    """Windows of two parameters in which curves of cycles on a line are followed: its own ones, or
    those of the block."""
    shared = config["cycles"].get("curves") if model_of(config, line).is_block else None
    return line.get("curves", shared)

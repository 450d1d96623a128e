"""Files that lie beside the page, and where they come from."""

from pathlib import Path

PROJECT = Path(__file__).parents[2]
LIBRARY = "/usr/share/javascript/dygraphs"
"""Where Debian's libjs-dygraphs is."""
ASSETS = {
    "style.css": "page/style.css",
    "views.js": "page/views.js",
    "claims.js": "page/claims.js",
    "licence.txt": "LICENSE",
    "citation.txt": "CITATION.cff",
    "readme.txt": "README.md",
    "findings.txt": "docs/findings.md",
    "methods.txt": "docs/method.md",
    "verification.txt": "docs/verification.md",
    "play.css": "page/play.css",
    "play.js": "page/play.js",
    "dygraph.min.js": f"{LIBRARY}/dygraph.min.js",
    "dygraph.min.css": f"{LIBRARY}/dygraph.min.css",
    "dygraph-licence.txt": "/usr/share/doc/libjs-dygraphs/copyright",
}
"""Each file by its name in results/page/."""


class AssetError(ValueError):
    """Files that the page needs and that are not there."""


def files() -> list[str]:
    """All files of the project and of Debian that a page is made of."""
    own = [path.relative_to(PROJECT) for path in PROJECT.glob("page/**/*") if path.is_file()]
    return sorted({*map(str, own), *ASSETS.values()})


def library() -> list[str]:
    """Debian's files; raise AssetError where one is missing."""
    debian = [path for path in ASSETS.values() if Path(path).is_absolute()]
    missing = [path for path in debian if not Path(path).exists()]
    if missing:
        raise AssetError(
            f"the page needs {', '.join(missing)} (Debian's libjs-dygraphs); run ./reproduce, which"
            " sets up what is missing"
        )
    return debian

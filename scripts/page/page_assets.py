"""Files that lie beside the page, and where they come from."""

from pathlib import Path

PROJECT = Path(__file__).parents[2]
PARTS = sorted(f"page/parts/{path.name}" for path in PROJECT.glob("page/parts/*.jinja"))
"""Parts of the page's template."""
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


def sources() -> list[str]:
    """Where the files come from; raise AssetError where one is missing."""
    missing = [path for path in ASSETS.values() if not (PROJECT / path).exists()]
    if missing:
        raise AssetError(
            f"the page needs {', '.join(missing)} (Debian's libjs-dygraphs); run ./reproduce, which"
            " sets up what is missing"
        )
    return list(ASSETS.values())

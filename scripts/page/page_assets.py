"""Files that lie beside the page, and where they come from."""

from pathlib import Path

PROJECT = Path(__file__).parents[2]
ASSETS = {
    "style.css": "page/style.css",
    "claims.js": "page/claims.js",
    "licence.txt": "LICENSE",
    "citation.txt": "CITATION.cff",
    "readme.txt": "README.md",
    "findings.txt": "docs/findings.md",
    "methods.txt": "docs/method.md",
    "verification.txt": "docs/verification.md",
    "play.css": "page/play.css",
    "play.js": "page/play.js",
}
"""Source of each file, by its name in the folder `page` of the results."""


def list_files() -> list[str]:
    """Paths of all files of the project that a page is made of."""
    templates = [path.relative_to(PROJECT) for path in PROJECT.glob("page/**/*") if path.is_file()]
    return sorted({*map(str, templates), *ASSETS.values()})

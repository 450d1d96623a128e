"""Files that lie beside the page, and where they come from."""

from pathlib import Path

PROJECT = Path(__file__).parents[2]
TEMPLATES = PROJECT / "scripts/page/templates"
ASSETS = {
    "style.css": "scripts/page/templates/style.css",
    "claims.js": "scripts/page/templates/claims.js",
    "licence.txt": "LICENSE",
    "citation.txt": "CITATION.cff",
    "readme.txt": "README.md",
    "findings.txt": "docs/findings.md",
    "methods.txt": "docs/method.md",
    "verification.txt": "docs/verification.md",
    "play.css": "scripts/page/templates/play.css",
    "play.js": "scripts/page/templates/play.js",
}
"""Source of each file, by its name in the folder `page` of the results."""


def list_files() -> list[str]:
    """Paths of all files of the project that a page is made of."""
    templates = [path for path in TEMPLATES.rglob("*") if path.is_file()]
    return sorted({*(str(path.relative_to(PROJECT)) for path in templates), *ASSETS.values()})

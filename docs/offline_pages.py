"""Pages made by FORD without what they would fetch from elsewhere when they are read.

    docs/offline_pages.py FOLDER

Bootstrap comes from Debian's libjs-bootstrap5 instead, beside the pages; MathJax is left out, since
no comment uses it.
"""

import os
import re
import shutil
import sys
from pathlib import Path

BOOTSTRAP = Path("/usr/share/javascript/bootstrap5")
STYLE = "css/bootstrap.min.css"
SCRIPT = "js/bootstrap.bundle.min.js"
FETCHED = re.compile(r'<(?:link|script)[^>]*?(?:href|src)="(https?:[^"]*)"[^>]*>(?:\s*</script>)?')


def offline(page: str, to_root: str) -> str:
    """A page that links to files of its own only; ValueError where it fetches what is unknown."""

    def own(link: re.Match[str]) -> str:
        if "bootstrap" in link[1] and link[1].endswith(".css"):
            return f'<link href="{to_root}/{STYLE}" rel="stylesheet">'
        if "bootstrap" in link[1]:
            return f'<script src="{to_root}/{SCRIPT}"></script>'
        if "MathJax" in link[1]:
            return ""
        raise ValueError(f"fetches {link[1]}; expected Bootstrap and MathJax only")

    return FETCHED.sub(own, page)


def main(folder: Path) -> None:
    """Change all pages of the folder."""
    for name in (STYLE, SCRIPT):
        shutil.copy(BOOTSTRAP / name, folder / name)
    for path in sorted(folder.rglob("*.html")):
        try:
            path.write_text(offline(path.read_text(), os.path.relpath(folder, path.parent)))
        except ValueError as problem:
            sys.exit(f"offline_pages: {path}: {problem}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

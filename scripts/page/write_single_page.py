"""The page as one file, which opens at any place and without network."""

import base64
import hashlib
import re
from pathlib import Path
from urllib.parse import quote

from scripts.files.outputs import logged
from scripts.page.write_page import write_text

NOTE = """<p class="place">This is the page in one file. Files that it names are in the folder
<code>results/</code> after a run.</p>
</header>"""


def in_one_file(page: str, folder: Path) -> str:
    """The page with styles, pictures and scripts of its folder inside; other links are words."""

    def put_in(pattern: str, before: str, after: str, change=str) -> None:
        nonlocal page
        page = re.sub(
            pattern, lambda at: before + change((folder / at[1]).read_text()) + after, page
        )

    def picture(text: str) -> str:
        return quote(text, safe=" =:/<>;,()'")

    def script(text: str) -> str:
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        allowed.append(f"'sha256-{digest}'")
        return text

    allowed = ["script-src"]
    page = re.sub(r'(?s)<a href="(?!#)[^"]*">(.*?)</a>', r"\1", page).replace("</header>", NOTE, 1)
    put_in(r'<link rel="stylesheet" href="([^"]+)">', "<style>", "</style>")
    put_in(r'<img src="([^"]+)"', '<img src="data:image/svg+xml,', '"', picture)
    put_in(r'<script src="([^"]+)">', "<script>", "", script)
    return page.replace("script-src 'self' file:", " ".join(allowed), 1)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        path = Path(snakemake.input.page)
        write_text(snakemake.output[0], in_one_file(path.read_text(), path.parent))

"""The page as one file, which opens at any place and without network."""

import base64
import hashlib
import re
from pathlib import Path
from urllib.parse import quote

from scripts.files.outputs import logged
from scripts.page.write_page import write_text

NOTE = """<p class="place">This is the page in one file. Files that it names are in the folder
<code>results/</code> after a run.</p>"""


def in_one_file(page: str, folder: Path) -> str:
    """The page with the styles, pictures and scripts of its folder inside; other links are words.

    Its policy allows these scripts alone, by their digests.
    """
    digests = []

    def script(found: re.Match) -> str:
        text = (folder / found[1]).read_text()
        digest = hashlib.sha256(text.encode()).digest()
        digests.append(f"'sha256-{base64.b64encode(digest).decode()}'")
        return f"<script>{text}</script>"

    def picture(found: re.Match) -> str:
        text = quote((folder / found[1]).read_text(), safe=" =:/<>;,()'")
        return f'<img src="data:image/svg+xml,{text}"'

    page = re.sub(r'(?s)<a href="(?!#)[^"]*">(.*?)</a>', r"\1", page)
    page = re.sub(
        r'<link rel="stylesheet" href="([^"]+)">',
        lambda found: f"<style>{(folder / found[1]).read_text()}</style>",
        page,
    )
    page = re.sub(r'<img src="([^"]+)"', picture, page)
    page = re.sub(r'<script src="([^"]+)"></script>', script, page)
    page = page.replace("script-src 'self' file:", f"script-src {' '.join(digests)}", 1)
    return page.replace("</header>", f"{NOTE}\n</header>", 1)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        path = Path(snakemake.input.page)
        write_text(snakemake.output[0], in_one_file(path.read_text(), path.parent))

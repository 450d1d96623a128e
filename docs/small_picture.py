"""Figures at half their size and with 256 colours, small enough to be committed.

    python docs/small_picture.py

draws docs/NAME.png of all `FIGURES` from results/figures/. Given a picture and what to write,

    python docs/small_picture.py PICTURE.png docs/NAME.png

it draws docs/page.png from build/page.png: after `tools/setup/setup.sh tests/browser`

    tests/browser/.venv/bin/python docs/page_picture.py results/index.html build/page.png
"""

import sys
from pathlib import Path

from PIL import Image

FIGURES = [
    *(f"figure-{number}" for number in range(1, 9)),
    *("atlas", "chain", "event-sizes", "work-precision"),
]


def shrink(figure: Path, picture: Path) -> None:
    """Write the small picture; its bytes depend on the figure's only."""
    with Image.open(figure) as large:
        half = large.convert("RGB").resize((large.width // 2, large.height // 2), Image.LANCZOS)
    few = half.quantize(256, method=Image.Quantize.MEDIANCUT, kmeans=3)
    few.save(picture, optimize=True)


if __name__ == "__main__":
    made = {f"docs/{name}.png": f"results/figures/{name.replace('-', '_')}.png" for name in FIGURES}
    for picture, figure in {sys.argv[2]: sys.argv[1]}.items() if sys.argv[1:] else made.items():
        shrink(Path(figure), Path(picture))

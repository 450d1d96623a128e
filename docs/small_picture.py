"""A figure at half its size and with 256 colours, small enough to be committed.

    python docs/small_picture.py FIGURE.png PICTURE.png

draws docs/work-precision.png from results/figures/work_precision.png, docs/atlas.png from
results/figures/atlas.png, docs/chain.png from results/figures/chain.png, docs/event-sizes.png
from results/figures/event_sizes.png, and docs/dense-output.png from results/tables/dense-output.png
of `benchmarks/run dense`. For docs/page.png, after `setup/setup.sh tests/browser`:

    tests/browser/.venv/bin/python docs/page_picture.py results/index.html build/page.png
    python docs/small_picture.py build/page.png docs/page.png
"""

import sys
from pathlib import Path

from PIL import Image


def shrink(figure: Path, picture: Path) -> None:
    """Write the small picture; its bytes depend on the figure's only."""
    with Image.open(figure) as large:
        half = large.convert("RGB").resize((large.width // 2, large.height // 2), Image.LANCZOS)
    half.quantize(256, method=Image.Quantize.FASTOCTREE).save(picture, optimize=True)


if __name__ == "__main__":
    shrink(Path(sys.argv[1]), Path(sys.argv[2]))

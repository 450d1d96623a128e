"""The top of the page of results, down to the end of the findings, as small_picture.py takes it.

docs/page_picture.py PAGE.html PICTURE.png
"""

import base64
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "browser"))

from visit import browser, emulate

WIDTH = 1200
"""Of the window, in CSS pixels: the figures stand beside the words."""
SCALE = 1.5
"""Pixels of the picture for one of the window; small_picture.py halves them."""


def take_picture(page: Path, picture: Path) -> None:
    """Write the picture, light as on paper."""
    chrome = browser()
    try:
        emulate(chrome, WIDTH)
        chrome.get(page.resolve().as_uri())
        end = "return document.getElementById('findings').getBoundingClientRect().bottom"
        clip = {"x": 0, "y": 0, "width": WIDTH, "height": chrome.execute_script(end)}
        wanted = {"captureBeyondViewport": True, "clip": {**clip, "scale": SCALE}}
        taken = chrome.execute_cdp_cmd("Page.captureScreenshot", wanted)["data"]
    finally:
        chrome.quit()
    picture.write_bytes(base64.b64decode(taken))


if __name__ == "__main__":
    take_picture(Path(sys.argv[1]), Path(sys.argv[2]))

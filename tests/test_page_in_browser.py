"""The page in a real browser: nothing fails, nothing is asked of elsewhere, all can be used."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from conftest import ROOT
from scripts.claims.claims_results import VERDICTS
from scripts.page.write_single_page import in_one_file

BROWSER = ROOT / "tests" / "browser"
PYTHON = BROWSER / ".venv" / "bin" / "python"
pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        not (PYTHON.exists() and Path("/usr/bin/chromium").exists()),
        reason="no Chromium; `tools/setup/setup.sh tests/browser` sets it up, and so does ./test",
    ),
]


def mailed(smoke, folder: Path) -> Path:
    """The page of the smoke run after its folder was zipped and unpacked elsewhere."""
    archive = shutil.make_archive(folder / "results", "zip", smoke.folder / "results")
    shutil.unpack_archive(archive, folder / "unpacked")
    return folder / "unpacked" / "index.html"


@pytest.fixture(scope="module")
def visited(smoke, tmp_path_factory) -> tuple[Path, dict]:
    """The page of the smoke run, unpacked from a mail, and what the browser saw of it."""
    page = mailed(smoke, tmp_path_factory.mktemp("page"))
    single = tmp_path_factory.mktemp("single") / "any-name.html"
    single.write_text(in_one_file(page.read_text(), page.parent))
    run = subprocess.run(
        [PYTHON, BROWSER / "visit.py", page, single], capture_output=True, text=True, timeout=300
    )
    assert run.returncode == 0, run.stderr
    return page, json.loads(run.stdout)


@pytest.fixture
def seen(visited) -> dict:
    return visited[1]


def test_nothing_is_complained_about(seen):
    assert seen["console"] == []
    assert seen["failed"] == []


def test_nothing_is_asked_of_elsewhere(visited):
    """Every request is for a file beside the page or is data in it."""
    page, seen = visited
    folder = page.parent.resolve().as_uri() + "/"
    assert len(seen["requests"]) >= 6
    outside = [url for url in seen["requests"] if not url.startswith((folder, "data:"))]
    assert outside == []


def test_single_page_needs_no_other_file(seen):
    """It lies alone in a folder: all pictures are drawn, the view of the delay shows a motion."""
    single = seen["single"]
    assert single["console"] == []
    assert single["first"] == seen["play"]["first"]
    assert [i["width"] for i in single["images"]] == [i["width"] for i in seen["images"]]
    outside = [url for url in single["requests"] if not url.startswith("data:")]
    assert [url.rpartition("/")[2] for url in outside] == ["any-name.html"]


def test_every_image_is_drawn_and_said_in_words(seen):
    assert len(seen["images"]) >= 2
    for image in seen["images"]:
        assert image["width"] > 0, image["src"]
        assert len(image["alt"]) > 20, image["src"]


def test_page_is_as_wide_as_the_window(seen):
    assert set(seen["too_wide"].values()) == {0}
    assert len(seen["too_wide"]) == 4


def test_page_is_accessible(seen):
    """By the rules of axe, contrast among them, in the light and in the dark."""
    assert seen["axe"] == []


def test_keyboard_skips_to_the_content(seen):
    first = seen["keyboard"]
    assert first["words"] == "Skip to the content"
    assert first["shown"]
    assert first["outline"] == "solid"
    assert first["leads_to"] == "content"


def test_claims_are_chosen_by_verdict_and_words(seen):
    """By keyboard; a button says that it is pressed, and the page how many claims it shows."""
    claims = seen["claims"]
    assert set(claims["verdicts"]) == set(VERDICTS)
    for met in claims["verdicts"].values():
        assert met["pressed"] == "true"
        assert met["shown"] == met["listed"]
        assert met["said"] == f"{met['listed']} of {claims['all']} are shown."
    assert 1 <= claims["searched"] < claims["all"]
    assert claims["said"] == f"{claims['searched']} of {claims['all']} are shown."
    # the search was for a claim, not for a question of ours
    assert claims["left"] == claims["searched"]


def test_link_to_a_claim_leads_there(seen):
    """Even if the claim is folded away or is not among the chosen ones."""
    assert seen["claims"]["linked"]
    assert seen["claims"]["cleared"]


def test_reader_moves_the_parameters(seen):
    """Each place has its class and its motion, by keyboard, map and button."""
    play = seen["play"]
    assert all(met["class"] and met["ticks"] for met in play.values())
    assert play["first"] == play["button"]
    places = [tuple(play[f"key {i}"]["values"]) for i in range(4)]
    assert len({epsilon for epsilon, _ in places}) == 4
    assert len({tau for _, tau in places}) == 1

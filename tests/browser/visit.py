"""Open the page in a headless Chromium and print, as JSON, what a reader would meet.

visit.py PAGE SINGLE    the page's index.html, and the page as one file
"""

import json
import sys
from pathlib import Path

from axe_core_python.selenium import Axe
from selenium.webdriver import Chrome, ChromeOptions, ChromeService, Keys
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

WIDTHS = [360, 800, 1400]
FACTS = """
return {
  images: [...document.images].map((i) => ({ src: i.src, alt: i.alt, width: i.naturalWidth })),
};
"""
DRAWN = "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done))"
"""Waits until what follows an event or the size of the window has been drawn."""


def browser() -> Chrome:
    """Debian's Chromium without a window, that keeps what it says and asks for."""
    options = ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return Chrome(options, ChromeService("/usr/bin/chromedriver"))


def emulate(chrome: Chrome, width: int, media: str = "") -> None:
    """A window of this width, or paper."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    chrome.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    chrome.execute_cdp_cmd("Emulation.setScrollbarsHidden", {"hidden": True})
    chrome.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media})
    chrome.execute_async_script(DRAWN)


def too_wide(chrome: Chrome) -> int:
    """Pixels by which the page is wider than the window."""
    return chrome.execute_script(
        "const page = document.documentElement; return page.scrollWidth - page.clientWidth"
    )


def violations(chrome: Chrome) -> list[str]:
    """What axe finds wrong, with one place of each."""
    found = Axe().run(chrome)["violations"]
    return [f"{one['id']}: {one['help']}: {one['nodes'][0]['html'][:200]}" for one in found]


def by_keyboard(chrome: Chrome) -> dict:
    """Where the first stop of the tabulator is, what is seen there, and where it leads."""
    ActionChains(chrome).send_keys(Keys.TAB).perform()
    link = chrome.switch_to.active_element
    met = {
        "words": link.text,
        "shown": link.is_displayed() and link.rect["x"] >= 0,
        "outline": link.value_of_css_property("outline-style"),
    }
    ActionChains(chrome).send_keys(Keys.ENTER).perform()
    return {**met, "leads_to": chrome.switch_to.active_element.get_attribute("id")}


def visit_play(chrome: Chrome) -> dict[str, dict]:
    """What is read and drawn at first, by keys along a slider, by the map and after a button."""
    view = chrome.find_element(By.ID, "play-view")
    seen = {"first": shown_motion(view)}
    Select(view.find_element(By.TAG_NAME, "select")).select_by_index(0)
    slider, other = (view.find_element(By.ID, f"play-{name}") for name in ("epsilon", "tau"))
    for one in (slider, other):
        one.send_keys(Keys.HOME)
    for i in range(4):
        seen[f"key {i}"] = shown_motion(view)
        slider.send_keys(Keys.ARROW_RIGHT)
    other.send_keys(Keys.END)
    seen["not computed"] = shown_motion(view)
    map_ = view.find_element(By.CSS_SELECTOR, ".play-map")
    # left of the middle, in the upper half
    ActionChains(chrome).move_to_element_with_offset(map_, -30, -30).click().perform()
    seen["touched"] = shown_motion(view)
    view.find_element(By.CSS_SELECTOR, ".play-scenes button").click()
    return {**seen, "button": shown_motion(view)}


def shown_motion(view) -> dict:
    """The class, the values of the sliders, and the words of the plot over time."""
    return {
        "class": view.find_element(By.CSS_SELECTOR, ".play-class").text,
        "values": [output.text for output in view.find_elements(By.TAG_NAME, "output")],
        "ticks": [tick.text for tick in view.find_elements(By.CSS_SELECTOR, ".play-time text")],
    }


def visit_claims(chrome: Chrome) -> dict:
    """What the filter shows for each verdict by keyboard and for words, and where a link leads."""
    shown = (
        "return [...document.querySelectorAll('.claim')].filter((c) => c.checkVisibility()).length"
    )
    status = chrome.find_element(By.CSS_SELECTOR, ".filter .read")
    met = {"all": len(chrome.find_elements(By.CSS_SELECTOR, ".claim")), "verdicts": {}}
    for button in chrome.find_elements(By.CSS_SELECTOR, ".filter button"):
        chrome.execute_script("arguments[0].focus()", button)
        ActionChains(chrome).send_keys(Keys.SPACE).perform()
        verdict = button.get_dom_attribute("data-verdict")
        met["verdicts"][verdict] = {
            "pressed": button.get_dom_attribute("aria-pressed"),
            "listed": len(
                chrome.find_elements(By.CSS_SELECTOR, f"[data-verdict='{verdict}'].claim")
            ),
            "shown": chrome.execute_script(shown),
            "said": status.text,
        }
        ActionChains(chrome).send_keys(Keys.SPACE).perform()
    search = chrome.find_element(By.CSS_SELECTOR, ".filter input")
    search.send_keys(chrome.find_element(By.CLASS_NAME, "claim").get_dom_attribute("id")[6:])
    met |= {"searched": chrome.execute_script(shown), "said": status.text}
    counts = chrome.find_elements(By.CSS_SELECTOR, ".filter button span")
    met["left"] = sum(int(count.text.split()[0]) for count in counts)
    place = chrome.find_elements(By.CSS_SELECTOR, ".appendix .claim")[-1].get_dom_attribute("id")
    chrome.execute_script("location.hash = arguments[0]", place)
    chrome.execute_async_script(DRAWN)
    met["linked"] = chrome.find_element(By.ID, place).is_displayed()
    met["cleared"] = search.get_property("value") == "" and status.text == ""
    return met


def network(chrome: Chrome) -> dict:
    events = [json.loads(entry["message"])["message"] for entry in chrome.get_log("performance")]
    asked = [e["params"] for e in events if e["method"] == "Network.requestWillBeSent"]
    failed = [e["params"] for e in events if e["method"] == "Network.loadingFailed"]
    return {
        "requests": [one["request"]["url"] for one in asked],
        "failed": [one["errorText"] for one in failed],
    }


def visit_single(chrome: Chrome, page: Path) -> dict:
    """Whether the page as one file draws its pictures and runs its scripts."""
    emulate(chrome, WIDTHS[-1])
    chrome.get(page.resolve().as_uri())
    first = shown_motion(chrome.find_element(By.ID, "play-view"))
    seen = {**chrome.execute_script(FACTS), "first": first, "console": chrome.get_log("browser")}
    return {**seen, **network(chrome)}


def visit(chrome: Chrome, page: Path) -> dict:
    """All that is looked at, in an order in which no look disturbs the next."""
    emulate(chrome, WIDTHS[-1])
    chrome.get(page.resolve().as_uri())
    seen = {**chrome.execute_script(FACTS), "too_wide": {}}
    seen |= {"keyboard": by_keyboard(chrome)}
    seen |= {"claims": visit_claims(chrome)}
    chrome.get(page.resolve().as_uri())
    for details in chrome.find_elements(By.CSS_SELECTOR, "details.appendix:not([open]) > summary"):
        details.click()
    seen |= {"play": visit_play(chrome)}
    for details in chrome.find_elements(By.CSS_SELECTOR, "details:not([open]) > summary"):
        chrome.execute_script("arguments[0].parentElement.open = true", details)
    for width in WIDTHS:
        emulate(chrome, width)
        seen["too_wide"][width] = too_wide(chrome)
    seen["axe"] = violations(chrome)
    dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
    chrome.execute_cdp_cmd("Emulation.setEmulatedMedia", dark)
    seen["axe"] += violations(chrome)
    emulate(chrome, 700, media="print")
    seen["too_wide"]["print"] = too_wide(chrome)
    messages = [entry["message"] for entry in chrome.get_log("browser")]
    return {**seen, "console": messages, **network(chrome)}


if __name__ == "__main__":
    window = browser()
    try:
        page, single = map(Path, sys.argv[1:])
        print(json.dumps({**visit(window, page), "single": visit_single(window, single)}))
    finally:
        window.quit()

"""A headless browser for the explorer's pages: a missing one is a failure where CI is set, and a skip elsewhere."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from problems.browsers import GRAPHICS, Tab

import mjcont as mc
from mjcont.explorer.page import write_page


def missing(what: str) -> None:
    if os.environ.get("CI"):
        pytest.fail(f"{what} is not there, and CI is set")
    pytest.skip(f"{what} is not there")


@pytest.fixture(scope="session")
def launched():
    """Return a function that starts a browser with some switches."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("playwright")
    program = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
    if program is None:
        missing("chromium")
    with sync_playwright() as playwright:
        started = []

        def launch(switches):
            started.append(playwright.chromium.launch(executable_path=program, args=list(switches)))
            return started[-1]

        yield launch
        for browser in started:
            browser.close()


@pytest.fixture(scope="session")
def chromium(launched):
    return launched(GRAPHICS)


@pytest.fixture
def opened(chromium):
    """Return a function that opens a file or an address in a tab of its own."""
    contexts = []

    def open_in(place, width=1440, height=900, dark=False, browser=chromium,
                drawn="[data-panel=diagram] .plot .line"):
        context = browser.new_context(viewport={"width": width, "height": height}, device_scale_factor=1,
                                      color_scheme="dark" if dark else "light", accept_downloads=True)
        contexts.append(context)
        tab = Tab(context.new_page())
        tab.page.on("console", lambda m: tab.console.append(f"{m.type}: {m.text}"))
        tab.page.on("pageerror", lambda error: tab.console.append(f"error: {error}"))
        tab.page.on("request", lambda r: tab.requests.append(r.url))
        tab.page.goto(place.as_uri() if isinstance(place, Path) else place)
        tab.page.wait_for_selector(drawn, state="attached")
        tab.page.wait_for_selector("[data-panel=mechanism][hidden], [data-drawn]", state="attached")
        tab.settle()
        return tab

    yield open_in
    for context in contexts:
        context.close()


@pytest.fixture(scope="session")
def results(overcentre_branch):
    """The overcentre's branch and what begins at its first fold, by name."""
    branch = overcentre_branch(k_j=1e3)
    fold = branch.point("LP1")
    return {
        "equilibria": branch,
        "locus": mc.continue_special(fold, "l_us", bounds=(0.4, 0.7)),
        "path": mc.load_path(branch, "F", [-50, 50, -50], landing="creep"),
        "history": mc.simulate(branch.model, {"F": 25.0}, duration=2, start=fold),
        "sensitivities": mc.sensitivities(fold),
    }


@pytest.fixture(scope="session")
def results_page(results, tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("pages") / "overcentre.html", results)

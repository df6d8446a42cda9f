#!/usr/bin/env python3
"""The pictures of the live view in docs/figures, taken anew: live_view_pictures.py [PROGRAM] [SECONDS of a render, default 20].
Needs Chromium and python3-websocket."""

import sys
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests" / "live_view"))
from chromium import Chromium  # noqa: E402
from viewed import Viewed  # noqa: E402

FIGURES = SOURCE / "docs" / "figures"
WINDOW, PHONE = (1000, 680), (390, 844)
PATIENCE = 300  # seconds
DRAWN = 1.5  # seconds in which the page has drawn what it was asked for


def take(browser, name):
    time.sleep(DRAWN)
    browser.screenshot(FIGURES / f"{name}.png")
    print(FIGURES / f"{name}.png")


def compare(view, browser):
    """A render with the split `none` beside the kept one, stopped by the page after the same time."""
    browser.run("document.getElementById('keep').click()")
    kept = view.state()["render"]
    browser.choose("quasiSpecular", "none")
    view.wait(lambda state: state["render"] > kept and state["phase"] == "stopped", PATIENCE)
    browser.choose("split", 50)
    browser.run("document.getElementById('keep').scrollIntoView()")
    take(browser, "live_view_comparison")


def main(program="build/release/quasilux", seconds="20"):
    with Viewed(Path(program).resolve(), SOURCE / "scenes" / "cornell_ggx.xml") as view, Chromium(*WINDOW) as browser:
        browser.resize(*WINDOW)
        browser.open(view.address)
        view.wait(lambda state: state["seconds"] >= float(seconds), PATIENCE)
        browser.choose("pixel-x", 112)
        browser.choose("pixel-y", 153)
        take(browser, "live_view")
        browser.choose("layer", "relative_error")
        take(browser, "live_view_error")
        browser.choose("layer", "image")
        browser.resize(*PHONE, mobile=True)
        take(browser, "live_view_phone")
        browser.resize(*WINDOW)
        compare(view, browser)


if __name__ == "__main__":
    main(*sys.argv[1:])

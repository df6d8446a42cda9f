#!/usr/bin/env python3
"""What an open page of the live view costs a render of 3840 x 2160, and how often its picture comes: view_cost.py [PROGRAM] [ROUNDS, default 4]
[PASSES of a round with the page, and as many without it, default 3]. Needs Chromium and python3-websocket.

Processor time of a pass with the page open is held against that without it, by turns in one render, first the one and then the other first, so that
other programs and the shrinking radii disturb both alike. A stretch in which the render estimates its error, every 100 s for two seconds, page or not, is
measured again. Processor time is of the program; the browser's own is printed separately."""

import os
import sys
import tempfile
import time
from pathlib import Path
from statistics import mean, stdev

SOURCE = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests" / "live_view"))
from chromium import Chromium  # noqa: E402
from viewed import Viewed  # noqa: E402

WIDTH, HEIGHT = 3840, 2160
FRAMES = "performance.getEntriesByType('resource').filter(e => /\\/frame\\?/.test(e.name) && e.responseStatus === 200).length"


def scene_in(folder):
    text = (SOURCE / "scenes" / "cornell_ggx.xml").read_text()
    for side, size in (("width", WIDTH), ("height", HEIGHT)):
        text = text.replace(f'name="{side}" value="$resolution"', f'name="{side}" value="{size}"')
    scene = Path(folder) / "large.xml"
    scene.write_text(text)
    return scene


def processor_seconds(process):
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def of_browser(browser):
    """The processes that it has started belong to its group."""
    total = 0
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if browser.folder.name.encode() in (entry / "cmdline").read_bytes() or int(entry.name) == browser.process.pid:
                total += processor_seconds(entry.name)
        except OSError:
            pass
    return total


def passes_of(view):
    return view.state()["passes"]


def wait_for_pass(view, passes):
    while passes_of(view) < passes:
        time.sleep(0.02)


def first_picture(view, browser):
    """Seconds from the end of the first pass to its picture in the page, and to the first picture of all."""
    browser.open(view.address)
    seen = {}
    while len(seen) < 3:
        now = time.monotonic()
        shown = browser.run("document.body.dataset.passes")
        if shown is not None:
            seen.setdefault("any picture", now)
        if passes_of(view) >= 1:
            seen.setdefault("pass", now)
        if shown and int(shown) >= 1:
            seen.setdefault("picture", now)
        time.sleep(0.01)
    return seen["picture"] - seen["pass"], seen["any picture"] - seen["pass"]


def stretch(view, browser, passes, is_open):
    while True:
        errors = view.state()["relativeError"]
        measured = any_stretch(view, browser, passes, is_open)
        if view.state()["relativeError"] == errors:
            return measured


def any_stretch(view, browser, passes, is_open):
    """Clock and processor seconds of a pass, pictures a second, and the browser's share of a core."""
    browser.open(view.address if is_open else "about:blank")
    browser.run("performance.setResourceTimingBufferSize(100000), 1")
    begin = passes_of(view) + 1
    wait_for_pass(view, begin)
    start, used, frames, browsing = time.monotonic(), processor_seconds(view.process.pid), browser.run(FRAMES), of_browser(browser)
    wait_for_pass(view, begin + passes)
    seconds = time.monotonic() - start
    return {"clock": seconds / passes, "processor": (processor_seconds(view.process.pid) - used) / passes,
            "pictures": (browser.run(FRAMES) - frames) / seconds, "browser": (of_browser(browser) - browsing) / seconds}


def main(program="build/release/quasilux", rounds="4", passes="3"):
    with tempfile.TemporaryDirectory() as folder, Viewed(Path(program).resolve(), scene_in(folder)) as view, Chromium(1280, 720) as browser:
        print("load", *os.getloadavg())
        picture, any_picture = first_picture(view, browser)
        print(f"first pass: its picture {picture:.2f} s after it, the first picture of all {any_picture:+.2f} s")
        ratios, shares = [], []
        for turn in range(int(rounds)):
            measured = {is_open: stretch(view, browser, int(passes), is_open) for is_open in ((False, True) if turn % 2 == 0 else (True, False))}
            without, with_page = measured[False], measured[True]
            ratios.append(with_page["processor"] / without["processor"])
            shares.append((with_page["processor"] - without["processor"]) / with_page["clock"])
            print("closed", *(f"{name} {value:.3f}" for name, value in without.items()), "| open",
                  *(f"{name} {value:.3f}" for name, value in with_page.items()), "| load", os.getloadavg()[0], flush=True)
        error = stdev(ratios) / len(ratios) ** 0.5
        print(f"processor time of a pass, open to closed: {mean(ratios):.4f} +- {error:.4f}; of a core beyond rendering: "
              f"{mean(shares):.3f} +- {stdev(shares) / len(shares) ** 0.5:.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""The pictures of docs/guide/office.md, made anew: office_pictures.py [PROGRAM] [SECONDS by night, default 30].
Prints what the report prints, by night and by day. Needs Chromium."""

import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
FIGURES = SOURCE / "docs" / "figures"
PAGE = (1060, 1480)  # pixels of the page that are shown


def take(page, picture):
    subprocess.run(
        ["chromium", "--headless", "--no-sandbox", "--hide-scrollbars", f"--window-size={PAGE[0]},{PAGE[1]}", f"--screenshot={picture}", page.as_uri()],
        check=True,
        stderr=subprocess.DEVNULL,
    )
    print(picture)


def main(program="build/release/quasilux", seconds="30"):
    by_day = str(2 * float(seconds))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene, time in (("office", seconds), ("office_day", by_day)):
            page = folder / f"{scene}.html"
            subprocess.run([program, "report", SOURCE / "scenes" / f"{scene}.xml", "-o", page, "--time", time], check=True)
        take(folder / "office.html", FIGURES / "office_report.png")
        image = folder / "office_day.exr"
        subprocess.run([program, "render", SOURCE / "scenes" / "office_day.xml", "-o", image, "--time", by_day, "--quiet"], check=True)
        subprocess.run([program, "falsecolour", image, "-o", FIGURES / "office_day.png", "--log", "--range", "20:2000"], check=True)
        print(FIGURES / "office_day.png")


if __name__ == "__main__":
    main(*sys.argv[1:])

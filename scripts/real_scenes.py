"""scenes/real/ by quasilux and by Mitsuba's `path`, in turns (scripts/equal_time.py). Called by scripts/real_scenes.sh. "Estimated": noise
as the render states it over noise as found, both root mean square. Draws images.

Other scenes are those of everyday_scenes.py, whose reference Mitsuba makes in four times the time: it lacks what `path` cannot find, such as
the sun in a mirror, and their bias and mean tell less.
"""
import argparse
import os
import pathlib
import sys

import matplotlib
import mitsuba

import everyday_scenes
from equal_time import Reference, add_variant, at_equal_time, reference_by_mitsuba
from figures import tone_map
from relmse import read_channels

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "real"
FIGURES = ROOT / "docs" / "figures"
OUT = ROOT / "out" / "real"
NAMES = ["room", "daylight", "sunlight", "building", "macro"]
BLOCK = 16
PER_ROW = 6


def read_reference(name):
    pixels, stderr = (read_channels(SCENES / f"{name}_{kind}.exr", ["R", "G", "B"]) for kind in ("reference", "reference_stderr"))
    return Reference(pixels, stderr, BLOCK)


def scene_and_reference(name, seconds):
    if name in NAMES:
        return SCENES / f"{name}.xml", read_reference(name)
    path = everyday_scenes.write(OUT / "scenes", name)
    return path, reference_by_mitsuba(path, 4 * seconds, BLOCK)


def times(ratio):
    return f"1/{1 / ratio:.1f}" if ratio < 1 else f"{ratio:.2g}"


def draw(rows, picture):
    """`rows`: lists of (title, image, exposure)."""
    columns = max(map(len, rows))
    figure, axes = plt.subplots(len(rows), columns, figsize=(3.2 * columns, 2.8 * len(rows)), squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
    for row, placed in zip(rows, axes):
        for (title, image, exposure), axis in zip(row, placed):
            axis.imshow(tone_map(image, exposure), interpolation="nearest")
            axis.set_title(title)
    figure.tight_layout()
    figure.savefig(FIGURES / picture, dpi=100)


def draw_both(images):
    """`images`: of (name, quasilux, Mitsuba); one above the other."""
    rows = [[(f"{image[0]}, {by}", image[column], 0.3 / image[1].mean()) for image in images]
            for column, by in ((1, "quasilux"), (2, "Mitsuba path"))]
    draw(rows, "real_scenes.png")


def draw_everyday(images):
    row = [(name, image, 0.3 / image.mean()) for name, image, *_ in images]
    draw([row[k:k + PER_ROW] for k in range(0, len(row), PER_ROW)], "everyday_scenes.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seconds", nargs="?", type=float, default=30, metavar="SECONDS")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    add_variant(parser)
    arguments = parser.parse_args()
    seconds, names = arguments.seconds, arguments.scenes or NAMES
    known = [*NAMES, *everyday_scenes.SCENES]
    if not set(names) <= set(known):
        sys.exit(f"real_scenes: unknown scene; known are {' '.join(known)}")
    mitsuba.set_variant(arguments.variant)
    print(f"{seconds:g} s each, two seeds, load {os.getloadavg()[0]:.1f}, Mitsuba {mitsuba.__version__}\n")
    print("| scene | quasilux: noise | bias | error | mean | estimated | Mitsuba `path` | error against it |\n|" + "---|" * 8)
    images = []
    for name in names:
        result = at_equal_time(*scene_and_reference(name, seconds), seconds, OUT)
        images.append((name, *result.images))
        row = f"| {name} | {result.noise:.1e} | {result.bias:.1e} | {result.noise + result.bias:.1e} | {100 * result.mean:+.2f} % |"
        print(f"{row} {result.estimated:.2f} | {result.peer:.1e} | {times(result.ratio)} |", flush=True)
    if seconds >= 5 and names == NAMES:
        draw_both(images)
    if seconds >= 5 and names == list(everyday_scenes.SCENES):
        draw_everyday(images)


if __name__ == "__main__":
    main()

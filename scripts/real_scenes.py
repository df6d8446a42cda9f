"""scenes/real/ by quasilux and by Mitsuba's `path`, in turns (scripts/equal_time.py). Called by scripts/real_scenes.sh. "Estimated": noise
as the render states it over noise as found, both root mean square. Draws images of both side by side.

Other scenes are those of everyday_scenes.py, whose reference Mitsuba makes in four times the time: it lacks what `path` cannot find, such as
the sun in a mirror, and their bias and mean tell less.
"""
import os
import pathlib
import sys

import matplotlib
import mitsuba

import everyday_scenes
from equal_time import Reference, at_equal_time, reference_by_mitsuba
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


def draw(images, picture):
    """`images`: of (name, quasilux, Mitsuba), PER_ROW side by side, one above the other."""
    columns, rows = min(PER_ROW, len(images)), 2 * -(-len(images) // PER_ROW)
    figure, axes = plt.subplots(rows, columns, figsize=(3.2 * columns, 2.6 * rows), squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
    for k, (name, *both) in enumerate(images):
        for row, (image, by) in enumerate(zip(both, ("quasilux", "Mitsuba path"))):
            axis = axes[2 * (k // PER_ROW) + row, k % PER_ROW]
            axis.imshow(tone_map(image, 0.3 / both[0].mean()), interpolation="nearest")
            axis.set_title(f"{name}, {by}")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30
    names = sys.argv[2:] or NAMES
    known = [*NAMES, *everyday_scenes.SCENES]
    if not set(names) <= set(known):
        sys.exit(f"real_scenes: unknown scene; known are {' '.join(known)}")
    mitsuba.set_variant("llvm_ad_rgb")
    print(f"{seconds:g} s each, two seeds, load {os.getloadavg()[0]:.1f}, Mitsuba {mitsuba.__version__}\n")
    print("| scene | quasilux: noise | bias | error | mean | estimated | Mitsuba `path` | error against it |\n|" + "---|" * 8)
    images = []
    for name in names:
        result = at_equal_time(*scene_and_reference(name, seconds), seconds, OUT)
        images.append((name, *result.images))
        row = f"| {name} | {result.noise:.1e} | {result.bias:.1e} | {result.noise + result.bias:.1e} | {100 * result.mean:+.2f} % |"
        print(f"{row} {result.estimated:.2f} | {result.peer:.1e} | {times(result.ratio)} |", flush=True)
    for all_names, picture in ((NAMES, "real_scenes.png"), (list(everyday_scenes.SCENES), "everyday_scenes.png")):
        if names == all_names and seconds >= 5:
            draw(images, FIGURES / picture)


if __name__ == "__main__":
    main()

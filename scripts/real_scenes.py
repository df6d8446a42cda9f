"""scenes/real/ by quasilux and by Mitsuba's `path`, in turns (scripts/equal_time.py). Called by scripts/real_scenes.sh. "Estimated": noise
as the render states it over noise as found, both root mean square. Draws images of both side by side.
"""
import os
import pathlib
import sys

import matplotlib
import mitsuba

from equal_time import Reference, at_equal_time
from figures import tone_map
from relmse import read_channels

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "real"
PICTURE = ROOT / "docs" / "figures" / "real_scenes.png"
OUT = ROOT / "out" / "real"
NAMES = ["room", "daylight", "sunlight", "building", "macro"]
BLOCK = 16


def read_reference(name):
    pixels, stderr = (read_channels(SCENES / f"{name}_{kind}.exr", ["R", "G", "B"]) for kind in ("reference", "reference_stderr"))
    return Reference(pixels, stderr, BLOCK)


def draw(images):
    """Rows: scenes, of (name, quasilux, Mitsuba)."""
    figure, axes = plt.subplots(2, len(images), figsize=(3.2 * len(images), 5.2), squeeze=False)
    for column, (name, *both) in enumerate(images):
        for axis, image in zip(axes[:, column], both):
            axis.imshow(tone_map(image, 0.3 / both[0].mean()), interpolation="nearest")
            axis.set_xticks([])
            axis.set_yticks([])
        axes[0, column].set_title(name)
    axes[0, 0].set_ylabel("quasilux")
    axes[1, 0].set_ylabel("Mitsuba path")
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=100)


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30
    names = sys.argv[2:] or NAMES
    mitsuba.set_variant("llvm_ad_rgb")
    print(f"{seconds:g} s each, two seeds, load {os.getloadavg()[0]:.1f}, Mitsuba {mitsuba.__version__}\n")
    print("| scene | quasilux: noise | bias | error | mean | estimated | Mitsuba `path` | error against it |\n|" + "---|" * 8)
    images = []
    for name in names:
        result = at_equal_time(SCENES / f"{name}.xml", read_reference(name), seconds, OUT)
        images.append((name, *result.images))
        row = f"| {name} | {result.noise:.1e} | {result.bias:.1e} | {result.noise + result.bias:.1e} | {100 * result.mean:+.2f} % |"
        print(f"{row} {result.estimated:.2f} | {result.peer:.1e} | 1/{1 / result.ratio:.1f} |", flush=True)
    if names == NAMES and seconds >= 5:
        draw(images)


if __name__ == "__main__":
    main()

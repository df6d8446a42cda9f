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
PICTURE = ROOT / "docs" / "figures" / "real_scenes.png"
OUT = ROOT / "out" / "real"
NAMES = ["room", "daylight", "sunlight", "building", "macro"]
BLOCK = 16


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
    if names == NAMES and seconds >= 5:
        draw(images)


if __name__ == "__main__":
    main()

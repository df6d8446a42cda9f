"""scenes/real/ by quasilux and by Mitsuba's `path`, in turns. Called by scripts/real_scenes.sh.

Error = noise + bias. Noise: half the mean squared difference of two seeds. Bias: squared differences of the mean image from the
reference over blocks of 16 x 16 pixels, net of the noise of both. Both with the weights of relMSE, R being the mean of a pixel's
neighbours in the reference, which is free of its own noise. "Estimated": noise as the render states it over noise as found, both root
mean square. Kernels of both renderers are compiled before the clock starts. Draws images of both side by side.
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import time

import matplotlib
import mitsuba
import numpy as np

from figures import tone_map
from relmse import by_block, mean_about, read_channels, relmse_weight

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "real"
PROGRAM = ROOT / "build" / "release" / "quasilux"
PICTURE = ROOT / "docs" / "figures" / "real_scenes.png"
OUT = ROOT / "out" / "real"
NAMES = ["room", "daylight", "sunlight", "building", "macro"]
BLOCK = 16
SAMPLES = 32  # per pixel in one call of Mitsuba


class Reference:
    def __init__(self, name):
        self.pixels = read_channels(SCENES / f"{name}_reference.exr", ["R", "G", "B"])
        self.stderr = read_channels(SCENES / f"{name}_reference_stderr.exr", ["R", "G", "B"])
        self.weight = relmse_weight(self.pixels, mean_about(self.pixels, with_centre=False))

    def errors(self, a, b):
        """Noise of one image and bias, as shares of relMSE; the relative difference of the mean."""
        noise = ((a - b) ** 2 / 2 * self.weight).mean()
        difference = by_block((a + b) / 2, BLOCK) - by_block(self.pixels, BLOCK)
        known = (by_block(self.stderr**2, BLOCK) + by_block((a - b) ** 2 / 4, BLOCK)) / BLOCK**2
        bias = ((difference**2 - known) * by_block(self.weight, BLOCK)).mean()
        return noise, max(bias, 0), ((a + b) / 2).mean() / self.pixels.mean() - 1


def render_quasilux(name, seconds, seed):
    """The image, and the square of its estimated noise, relative to its brightness."""
    OUT.mkdir(parents=True, exist_ok=True)
    image, statistics = OUT / f"{name}_{seed}.exr", OUT / f"{name}_{seed}.json"
    command = [PROGRAM, "render", SCENES / f"{name}.xml", "--time", seconds, "--seed", seed, "--output", image, "--stats", statistics]
    subprocess.run([str(part) for part in command] + ["--quiet"], check=True)
    noise = json.loads(statistics.read_text())["error"]["total"]["noiseRms"]
    return read_channels(image, ["R", "G", "B"]), noise**2


def render_mitsuba(scene, seconds, seed):
    start, total, calls = time.monotonic(), 0.0, 0
    while time.monotonic() - start < seconds:
        calls += 1
        total = total + np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=1000 * seed + calls), np.float64)[..., :3]
    return total / calls


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
        reference = Reference(name)
        scene = mitsuba.load_file(str(SCENES / f"{name}.xml"))
        np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=0))  # compiles
        render_quasilux(name, 1, 9)
        ours, theirs, estimates = [], [], []
        for seed in (1, 2):
            image, estimate = render_quasilux(name, seconds, seed)
            ours.append(image)
            estimates.append(estimate)
            theirs.append(render_mitsuba(scene, seconds, seed))
        images.append((name, ours[0], theirs[0]))
        noise, bias, mean = reference.errors(*ours)
        peer = reference.errors(*theirs)[0]
        row = f"| {name} | {noise:.1e} | {bias:.1e} | {noise + bias:.1e} | {100 * mean:+.2f} % | {math.sqrt(np.mean(estimates) / noise):.2f} |"
        print(f"{row} {peer:.1e} | 1/{peer / (noise + bias):.1f} |", flush=True)
    if names == NAMES and seconds >= 5:
        draw(images)


if __name__ == "__main__":
    main()

"""Error of a scene by quasilux and by Mitsuba after the same time, rendered in turns with two seeds each.

Error = noise + bias. Noise: half the mean squared difference of two seeds. Bias: squared differences of the mean image from the
reference over blocks, net of the noise of both. Both with the weights of relMSE, R being the mean of the 3 x 3 pixels about one in the
reference, as the program weighs its estimates (docs/method/accuracy.md). Kernels of both renderers are compiled before the clock starts.
"""
import json
import math
import pathlib
import subprocess
import time
from dataclasses import dataclass

import mitsuba
import numpy as np

from relmse import by_block, mean_about, read_channels, relmse_weight

PROGRAM = pathlib.Path(__file__).resolve().parent.parent / "build" / "release" / "quasilux"
SAMPLES = {"llvm_ad_rgb": 32, "cuda_ad_rgb": 512}  # per pixel in one call of Mitsuba, by variant
REFERENCE_SEED = 10**6


def add_variant(parser):
    parser.add_argument("--variant", choices=SAMPLES, default="llvm_ad_rgb",
                        help="of Mitsuba, for the kind of device that quasilux runs on (default: %(default)s)")


def samples():
    return SAMPLES[mitsuba.variant()]


class Reference:
    """A converged image and its standard errors; bias is judged by blocks of `block` x `block` pixels."""

    def __init__(self, pixels, stderr, block):
        self.pixels, self.stderr, self.block = pixels, stderr, block
        self.weight = relmse_weight(self.pixels, mean_about(self.pixels))

    def errors(self, a, b):
        """Noise of one image and bias, as shares of relMSE; the relative difference of the mean."""
        noise = ((a - b) ** 2 / 2 * self.weight).mean()
        difference = by_block((a + b) / 2, self.block) - by_block(self.pixels, self.block)
        known = (by_block(self.stderr**2, self.block) + by_block((a - b) ** 2 / 4, self.block)) / self.block**2
        bias = ((difference**2 - known) * by_block(self.weight, self.block)).mean()
        return noise, max(bias, 0), ((a + b) / 2).mean() / self.pixels.mean() - 1


@dataclass
class EqualTime:
    """`estimated`: noise as the render states it over noise as found, root mean square. `peer`: Mitsuba's noise. `images`: one of each."""

    noise: float
    bias: float
    mean: float
    estimated: float
    peer: float
    images: tuple

    @property
    def ratio(self):
        """Error over Mitsuba's."""
        return (self.noise + self.bias) / self.peer


def render_quasilux(scene, seconds, seed, folder):
    """The image, and the square of its estimated noise, relative to its brightness."""
    folder.mkdir(parents=True, exist_ok=True)
    image, statistics = folder / f"{scene.stem}_{seed}.exr", folder / f"{scene.stem}_{seed}.json"
    command = [PROGRAM, "render", scene, "--time", seconds, "--seed", seed, "--output", image, "--stats", statistics]
    subprocess.run([str(part) for part in command] + ["--quiet"], check=True)
    noise = json.loads(statistics.read_text())["error"]["total"]["noiseRms"]
    return read_channels(image, ["R", "G", "B"]), math.inf if noise is None else noise**2  # of a single pass it is not known


def render_mitsuba(scene, seconds, seed):
    start, total, calls = time.monotonic(), 0.0, 0
    while time.monotonic() - start < seconds:
        calls += 1
        total = total + np.asarray(mitsuba.render(scene, spp=samples(), seed=1000 * seed + calls), np.float64)[..., :3]
    return total / calls


def reference_by_mitsuba(path, seconds, block):
    """The mean of calls with seeds of their own, as many as fit into the time, at least eight."""
    scene = mitsuba.load_file(str(path))
    start, total, squares, calls = time.monotonic(), 0.0, 0.0, 0
    while calls < 8 or time.monotonic() - start < seconds:
        image = np.asarray(mitsuba.render(scene, spp=samples(), seed=REFERENCE_SEED + calls), np.float64)[..., :3]
        total, squares, calls = total + image, squares + image**2, calls + 1
    mean = total / calls
    return Reference(mean, np.sqrt(np.maximum(squares / calls - mean**2, 0) / (calls - 1)), block)


def at_equal_time(path, reference, seconds, folder):
    """The scene file `path` by both."""
    scene = mitsuba.load_file(str(path))
    np.asarray(mitsuba.render(scene, spp=samples(), seed=0))  # compiles
    render_quasilux(path, 1, 9, folder)
    ours, theirs, estimates = [], [], []
    for seed in (1, 2):
        image, estimate = render_quasilux(path, seconds, seed, folder)
        ours.append(image)
        estimates.append(estimate)
        theirs.append(render_mitsuba(scene, seconds, seed))
    noise, bias, mean = reference.errors(*ours)
    peer = reference.errors(*theirs)[0]
    return EqualTime(noise, bias, mean, math.sqrt(np.mean(estimates) / noise), peer, (ours[0], theirs[0]))

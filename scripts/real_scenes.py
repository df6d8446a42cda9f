"""scenes/real/ by quasilux and by Mitsuba's `path`, in turns. Called by scripts/real_scenes.sh.

Error = noise + bias. Noise: half the mean squared difference of two seeds. Bias: squared differences of the mean image from the
reference over blocks of 16 x 16 pixels, net of the noise of both. Both with the weights of relMSE, R being the mean of a pixel's
neighbours in the reference, which is free of its own noise. Kernels of both renderers are compiled before the clock starts.
"""
import os
import pathlib
import subprocess
import sys
import time

import mitsuba
import numpy as np

from relmse import mean_about, read_channels, relmse_weight

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "real"
PROGRAM = ROOT / "build" / "release" / "quasilux"
PICTURES = ROOT / "docs" / "figures" / "real"
OUT = ROOT / "out" / "real"
NAMES = ["room", "daylight", "sunlight", "building", "macro"]
BLOCK = 16
SAMPLES = 32  # per pixel in one call of Mitsuba


def by_block(pixels):
    height, width = (size - size % BLOCK for size in pixels.shape[:2])
    return pixels[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK, -1).mean(axis=(1, 3))


class Reference:
    def __init__(self, name):
        self.pixels = read_channels(SCENES / f"{name}_reference.exr", ["R", "G", "B"])
        self.stderr = read_channels(SCENES / f"{name}_reference_stderr.exr", ["R", "G", "B"])
        self.weight = relmse_weight(self.pixels, mean_about(self.pixels, with_centre=False))

    def errors(self, a, b):
        """Noise of one image and bias, as shares of relMSE; the relative difference of the mean."""
        noise = ((a - b) ** 2 / 2 * self.weight).mean()
        difference = by_block((a + b) / 2) - by_block(self.pixels)
        known = (by_block(self.stderr**2) + by_block((a - b) ** 2 / 4)) / BLOCK**2
        bias = ((difference**2 - known) * by_block(self.weight)).mean()
        return noise, max(bias, 0), ((a + b) / 2).mean() / self.pixels.mean() - 1


def render_quasilux(name, seconds, seed):
    OUT.mkdir(parents=True, exist_ok=True)
    image = OUT / f"{name}_{seed}.exr"
    command = [PROGRAM, "render", SCENES / f"{name}.xml", "--time", str(seconds), "--seed", str(seed), "--output", image, "--quiet"]
    if seed == 1 and seconds >= 5:
        PICTURES.mkdir(parents=True, exist_ok=True)
        command += ["--png", PICTURES / f"{name}.png"]
    subprocess.run([str(part) for part in command], check=True)
    return read_channels(image, ["R", "G", "B"])


def render_mitsuba(scene, seconds, seed):
    start, total, calls = time.monotonic(), 0.0, 0
    while time.monotonic() - start < seconds:
        calls += 1
        total = total + np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=1000 * seed + calls), np.float64)[..., :3]
    return total / calls


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30
    names = sys.argv[2:] or NAMES
    mitsuba.set_variant("llvm_ad_rgb")
    print(f"{seconds:g} s each, two seeds, load {os.getloadavg()[0]:.1f}, Mitsuba {mitsuba.__version__}\n")
    print("| scene | quasilux: noise | bias | error | mean | Mitsuba `path` | error against it |\n|---|---|---|---|---|---|---|")
    for name in names:
        reference = Reference(name)
        scene = mitsuba.load_file(str(SCENES / f"{name}.xml"))
        np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=0))  # compiles
        render_quasilux(name, 1, 9)
        ours, theirs = [], []
        for seed in (1, 2):
            ours.append(render_quasilux(name, seconds, seed))
            theirs.append(render_mitsuba(scene, seconds, seed))
        noise, bias, mean = reference.errors(*ours)
        peer = reference.errors(*theirs)[0]
        ratio = peer / (noise + bias)
        print(f"| {name} | {noise:.1e} | {bias:.1e} | {noise + bias:.1e} | {100 * mean:+.2f} % | {peer:.1e} | 1/{ratio:.1f} |", flush=True)


if __name__ == "__main__":
    main()

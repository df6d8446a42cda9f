#!/usr/bin/python3
"""Is the error that renders estimate right? Draws docs/figures/calibration.png and prints the table of docs/notes/calibration.md.

    scripts/calibration.py [--scenes box plate] [--program PROGRAM]

Each scene is rendered from several seeds for each number of passes. Predicted: the figures that each render writes into
its statistics, averaged over the seeds as root mean squares. True: noise from the scatter between the seeds; bias from
the difference between their mean and the reference, net of the noise of both. All relative, with the program's weights (docs/method/accuracy.md).
The box is rendered at 64 x 64 pixels, the plate, whose reference is too noisy to resolve its bias in single pixels, at
160 x 120. What is in out/calibration already is not rendered again. Needs Debian's python3-numpy, python3-openimageio and
python3-matplotlib.
"""
import argparse
import json
import pathlib
import subprocess
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from figures import FIGURES, ROOT
from relmse import box_reference, mean_about, plate_reference, read_channels, relmse_weight

BOX_PIXELS = 64


@dataclass
class Scene:
    """What to render and the truth: `reference` (height, width, 3) with own relMSE `noise`."""

    title: str
    options: list
    reference: np.ndarray
    noise: float
    passes: list
    seeds: int


@dataclass
class Calibration:
    """Root mean squares over pixels, relative: true ones of noise and bias, and those that renders estimated."""

    noise: float
    estimated_noise: float
    bias: float
    estimated_bias: float
    slope: float  # of the true bias on the estimated one, over pixels


def box():
    """The modified Cornell box, its reference averaged over blocks of 4 x 4 pixels."""
    reference = box_reference()
    blocks = reference.pixels.reshape(BOX_PIXELS, 4, BOX_PIXELS, 4, 3).mean(axis=(1, 3))
    options = [ROOT / "scenes" / "cornell_phong.xml", "-D", f"resolution={BOX_PIXELS}"]
    return Scene("modified Cornell box, 64 x 64", options, blocks, reference.noise.mean() / 16, [4, 16, 64, 256], 8)


def plate():
    """The turbid plate on checkered paper, its phase function split by a level."""
    reference = plate_reference()
    options = [ROOT / "scenes" / "plate_checker.xml", "--quasi-specular", "level:0.1"]
    return Scene("turbid plate, 160 x 120", options, reference.pixels, reference.noise.mean(), [4, 16, 64, 256], 4)


SCENES = {"box": box, "plate": plate}


def render(program, scene, passes, seed, stem):
    """The image, its layer of bias and its statistics; what was rendered before is read again."""
    image, statistics = stem.with_suffix(".exr"), stem.with_suffix(".json")
    if not statistics.exists():
        command = [program, "render", *scene.options, "--passes", str(passes), "--seed", str(seed), "--quiet"]
        subprocess.run([*command, "--output", image, "--stats", statistics], check=True)
    return read_channels(image, ["R", "G", "B"]), read_channels(image, ["bias.R", "bias.G", "bias.B"]), json.loads(statistics.read_text())


def unbiased_square(samples, weight, offset):
    """Mean over pixels of the squared difference between the expectation of `samples` and `offset`."""
    mean, n = samples.mean(axis=0), len(samples)
    return ((mean - offset) ** 2 * weight).mean() - (samples.var(axis=0, ddof=1) / n * weight).mean()


def calibrate(program, name, scene, passes, folder):
    seeds = scene.seeds
    renders = [render(program, scene, passes, seed, folder / f"{name}_{passes}_{seed}") for seed in range(1, seeds + 1)]
    images, biases = (np.array([r[k] for r in renders]) for k in (0, 1))
    estimated = [r[2]["error"]["total"] for r in renders]
    weight = relmse_weight(scene.reference, mean_about(scene.reference))  # as the program weighs squared errors
    true_bias = unbiased_square(images, weight, scene.reference) - scene.noise
    estimated_bias = unbiased_square(biases, weight, 0)
    difference = images.mean(axis=0) - scene.reference
    # Image and bias of one seed share their noise: take its covariance out.
    covariance = ((images - images.mean(axis=0)) * (biases - biases.mean(axis=0))).sum(axis=0) / (seeds - 1) / seeds
    both = ((difference * biases.mean(axis=0) - covariance) * weight).mean()
    root = lambda square: float(np.sqrt(max(0.0, square)))
    return Calibration(
        root((images.var(axis=0, ddof=1) * weight).mean()),
        root(np.mean([t["noiseRms"] ** 2 for t in estimated])),
        root(true_bias),
        root(np.mean([t["biasRms"] ** 2 for t in estimated])),
        both / estimated_bias if estimated_bias > 0 else float("nan"),
    )


def draw(results):
    results = {title: rows for title, rows in results.items() if len(rows) > 1}
    figure, axes = plt.subplots(1, len(results), figsize=(5.2 * len(results), 4), squeeze=False)
    for axis, (title, rows) in zip(axes[0], results.items()):
        passes = sorted(rows)
        percent = lambda member: [100 * getattr(rows[n], member) for n in passes]
        axis.loglog(passes, percent("noise"), "C0o-", label="noise, true")
        axis.loglog(passes, percent("estimated_noise"), "C0x--", label="noise, estimated", markersize=9)
        axis.loglog(passes, percent("bias"), "C3o-", label="bias, true")
        axis.loglog(passes, percent("estimated_bias"), "C3x--", label="bias, estimated", markersize=9)
        axis.set_xticks(passes, [str(n) for n in passes])
        axis.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
        axis.set_ylim(1, 20)
        axis.minorticks_off()
        axis.set_xlabel("passes")
        axis.set_ylabel("relative error, rms over pixels, %")
        axis.set_title(title, fontsize=10)
        axis.grid(alpha=0.3, which="both")
        axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(FIGURES / "calibration.png", dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "quasilux"))
    options = parser.parse_args()
    folder = pathlib.Path(ROOT / "out" / "calibration")
    folder.mkdir(parents=True, exist_ok=True)
    FIGURES.mkdir(parents=True, exist_ok=True)
    results = {}
    print("| scene | passes | noise, true | estimated | estimated / true | bias, true | estimated | estimated / true | true on estimated, by pixel |")
    print("|---" * 9 + "|")
    for name in options.scenes:
        scene = SCENES[name]()
        rows = results.setdefault(scene.title, {})
        for passes in scene.passes:
            c = rows[passes] = calibrate(options.program, name, scene, passes, folder)
            cells = [f"{100 * c.noise:.2f} %", f"{100 * c.estimated_noise:.2f} %", f"{c.estimated_noise / c.noise:.2f}"]
            ratio = f"{c.estimated_bias / c.bias:.2f}" if c.bias > 0 else "-"
            cells += [f"{100 * c.bias:.2f} %", f"{100 * c.estimated_bias:.2f} %", ratio, f"{c.slope:.2f}"]
            print(f"| {scene.title} | {passes} | " + " | ".join(cells) + " |", flush=True)
    draw(results)


if __name__ == "__main__":
    main()

"""tests/scenes/compare/ by quasilux and by Mitsuba 3's `path` (or `ptracer`): do the numbers agree? Called by scripts/compare_mitsuba.sh.

For each scene: difference of the mean, and the worst of the blocks of 10 x 10 pixels, in per cent and in standard errors of the
difference. They agree where the mean is within 0.5 % or three standard errors, and each block within 2 % or four. Exit code 1 where one does not.
With --equal-time SECONDS also the error of both after that time, by the same reference (scripts/equal_time.py).
"""
import argparse
import pathlib
import sys

import mitsuba
import numpy as np

from equal_time import Reference, add_variant, at_equal_time, render_quasilux
from relmse import by_block

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "tests" / "scenes" / "compare"
OUT = ROOT / "out" / "compare"
BLOCK, SAMPLES, SEEDS, SECONDS = 10, 512, 8, 3
# Scenes with light that of Mitsuba's integrators only this one finds, and its samples of a pixel.
PARTICLES, PARTICLE_SAMPLES = {"directionalarea"}, 4096


def mean_and_error(values):
    """Over seeds, the first axis."""
    return np.mean(values, axis=0), np.std(values, axis=0, ddof=1) / np.sqrt(len(values))


def compare(path, seconds):
    """Prints a row; 1 where the numbers agree. `seconds`: for errors at equal time, or None."""
    scene = mitsuba.load_file(str(path))
    particles = path.stem in PARTICLES
    integrator = mitsuba.load_dict({"type": "ptracer"}) if particles else scene.integrator()
    samples = PARTICLE_SAMPLES if particles else SAMPLES
    theirs = [np.asarray(mitsuba.render(scene, integrator=integrator, spp=samples, seed=seed), np.float64)[..., :3]
              for seed in range(SEEDS)]
    ours = [render_quasilux(path, SECONDS, seed, OUT)[0] for seed in range(1, SEEDS // 2 + 1)]
    rows = []
    for measure in (np.mean, lambda image: by_block(image, BLOCK).mean(axis=2)):
        (a, error_a), (b, error_b) = (mean_and_error([measure(image) for image in images]) for images in (ours, theirs))
        rows.append((np.atleast_1d(a / b - 1).ravel(), np.atleast_1d(np.hypot(error_a, error_b) / b).ravel()))
    (mean,), (mean_error,) = rows[0]
    blocks, block_errors = rows[1]
    worst = np.argmax(np.abs(blocks) - 4 * block_errors)
    agree = abs(mean) <= max(0.005, 3 * mean_error) and np.all(np.abs(blocks) <= np.maximum(0.02, 4 * block_errors))
    cells = [path.stem, f"{100 * mean:+.2f} ± {100 * mean_error:.2f} %", f"{100 * blocks[worst]:+.2f} ± {100 * block_errors[worst]:.2f} %",
             "agree" if agree else "DIFFER"]
    if seconds:
        result = at_equal_time(path, Reference(*mean_and_error(theirs), BLOCK), seconds, OUT)
        cells += [f"{result.noise:.1e}", f"{result.bias:.1e}", f"{result.estimated:.2f}", f"{result.peer:.1e}", f"{result.ratio:.2g}"]
    print("| " + " | ".join(cells) + " |", flush=True)
    return agree


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--equal-time", type=float, metavar="SECONDS")
    add_variant(parser)
    arguments = parser.parse_args()
    mitsuba.set_variant(arguments.variant)
    names = arguments.scenes or sorted(path.stem for path in SCENES.glob("*.xml"))
    heads = ["scene", "mean", "worst block", ""]
    if arguments.equal_time:
        heads += ["noise", "bias", "estimated / found noise", "Mitsuba's error", "error over Mitsuba's"]
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
    results = [compare(SCENES / f"{name}.xml", arguments.equal_time) for name in names]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()

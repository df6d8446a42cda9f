"""tests/scenes/compare/ by quasilux and by Mitsuba 3's `path`: do the numbers agree? Called by scripts/compare_mitsuba.sh.

For each scene: difference of the mean, and the worst of the blocks of 10 x 10 pixels, in per cent and in standard errors of the
difference. They agree where the mean is within 0.5 % or three standard errors, and each block within 2 % or four. Exit code 1 where one does not.
"""
import pathlib
import subprocess
import sys

import mitsuba
import numpy as np

from relmse import by_block, read_channels

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "tests" / "scenes" / "compare"
PROGRAM = ROOT / "build" / "release" / "quasilux"
OUT = ROOT / "out" / "compare"
BLOCK, SAMPLES, SEEDS, SECONDS = 10, 512, 8, 3


def render_quasilux(scene, seed):
    OUT.mkdir(parents=True, exist_ok=True)
    image = OUT / f"{scene.stem}_{seed}.exr"
    command = [PROGRAM, "render", scene, "--time", SECONDS, "--seed", seed, "--output", image, "--quiet"]
    subprocess.run([str(part) for part in command], check=True)
    return read_channels(image, ["R", "G", "B"])


def mean_and_error(values):
    """Over seeds, the first axis."""
    return np.mean(values, axis=0), np.std(values, axis=0, ddof=1) / np.sqrt(len(values))


def compare(path):
    scene = mitsuba.load_file(str(path))
    theirs = [np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=seed), np.float64)[..., :3] for seed in range(SEEDS)]
    ours = [render_quasilux(path, seed) for seed in range(1, SEEDS // 2 + 1)]
    rows = []
    for measure in (np.mean, lambda image: by_block(image, BLOCK).mean(axis=2)):
        (a, error_a), (b, error_b) = (mean_and_error([measure(image) for image in images]) for images in (ours, theirs))
        rows.append((np.atleast_1d(a / b - 1).ravel(), np.atleast_1d(np.hypot(error_a, error_b) / b).ravel()))
    (mean,), (mean_error,) = rows[0]
    blocks, block_errors = rows[1]
    worst = np.argmax(np.abs(blocks) - 4 * block_errors)
    agree = abs(mean) <= max(0.005, 3 * mean_error) and np.all(np.abs(blocks) <= np.maximum(0.02, 4 * block_errors))
    print(f"| {path.stem} | {100 * mean:+.2f} ± {100 * mean_error:.2f} % | {100 * blocks[worst]:+.2f} ± {100 * block_errors[worst]:.2f} % | "
          f"{'agree' if agree else 'DIFFER'} |", flush=True)
    return agree


def main():
    mitsuba.set_variant("llvm_ad_rgb")
    names = sys.argv[1:] or sorted(path.stem for path in SCENES.glob("*.xml"))
    print("| scene | mean | worst block | |\n|---|---|---|---|")
    results = [compare(SCENES / f"{name}.xml") for name in names]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()

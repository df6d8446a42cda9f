"""Scenes made up at random by quasilux and by Mitsuba 3: do they agree? By the Python that scripts/mitsuba.sh makes:

    build/mitsuba/bin/python3 scripts/random_scenes.py --seed 1 --scenes 0:100

Scene k of a seed is always the same: a few shapes in cells of their own under transforms with mirrors and shears, with nested bsdfs, textures,
lights, media and a sensor by the tables below. Means of the image and of blocks of 8 x 8 pixels are compared; what differs by more than 1 % and
4.5 standard errors of the difference is rendered again for longer, and reported if it still differs. Left out is what Mitsuba's path tracers do
not find, or is known to differ (docs/notes/validation.md): light of points by smooth mirrors and glass, blends of glass, normal maps that let
light through. Scenes and images are kept in out/random_scenes/. Exit code 1 where something differs, fails or is refused.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import time

import mitsuba
import numpy as np

from random_scene import Maker, write_files
from relmse import by_block, read_channels

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "out" / "random_scenes"
WIDTH, HEIGHT, BLOCK, SEEDS, PEER_SEEDS = 32, 24, 8, 3, 16
SIGMAS, SHARE, LONGER, NOISE_FACTOR, FEWEST_PASSES = 4.5, 0.01, 3, 2, 8


def measures(image):
    """Means of the image and of its blocks, by channel."""
    return np.concatenate([image.mean(axis=(0, 1)), by_block(image, BLOCK).ravel()])


class Failure(Exception):
    pass


def ours(program, path, seconds, more):
    """Measures and their standard errors; the found variance of a pixel over the stated one, 0 where passes are too few to state it."""
    images, stated, passes = [], [], []
    for seed in range(1, SEEDS + 1):
        image = path.with_suffix(f".{seed}.exr")
        statistics = path.with_suffix(".json")
        command = [program, "render", path.name, "--seed", str(seed), "-o", image.name, "--stats", statistics.name, "--quiet", *more]
        for stop in (["--passes", "1"], ["--time", str(seconds)])[seed > 1:]:  # the first one compiles
            done = subprocess.run([*command, *stop], cwd=OUT, capture_output=True, text=True)
            if done.returncode:
                raise Failure(f"quasilux ends with {done.returncode}: {done.stderr.strip()}")
        passes.append(json.loads(statistics.read_text())["counters"]["passes"])
        images.append(read_channels(image, ["R", "G", "B"]))
        stated.append(read_channels(image, ["stderr.R", "stderr.G", "stderr.B"]) ** 2)
    if not np.all(np.isfinite(images)) or not np.all(np.isfinite(stated)):
        raise Failure("quasilux: not finite")
    found = np.var(images, axis=0, ddof=1)
    values = [measures(image) for image in images]
    variance = np.mean([np.concatenate([s.mean(axis=(0, 1)) / (WIDTH * HEIGHT), by_block(s, BLOCK).ravel() / BLOCK**2]) for s in stated], axis=0)
    # Photons are shared by neighbours: blocks scatter by more than their pixels' noise says.
    scatter = np.var(values, axis=0, ddof=1)
    if np.any(variance):
        scatter = variance * max(1, np.mean(scatter[3:]) / np.mean(variance[3:]))
    noise = found.mean() / np.mean(stated) if min(passes) >= FEWEST_PASSES else 0
    return np.mean(values, axis=0), np.sqrt(scatter / SEEDS), noise


def theirs(scene, samples):
    values = [measures(np.asarray(mitsuba.render(scene, spp=samples, seed=seed), np.float64)[..., :3]) for seed in range(PEER_SEEDS)]
    return np.mean(values, axis=0), np.std(values, axis=0, ddof=1) / math.sqrt(PEER_SEEDS)


def samples_in(scene, seconds):
    """Of a pixel, for each of the seeds."""
    np.asarray(mitsuba.render(scene, spp=16, seed=99))  # compiles
    start = time.monotonic()
    np.asarray(mitsuba.render(scene, spp=64, seed=98))
    return max(16, int(64 * seconds / PEER_SEEDS / (time.monotonic() - start)))


def difference(options, path, scene, longer):
    """A line on what differs most, the shares by which it differs and whether that is too much."""
    a, error_a, noise = ours(options.program, path, options.seconds * longer, options.more)
    b, error_b = theirs(scene, samples_in(scene, options.seconds * longer))
    if not np.all(np.isfinite(b)):
        return "Mitsuba's is not finite", False
    size = np.maximum(np.abs(b), 0.05 * np.mean(b[:3]) + 1e-9)  # dark blocks are held to 1 % of 5 % of the mean
    share, error = (a - b) / size, np.hypot(error_a, error_b) / size
    worst = np.argmax(np.abs(share) - SIGMAS * error)
    differs = abs(share[worst]) > max(SHARE, SIGMAS * error[worst])
    place = "mean" if worst < 3 else "block {}, {}".format(*divmod((worst - 3) // 3, WIDTH // BLOCK))
    line = (f"mean {100 * share[:3].mean():+.2f} ± {100 * error[:3].max():.2f} %, worst ({place}, {'RGB'[worst % 3]}) "
            f"{100 * share[worst]:+.2f} ± {100 * error[worst]:.2f} %, noise {math.sqrt(noise):.2f} of stated")
    return line, differs or noise > NOISE_FACTOR**2


def examine(options, k):
    """Prints a line; whether all is well."""
    path = OUT / f"{options.seed}_{k}.xml"
    path.write_text(Maker(f"{options.seed}/{k}", WIDTH, HEIGHT).scene())
    try:
        scene = mitsuba.load_file(str(path))
    except Exception as error:  # noqa: BLE001 (Mitsuba raises all kinds)
        print(f"{path.name}: Mitsuba refuses: {str(error).strip().splitlines()[-1][:200]}", flush=True)
        return True
    try:
        line, differs = difference(options, path, scene, 1)
        if differs:
            print(f"{path.name}: again: {line}", flush=True)
            line, differs = difference(options, path, scene, LONGER)
    except Failure as failure:
        line, differs = str(failure), True
    print(f"{path.name}: {'DIFFERS' if differs else 'agrees'}: {line}", flush=True)
    return not differs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--scenes", default="0:20", metavar="K|A:B", help="the scene K, or those from A to B - 1 (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=3, help="for each of three renders by quasilux, and for all by Mitsuba (default: 3)")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "quasilux"))
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba (default: %(default)s)")
    parser.add_argument("more", nargs="*", help="after --: further options of quasilux render, such as --kernels generic, which compile once, but "
                                                 "leave more noise, since all classes of photons are used")
    options = parser.parse_args()
    mitsuba.set_variant(options.variant)
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    write_files(OUT)
    begin, _, end = options.scenes.partition(":")
    results = [examine(options, k) for k in range(int(begin), int(end or int(begin) + 1))]
    print(f"{len(results)} scenes of seed {options.seed}, {results.count(False)} differ, fail or are refused")
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()

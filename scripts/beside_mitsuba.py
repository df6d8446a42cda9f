"""scenes/plate_checker.xml by quasilux and by Mitsuba 3's `volpath`, each twice for the same time, in turns.

Called by scripts/beside_mitsuba.sh. Kernels of both are compiled before the clock starts. Each image is compared with the
reference, net of its noise; and the two images of a renderer with each other, which shows their noise without any reference:
half the mean of (A - B)^2 with the weights of net relMSE.
"""
import os
import subprocess
import sys
import time

import mitsuba
import numpy as np

from figures import Renders, argument_parser, measured_on
from relmse import plate_reference

VARIANTS = ["llvm_ad_rgb", "scalar_rgb"]  # the first one that works here
SAMPLES = 16  # per pixel in one call of Mitsuba: some seconds
METHODS = {
    "quasilux, split by level": ["--quasi-specular", "level:0.1", "--variant", "alternative", "--bdd", "0"],
    "quasilux, standard": ["--quasi-specular", "none", "--bdd", "1"],
}


def load_mitsuba(scene):
    """The scene, in the fastest variant that runs here. Tried in a process of its own: where LLVM cannot compile a kernel, it ends
    the process."""
    for variant in VARIANTS:
        attempt = f"import mitsuba; mitsuba.set_variant('{variant}'); mitsuba.render(mitsuba.load_file(r'{scene}'), spp=1).numpy()"
        if subprocess.run([sys.executable, "-c", attempt], capture_output=True).returncode == 0:
            mitsuba.set_variant(variant)
            loaded = mitsuba.load_file(str(scene))
            np.asarray(mitsuba.render(loaded, spp=SAMPLES, seed=0))  # compiles
            return loaded, variant
        print(f"beside_mitsuba: {variant} does not run here", file=sys.stderr)
    sys.exit("beside_mitsuba: no variant of Mitsuba runs here")


def render_mitsuba(scene, seconds, seed):
    """The mean of as many calls as fit into the time; the number of samples per pixel."""
    start, total, calls = time.monotonic(), 0.0, 0
    while time.monotonic() - start < seconds:
        calls += 1
        total = total + np.asarray(mitsuba.render(scene, spp=SAMPLES, seed=1000 * seed + calls), np.float64)[..., :3]
    return total / calls, calls * SAMPLES


def row(name, images, work, reference):
    """Markdown; and the mean net relMSE and the noise of the plate."""
    plate = reference.masks["plate"]
    net = np.mean([reference.errors(image)["plate"].net for image in images])
    squares = (images[0] - images[1]) ** 2 / 2 * reference.weight
    noise = squares.mean(axis=2)[plate].mean()
    return f"| {name} | {work} | {net:.2e} | {noise:.2e} |", net, noise


def main():
    options = argument_parser(__doc__, 60).parse_args()
    reference = plate_reference()
    renders = Renders(options.program, "beside_mitsuba", "plate_checker.xml", dict(METHODS))
    renders.warm_up()
    scene, variant = load_mitsuba(renders.scene)
    load = os.getloadavg()
    images, work = {name: [] for name in (*METHODS, "Mitsuba")}, {}
    for seed in (1, 2):
        for name in METHODS:
            renders.methods[name] = [*METHODS[name], "--seed", str(seed)]
            image, statistics = renders.render(name, options.seconds)
            images[name].append(image)
            work[name] = f"{statistics['counters']['passes']} passes"
        image, samples = render_mitsuba(scene, options.seconds, seed)
        images["Mitsuba"].append(image)
        work["Mitsuba"] = f"{samples} samples per pixel"
    print(f"Turbid plate, {measured_on(statistics, options.seconds, load)}.\n")
    print("| renderer | work | relMSE of the plate, net | its noise, from two seeds |\n| --- | --- | --- | --- |")
    title = f"Mitsuba {mitsuba.__version__} volpath ({variant})"
    text, netThere, noiseThere = row(title, images["Mitsuba"], work["Mitsuba"], reference)
    print(text)
    ratios = []
    for name in METHODS:
        text, net, noise = row(name, images[name], work[name], reference)
        print(text)
        ratios.append(f"{name}: error {netThere / net:.0f} times, noise {noiseThere / noise:.0f} times less than Mitsuba's")
    print("\n" + "\n".join(ratios))


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Ways to split the phase function of a turbid plate on checkered paper, at equal time: the picture and the table.

Called by scripts/figure2.sh, which builds the program first. Renders go to out/figure2/, picture and table to
docs/figures/. Where the program knows `--map`, all pictures are made with photons stored; the best of them is made with
camera points stored too, and the camera points that each method would store are counted in a pass of their own.
"""
import json
import os
import subprocess
import sys
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from figures import FIGURES, Renders, argument_parser, measured_on, tone_map
from relmse import Error, plate_reference

EXPOSURE = 1.15  # factor on radiance, the same for all pictures
LEVEL = 0.1  # per sr, of the split by level
PHOTON_BYTES = 32  # in the index, where the scene does not limit the depth of paths
# Name: options, and the level of the phase function that they must lead to (null: infinity). `auto` leaves the medium to
# the scene, which says "yes", and the paper genuine diffuse; `all` would make the paper quasi-specular too, and with
# nothing genuine diffuse left the main variant is the standard method.
SPLITS = {
    "standard": (["--quasi-specular", "none"], None),
    "whole phase function, main": (["--quasi-specular", "auto", "--variant", "main"], 0),
    "whole phase function, alternative": (["--quasi-specular", "auto", "--variant", "alternative"], 0),
    "split by level, main": (["--quasi-specular", f"level:{LEVEL:g}", "--variant", "main"], LEVEL),
    "split by level, alternative": (["--quasi-specular", f"level:{LEVEL:g}", "--variant", "alternative"], LEVEL),
}
PAPER = ("standard, BDD 1", "whole phase function, main, BDD 1")  # compared in the paper


@dataclass
class Run:
    image: np.ndarray
    statistics: dict
    error: Error  # of the plate


def methods(knows_map):
    """Options by name of the method."""
    stored = ["--map", "photons"] if knows_map else []
    return {f"{name}, BDD {bdd}": [*options, "--bdd", str(bdd), *stored] for name, (options, _) in SPLITS.items() for bdd in (0, 1)}


def check_split(method, statistics):
    """Ends the program unless the phase function, and it alone, is split as the method's name says."""
    wanted = SPLITS[method[: method.index(", BDD")]][1]
    report = statistics["sceneReport"]
    levels = [medium["level"] for medium in report["media"]]
    right = len(levels) == 1 and (levels[0] is None if wanted is None else levels[0] is not None and abs(levels[0] - wanted) < 1e-6)
    if not right or any(lobe["scattering"] == "quasi-specular" for lobe in report["lobes"]):
        sys.exit(f"{method}: the scene is split in another way: {report['media']} {report['lobes']}")


def run(renders, reference, method, seconds):
    image, statistics = renders.render(method, seconds)
    check_split(method, statistics)
    return Run(image, statistics, reference.errors(image)["plate"])


def camera_points(renders, method):
    """Points and bytes that the method stores in a pass where camera points are stored."""
    statistics = renders.folder / "camera-points.json"
    options = [option if option != "photons" else "camera" for option in renders.methods[method]]
    command = [renders.program, "render", renders.scene, "--quiet", "--passes", "1", *options]
    subprocess.run([*command, "--output", renders.folder / "camera-points.exr", "--stats", statistics], check=True)
    counters = json.loads(statistics.read_text())["counters"]
    return counters["storedPoints"], counters["storedBytes"]


def volume_photons(counters):
    """Photons stored in media in a pass."""
    stored = sum(count for name, count in counters["photonsStored"].items() if name.startswith("volume "))
    return stored / counters["passes"]


def draw_pictures(runs, reference, seconds):
    best = min((method for method in runs if method.startswith("split")), key=lambda method: runs[method].error.net)
    panels = {method: runs[method] for method in (*PAPER, best)}
    figure, axes = plt.subplots(1, 4, figsize=(17, 3.9), layout="constrained")
    for axis, (method, result) in zip(axes, panels.items()):
        axis.imshow(tone_map(result.image, EXPOSURE), interpolation="nearest")
        axis.set_title(f"{method}\n{result.statistics['counters']['passes']} passes in {seconds:g} s", fontsize=10)
        axis.text(0.5, -0.03, f"relMSE of the plate {result.error.net:.1e}", transform=axis.transAxes, ha="center", va="top", fontsize=10)
    axes[-1].imshow(tone_map(reference.pixels, EXPOSURE), interpolation="nearest")
    axes[-1].set_title("reference: volumetric path tracer,\n3760 samples per pixel", fontsize=10)
    own = reference.noise[reference.masks["plate"]].mean()
    axes[-1].text(0.5, -0.03, f"its own noise {own:.1e}", transform=axes[-1].transAxes, ha="center", va="top", fontsize=10)
    for axis in axes:
        axis.set_axis_off()
    figure.savefig(FIGURES / "figure2.png", dpi=100)
    plt.close(figure)


def table(runs, points, seconds, load):
    """Markdown."""
    header = ["method", "passes", "relMSE", "mean", "photons in the medium a pass", "MB"]
    header += ["camera points a pass", "MB"] if points else []
    rows = []
    for method, result in runs.items():
        counters = result.statistics["counters"]
        row = [method, str(counters["passes"]), f"{result.error.net:.1e}", f"{100 * result.error.mean:+.2f} %"]
        stored = volume_photons(counters)
        row += [f"{stored:,.0f}", f"{stored * PHOTON_BYTES / 1e6:.1f}"] if stored else ["not stored", ""]
        row += [f"{points[method][0]:,}", f"{points[method][1] / 1e6:.1f}"] if method in points else ["", ""] if points else []
        rows.append(row)
    lines = [header, ["---"] * len(header), *rows]
    first = next(iter(runs.values())).statistics
    return (
        f"Turbid plate on checkered paper ({first['scene']}), {measured_on(first, seconds, load)}.\n\n"
        "relMSE of the plate, net of the reference's noise ([how](../method/accuracy.md#against-a-noisy-reference); that noise leaves it\n"
        "uncertain by 7e-5); difference of its mean luminance from the reference.\n"
        f"A photon takes {PHOTON_BYTES} bytes in the index." + (" Camera points: in media and on surfaces." if points else "") + "\n\n"
        + "\n".join("| " + " | ".join(line) + " |" for line in lines)
        + "\n"
    )


def main():
    options = argument_parser(__doc__, 60).parse_args()
    help_text = subprocess.run([options.program, "render", "--help"], check=True, capture_output=True, text=True).stdout
    knows_map = "--map" in help_text
    FIGURES.mkdir(parents=True, exist_ok=True)
    reference = plate_reference()
    renders = Renders(options.program, "figure2", "plate_checker.xml", methods(knows_map))
    renders.warm_up()
    points = {method: camera_points(renders, method) for method in renders.methods} if knows_map else {}
    load = os.getloadavg()
    runs = {method: run(renders, reference, method, options.seconds) for method in renders.methods}
    if knows_map:
        best = min(runs, key=lambda method: runs[method].error.net)
        method = f"{best}, camera points stored"
        renders.methods[method] = [option if option != "photons" else "camera" for option in renders.methods[best]]
        points[method] = points[best]
        runs[method] = run(renders, reference, method, options.seconds)
    draw_pictures(runs, reference, options.seconds)
    text = table(runs, points, options.seconds, load)
    (FIGURES.parent / "notes" / "figure2.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Three methods on the modified Cornell box at equal time: the picture, the table, and the convergence plot.

Called by scripts/figure1.sh, which builds the program first. Renders go to out/figure1/, pictures to docs/figures/.
"""
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from figures import FIGURES, Renders, argument_parser, measured_on, tone_map
from relmse import SURFACES, box_reference

EXPOSURE = 1.34  # factor on radiance, the same for all pictures
METHODS = {
    "standard, BDD 0": ["--quasi-specular", "none", "--bdd", "0"],
    "standard, BDD 1": ["--quasi-specular", "none", "--bdd", "1"],
    "quasi-specular, BDD 0": ["--quasi-specular", "auto", "--bdd", "0"],
}
CONVERGENCE_SHARES = [1 / 15, 2 / 15, 4 / 15, 1 / 2, 1]  # of the full time: 2, 4, 8, 15, 30 of 30 s


def draw_pictures(runs, seconds):
    figure, axes = plt.subplots(1, len(runs), figsize=(4.1 * len(runs), 4.9), layout="constrained")
    for axis, (method, (image, statistics, errors)) in zip(axes, runs.items()):
        axis.imshow(tone_map(image, EXPOSURE), interpolation="nearest")
        axis.set_axis_off()
        axis.set_title(f"{method}: {statistics['counters']['passes']} passes in {seconds:g} s", fontsize=11)
        net = [f"{name} {errors[name].net:.1e}" for name in ("all", "walls", "boxes")]
        axis.text(0.5, -0.03, "relMSE " + ", ".join(net), transform=axis.transAxes, ha="center", va="top", fontsize=9)
    figure.savefig(FIGURES / "figure1.png", dpi=110)
    plt.close(figure)


def draw_convergence(renders, reference, seconds):
    figure, axes = plt.subplots(1, 3, figsize=(12.5, 4), sharey=True, layout="constrained")
    times = [seconds * share for share in CONVERGENCE_SHARES]
    for method in METHODS:
        runs = [renders.render(method, time) for time in times]
        spent = [statistics["phases"]["render"] for _, statistics in runs]
        errors = [reference.errors(image) for image, _ in runs]
        for axis, region in zip(axes, ("all", "walls", "boxes")):
            axis.plot(spent, [error[region].net for error in errors], marker="o", label=method)
    for axis, region in zip(axes, ("all", "walls", "boxes")):
        axis.set(xscale="log", yscale="log", title=region, xlabel="rendering time, s")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("relMSE, net of the reference's noise")
    axes[0].legend()
    figure.savefig(FIGURES / "convergence.png", dpi=110)
    plt.close(figure)


def print_table(runs, seconds, load):
    print(measured_on(next(iter(runs.values()))[1], seconds, load) + "\n")
    print("| method | passes | relMSE all | walls | boxes |")
    print("|---|---|---|---|---|")
    for method, (_, statistics, errors) in runs.items():
        cells = [f"{errors[name].net:.1e}" for name in ("all", "walls", "boxes")]
        print(f"| {method} | {statistics['counters']['passes']} | " + " | ".join(cells) + " |")
    print("\nDifference of region means from the reference, % of luminance:\n")
    print("| method | " + " | ".join(SURFACES) + " |")
    print("|---" * (len(SURFACES) + 1) + "|")
    for method, (_, _, errors) in runs.items():
        print(f"| {method} | " + " | ".join(f"{100 * errors[name].mean:+.2f}" for name in SURFACES) + " |")


def main():
    parser = argument_parser(__doc__, 30)
    parser.add_argument("--convergence", action="store_true", help="draw docs/figures/convergence.png too, up to that time")
    options = parser.parse_args()
    FIGURES.mkdir(parents=True, exist_ok=True)
    reference = box_reference()
    renders = Renders(options.program, "figure1", "cornell_phong.xml", METHODS)
    renders.warm_up()
    load = os.getloadavg()
    runs = {}
    for method in METHODS:
        image, statistics = renders.render(method, options.seconds)
        runs[method] = image, statistics, reference.errors(image)
    draw_pictures(runs, options.seconds)
    print_table(runs, options.seconds, load)
    if options.convergence:
        draw_convergence(renders, reference, options.seconds)


if __name__ == "__main__":
    main()

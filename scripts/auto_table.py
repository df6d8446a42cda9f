#!/usr/bin/python3
"""`--auto` against fixed settings at equal time, for every scene of scenes/: the table at the end of docs/notes/search.md.

Renders go to out/auto/ and are kept: a later run makes only what is missing (--again makes all anew), so that scenes can be done in
several runs. After a change of the kernels take --again: renders by fixed settings come first and leave kernels compiled for those by
--auto. The error of a render is the root of relMSE: what the render estimates of itself (noiseRms^2 + biasRms^2) and, where
the truth is known, what the image has: what `scripts/relmse.py` measures against a reference of scenes/references/, or the
distance from a radiance that is the same everywhere.

The least of many noisy errors is too low an estimate of what its setting does. So settings are chosen by renders of seed 1, and the
figures of the table come from other seeds (--seeds), mean of their relMSE, of the best fixed setting and of --auto alike.

The choice apart from the time of the pilots: what --auto chose is rendered as a fixed setting too (--fixed), for the same time and by other seeds.
"""
import argparse
import json
import math
import os
import subprocess

from figures import ROOT, measured_on
from relmse import box_reference, plate_reference, read_channels

# Split, variant, BDD of the fixed settings; levels are for media only. Photons and radius: factors on the defaults.
SPLITS, LEVELS = ["auto", "none", "all"], ["level:0.03", "level:0.1", "level:0.3"]
FIRST_SEED, CHOICE_SEED = 2, 10  # of the table's figures; what is added to a seed where a choice is rendered apart
REFERENCES = {"cornell_phong": (box_reference, "all"), "plate_checker": (plate_reference, "plate")}
# Radiance of all pixels: of furnaces in closed form, of the slab its reflectance (adding-doubling, tests/support/slab_cases.cpp).
EVEN = {"furnace_glass": 2.5, "furnace_medium": 1, "furnace_sky": 1, "furnace_split": 2.5, "furnace_textured": 2.5, "slab": 0.52645242}


def true_error(scene, image):
    """Square of it, net of the reference's noise; None where the truth is not known."""
    if scene not in EVEN and scene not in REFERENCES:
        return None
    pixels = read_channels(image, ["R", "G", "B"])
    if scene in EVEN:
        return float(((pixels - EVEN[scene]) ** 2).mean()) / (1.01 * EVEN[scene] ** 2)
    reference, region = REFERENCES[scene]
    return reference().errors(pixels)[region].net


def scenes():
    return sorted(path.stem for path in (ROOT / "scenes").glob("*.xml"))


class Table:
    def __init__(self, options):
        self.options = options
        self.seeds = range(FIRST_SEED, FIRST_SEED + options.seeds)
        self.folder = ROOT / "out" / "auto"
        self.folder.mkdir(parents=True, exist_ok=True)

    def render(self, scene, settings, seconds):
        """Statistics of a render and its image, from an earlier run if there is one."""
        stem = "_".join([scene, f"{seconds:g}s", *settings]).replace("--", "").replace(":", "-")
        statistics, image = self.folder / f"{stem}.json", self.folder / f"{stem}.exr"
        if self.options.again or not (statistics.exists() and image.exists()):
            command = [self.options.program, "render", ROOT / "scenes" / f"{scene}.xml", "--quiet", *settings]
            # Kernels are compiled beforehand, so that no fixed setting pays for it; --auto does what it does for a user whose
            # cache is warm. docs/method/auto.md says what a cold one costs.
            if "--auto" not in settings:
                subprocess.run([*command, "--passes", "1", "-o", self.folder / "warm-up.exr"], check=True)
            subprocess.run([*command, "--time", f"{seconds:g}", "-o", image, "--stats", statistics], check=True)
        return json.loads(statistics.read_text()), image

    def errors(self, scene, settings, seconds=None):
        """Estimated error, true one or None, statistics."""
        statistics, image = self.render(scene, settings, seconds or self.options.time)
        estimated = statistics["error"]["relativeMse"]
        net = true_error(scene, image)
        return (math.sqrt(estimated) if estimated is not None else math.inf), (math.sqrt(net) if net and net > 0 else None), statistics

    def has_media(self, scene):
        return "<medium" in (ROOT / "scenes" / f"{scene}.xml").read_text()

    def first_photons(self, scene):
        """Six a pixel: many more, which is the default of small images, would hide which split is the best."""
        image = self.render(scene, ["--fixed"], self.options.time / 6)[0]["image"]
        return max(2500, 6 * image["width"] * image["height"])

    def fixed(self, scene):
        photons = str(self.first_photons(scene))
        splits = SPLITS + (LEVELS if self.has_media(scene) else [])
        for split in splits:
            for variant in ["main", "alternative"]:
                if split == "none" and variant == "alternative":
                    continue  # nothing is quasi-specular: the variants are one
                if split == "all" and variant == "main":
                    continue  # nothing is genuine diffuse: the standard method, as none
                for bdd in ["0", "1"]:
                    yield ["--fixed", "--quasi-specular", split, "--variant", variant, "--bdd", bdd, "--photons", photons]

    def screened(self, scene):
        """The fixed settings that a render of a sixth of the time does not rule out: the best three whose error is within 1.3 times
        the least."""
        estimated = {tuple(settings): self.errors(scene, settings, self.options.time / 6)[0] for settings in self.fixed(scene)}
        best = sorted(estimated, key=estimated.get)[:3]
        return [settings for settings in best if estimated[settings] <= 1.3 * estimated[best[0]]]

    def best_fixed(self, scene):
        """The best of these, with the photons and the radius that are best for it, one step after the other."""
        runs = {settings: self.errors(scene, settings) for settings in self.screened(scene)}
        best = min(runs, key=lambda settings: runs[settings][0])
        split, photons, radius = best[:-2], runs[best][2]["sceneReport"]["photonsPerPass"], 1.0

        def improves(next_photons, next_radius):
            nonlocal best, photons, radius
            settings = (*split, "--photons", str(next_photons), "--radius-scale", f"{next_radius:.3g}")
            runs[settings] = self.errors(scene, settings)
            if runs[settings][0] >= runs[best][0]:
                return False
            best, photons, radius = settings, next_photons, next_radius
            return True

        fewer = False
        while photons > 300 and improves(photons // 2, radius):
            fewer = True
        while not fewer and improves(photons * 2, radius):
            pass
        if not improves(photons, 1.4 * radius):
            improves(photons, radius / 1.4)
        return best

    def chosen(self, statistics):
        settings, report = statistics["settings"], statistics["sceneReport"]
        return ["--fixed", "--quasi-specular", settings["quasiSpecular"], "--variant", settings["variant"], "--bdd",
                str(settings["bdd"]), "--photons", str(report["photonsPerPass"]), "--radius-scale", f"{settings['radiusScale']:.6g}"]

    def mean(self, scene, runs):
        """Roots of the mean estimated relMSE and of the mean true one (None where it is not known), of (settings, seed)."""
        all_errors = [self.errors(scene, [*settings, "--seed", str(seed)]) for settings, seed in runs]

        def root(values):
            return math.sqrt(sum(value * value for value in values) / len(values)) if None not in values else None

        return root([estimated for estimated, _, _ in all_errors]), root([true for _, true, _ in all_errors]), all_errors[0][2]

    def row(self, scene):
        best = self.best_fixed(scene)
        of_best = self.mean(scene, [(best, seed) for seed in self.seeds])
        auto = self.mean(scene, [(["--auto"], seed) for seed in self.seeds])
        searched = [self.render(scene, ["--auto", "--seed", str(seed)], self.options.time)[0] for seed in self.seeds]
        chosen = [self.chosen(statistics) for statistics in searched]
        choice = self.mean(scene, [(settings, seed + CHOICE_SEED) for settings, seed in zip(chosen, self.seeds)])
        pilots = sum(statistics["auto"]["pilotSeconds"] for statistics in searched) / len(self.seeds)
        names = "; ".join(dict.fromkeys(name(settings) for settings in chosen))
        return [scene, name(best), percent(of_best[0]), names, percent(auto[0]), ratio(auto[0], of_best[0]), ratio(choice[0], of_best[0]),
                true_ratio(auto, of_best), true_ratio(choice, of_best), f"{pilots:.1f} s"], auto[2]


def name(settings):
    """Values of the options, but for --fixed."""
    short = {"--quasi-specular": "", "--variant": "", "--bdd": "BDD ", "--photons": "photons ", "--radius-scale": "radius "}
    pairs = list(zip(settings[1::2], settings[2::2]))
    return ", ".join(short[key] + value for key, value in pairs if (key, value) != ("--radius-scale", "1"))


def percent(error):
    return f"{100 * error:.2f} %"


def ratio(error, best):
    """Errors of rounding have no ratio."""
    return f"{error / best:.2f}" if best > 1e-6 else "-"


def true_ratio(errors, best):
    return ratio(errors[1], best[1]) if errors[1] and best[1] else "-"


MARK = "<!-- scripts/auto_table.py writes what follows -->"
HEADER = ["scene", "best fixed", "error", "auto chose", "error", "ratio", "choice alone", "true ratio", "choice alone", "pilots"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"names in scenes/, without .xml (default: all: {', '.join(scenes())})")
    parser.add_argument("--time", type=float, default=20, help="seconds of each render (default 20)")
    parser.add_argument("--seeds", type=int, default=2, help="renders that each figure is the mean of (default 2)")
    parser.add_argument("--again", action="store_true", help="render anew what out/auto/ has")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "quasilux"), help="the built program")
    parser.add_argument("--print", action="store_true", help="leave docs/notes/search.md as it is (a trial)")
    options = parser.parse_args()
    unknown = set(options.scenes) - set(scenes())
    if unknown:
        parser.error(f"no such scene: {', '.join(sorted(unknown))}; expected names among: {', '.join(scenes())}")
    table, load, rows, statistics = Table(options), os.getloadavg(), [], None
    for scene in options.scenes or scenes():
        row, statistics = table.row(scene)
        rows.append(row)
        print("| " + " | ".join(row) + " |", flush=True)
    lines = [HEADER, ["---"] * len(HEADER), *rows]
    text = (
        f"{MARK}\n\n`scripts/auto_table.py --time {options.time:g}`: {measured_on(statistics, options.time, load)}. "
        "Error: root of relMSE as estimated by the render; ratios are of errors.\n\n"
        + "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"
    )
    print(text)
    if not options.print:
        page = ROOT / "docs" / "notes" / "search.md"
        page.write_text(page.read_text().split(MARK)[0] + text)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Meters against closed forms by every method: makes docs/notes/oracles.md.

Usage: scripts/oracles.py [--effort X] [--only TEXT] [--output FILE]
Needs the program build/release/quasilux. Every oracle runs by every method; no row is left out, and deviations of more
than 0.5 % and three standard errors are marked.
"""
import argparse
import hashlib
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

import numpy as np

from oracle_scenes import (
    DOWN, PI, SKY, UPRIGHT, ball_lens, beam, beam_at, closed_room, cube, diffuse, disc, furnace, glass, glass_pane,
    integrating_sphere, light, mean_over_square, meter, meter_at, pane_transmittance, point, point_irradiance,
    radiance_meter, rectangle, sphere, sphere_irradiance, square, square_irradiance,
)

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/quasilux"

RESOLVED = 0.01  # largest standard error of a reading that decides anything

# Directional albedo of GGX with Smith's separable masking, no Fresnel factor; single scattering. By alpha and angle.
GGX_ALBEDO = {
    0.1: {0: 0.9883066479003688, 45: 0.9816739405407694, 75: 0.9232398588418846},
    0.5: {0: 0.6878490202958776, 45: 0.6784508404468321, 75: 0.7233998286863739},
}


@dataclass
class Oracle:
    name: str
    body: str
    truth: float
    source: str
    photons: int = 20000
    passes: int = 24
    direct: tuple = ("emitters", "photons")  # where direct light may come from: meters like points meet no photons
    kinds: tuple = ("standard", "main", "alternative")  # nor those of quasi-caustics, which the main variant counts
    files: dict = field(default_factory=dict)


def direct_oracles():
    at = 'x="1" y="0" z="2"'
    ground = ('<shape type="rectangle"><transform name="to_world"><scale value="1000"/><translate z="-0.2"/></transform>'
              + diffuse(0) + "</shape>")
    law, howell = "inverse square and cosine law", "Howell, configuration factors"
    contour = "Lambert's contour integral"
    disc_body = f'<shape type="obj"><string name="filename" value="disc.obj"/>{light(1)}</shape>'
    files = {"disc.obj": disc()}
    return [
        Oracle("point light", point(100, at) + meter_at(0), mean_over_square(point_irradiance(100, (1, 0, 2)), 0.05), law),
        Oracle("point light, tilt 40°", point(100, at) + meter_at(40),
               mean_over_square(point_irradiance(100, (1, 0, 2)), 0.05, 40), law),
        Oracle("disc, parallel receiver", disc_body + meter_at(0, 0.002), 0.20696318838093658, howell + " B-13",
               direct=("emitters",), files=files),
        Oracle("disc, perpendicular receiver", disc_body + meter_at(90, 0.002), 0.1827034225944803, howell + " B-12",
               direct=("emitters",), files=files),
        Oracle("unit square at 1", square(1, 'z="1"') + meter_at(0),
               mean_over_square(square_irradiance(1, (0, 0, 1)), 0.05, 0, 60), contour),
        Oracle("unit square, upright receiver", square(1, 'x="1" z="1"') + meter_at(90),
               mean_over_square(square_irradiance(1, (1, 0, 1)), 0.05, 90, 60), contour),
        Oracle("sphere R 1 at 2", sphere('x="0" y="0" z="2"') + meter_at(0),
               mean_over_square(sphere_irradiance((0, 0, 2)), 0.05, 0, 60), "π L (R/d)² cos θ"),
        Oracle("sphere R 1 at 2, tilt 45°", sphere('x="0" y="0" z="2"') + meter_at(45),
               mean_over_square(sphere_irradiance((0, 0, 2)), 0.05, 45, 60), "π L (R/d)² cos θ"),
        Oracle("sky", SKY + meter_at(0), PI, "π L"),
        Oracle("sky, tilt 60° over black ground", SKY + ground + meter_at(60), 0.75 * PI, "π L (1 + cos β) / 2",
               direct=("emitters",)),
        Oracle("parallel light at 40°", beam_at(40) + meter_at(0, 0.5), math.cos(math.radians(40)), "cos θ"),
        Oracle("parallel unit squares", square(1, 'z="1"') + meter_at(0, 0.5), PI * 0.19982489569838746, howell + " C-11"),
        Oracle("perpendicular unit squares", square(1, 'x="0.5" z="0.5"') + meter_at(90, 0.5), PI * 0.20004377607540316,
               howell + " C-14"),
    ]


def interreflection_oracles():
    few = 5000  # where the light is even, wide kernels cost time and bias nothing
    return [
        Oracle("furnace, ρ 0.5", furnace(0.5), 2 * PI, "π e / (1 − ρ)", few),
        Oracle("furnace, ρ 0.9", furnace(0.9), 10 * PI, "π e / (1 − ρ)", few),
        Oracle("integrating sphere, 1000 lm, ρ 0.8", integrating_sphere(0.8), 318.30988618379075 + 250 / PI,
               "Φ / (A (1 − ρ)), Goebel 1967", few),
        Oracle("radiosity cube, floor", cube(0), 2 * 0.5378909483623088, "matrix of 21² patches a face, extrapolated"),
        Oracle("radiosity cube, side", cube(2), 2 * 0.5689696851585091, "matrix of 21² patches a face, extrapolated"),
    ]


def glass_oracles():
    """Clear panes, and light focused by a ball."""
    pane = glass_pane(1.5, 2, 0.05, 0.1)
    ball = f'<shape type="sphere"><point name="center" x="0" y="0" z="1.2"/>{glass(1.5)}</shape>'
    return [Oracle(f"clear pane n 1.5, parallel light at {a}°", beam_at(a) + pane + meter_at(0, 1),
                   math.cos(math.radians(a)) * pane_transmittance(a, 1.5), "cos θ (1 − R) / (1 + R), Stokes 1862", 200000, 16)
            for a in (0, 45, 60, 75)] + [
        Oracle("caustic of a glass ball", beam(0, 0, -1) + ball + meter_at(0, 0.5), ball_lens(1.5, 1.2, 0.5),
               "quadrature, all orders of reflection", 100000, 8)]


def albedo_oracles():
    """A plate in a sky of radiance 1 shows kd + ks A(θ): A by quadrature, 1e-4."""
    phong = {20: {0: 1.0, 45: 0.7071102787712648, 75: 0.2711785285783344}, 1000: {0: 1.0, 45: 0.7071067811865479, 75: 0.2588190451025208}}
    rows = []
    for exponent, albedos in phong.items():
        bsdf = ('<bsdf type="phong"><rgb name="diffuse_reflectance" value="0.3"/><rgb name="specular_reflectance" value="0.5"/>'
                f'<float name="exponent" value="{exponent}"/></bsdf>')
        rows += albedo_rows(f"Phong 0.5, n {exponent}", bsdf, albedos)
    for alpha, albedos in GGX_ALBEDO.items():
        bsdf = ('<bsdf type="blendbsdf"><float name="weight" value="0.5"/>' + diffuse(0.6) +
                f'<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="none"/>'
                f'<float name="alpha" value="{alpha}"/></bsdf></bsdf>')
        rows += albedo_rows(f"GGX 0.5, α {alpha}", bsdf, albedos)
    return rows


def albedo_rows(name, bsdf, albedos):
    """Photons of a sky are few on a small plate: they take another number of passes than sampled emitters."""
    effort = {"emitters": (1000, 24), "photons": (100000, 40)}
    return [Oracle(f"albedo of Lambert 0.3 + {name}, at {a}°, {direct}", SKY + rectangle("1,1,1", "", "0,0,0", bsdf) + radiance_meter(a),
                   0.3 + 0.5 * albedo, "quadrature", photons, passes, direct=(direct,))
            for a, albedo in albedos.items() for direct, (photons, passes) in effort.items()]


def cie_oracles():
    """CIE 171:2006; rooms from 0 to 4 m. Points where emitters are sampled; photons are counted by meters of 0.5 m and more."""
    small = 0.0005
    lamp = 'value="2,2,2"'
    lambert = rectangle("0.001,0.001,1", DOWN, "0,0,3", light(1000 / 0.002**2))
    ceiling = rectangle("0.5,0.5,1", DOWN, "2,2,3", light(1000))
    floor = beam(0, 0, -1) + rectangle("2,2,1", "", "2,2,0", diffuse(0.3, True))
    wall = (beam(0, 1, 5) +  # from below: there is no floor
            rectangle("2,1.5,1", UPRIGHT, "2,4,1.5", diffuse(0.6)) +
            '<shape type="cube"><transform name="to_world"><scale value="2,0.1,0.5"/><translate value="2,2.6,0.5"/></transform>'
            + diffuse(0) + "</shape>")
    north = '<rotate x="1" angle="-90"/>'  # faces +y
    points = ("emitters",)
    flux = 10000 / (4 * PI)

    def lambert_illuminance(p, _):
        return 1000 * 9 / (p[0]**2 + p[1]**2 + 9)**2

    return [
        Oracle("CIE 171 5.2, point A", lambert + meter("", "0,0,0", small), 111.11111111111111, "I h² / d⁴", direct=points),
        Oracle("CIE 171 5.2, point F", lambert + meter("", "1,0.5,0", small), 85.66329565734682, "I h² / d⁴", direct=points),
        Oracle("CIE 171 5.2, 1 m² about A", lambert + meter("", "0,0,0", 0.5), mean_over_square(lambert_illuminance, 0.5),
               "I h² / d⁴, mean", 200000, direct=("photons",)),
        Oracle("CIE 171 5.3, wall B", ceiling + meter(north, "2,0,2.25", small), 75.19392456629542, "Lambert's contour integral",
               direct=points),
        Oracle("CIE 171 5.3, floor J", ceiling + meter("", "2,1.75,0", small), 105.77824217629437, "Lambert's contour integral",
               direct=points),
        Oracle("CIE 171 5.4, flux conservation", point(flux, 'value="1,2.5,2"') + closed_room(3, 0), 125, "Φ / A", passes=64),
        Oracle("CIE 171 5.6, wall C", floor + meter(north, "2,0,1.25", small), 0.3 * 0.2799162386824111, "configuration factor",
               kinds=("standard", "alternative")),
        Oracle("CIE 171 5.6, ceiling J", floor + meter(DOWN, "2,1.75,3", small), 0.3 * 0.3556659245454594,
               "configuration factor", kinds=("standard", "alternative")),
        Oracle("CIE 171 5.6, 1 m² about ceiling J", floor + meter(DOWN, "2,1.75,3", 0.5),
               mean_over_square(square_irradiance(4, (0, 0.25, 3)), 0.5, 0, 60) * 0.3 / PI, "Lambert's contour integral, mean",
               100000),
        Oracle("CIE 171 5.7, wall C", wall + meter(north, "2,0,1.75", small), 0.6 / math.sqrt(26) * 0.15398809916935388, "configuration factor"),
        Oracle("CIE 171 5.7, floor H", wall + meter("", "2,0.75,0", small), 0.6 / math.sqrt(26) * 0.036289856355258, "configuration factor"),
    ] + [Oracle(f"CIE 171 5.8, ρ {rho}", point(flux, lamp) + closed_room(4, rho), 10000 / (96 * (1 - rho)), "Φ / (A (1 − ρ))",
                50000, 16) for rho in (0.2, 0.5, 0.8)]


def oracles():
    return direct_oracles() + interreflection_oracles() + glass_oracles() + albedo_oracles() + cie_oracles()


def methods(oracle):
    """Name and options."""
    kinds = {"standard": ["--quasi-specular", "none"], "main": ["--variant", "main"],
             "alternative": ["--variant", "alternative"]}
    return [(f"{name}, BDD {bdd}, {direct}", [*options, "--bdd", str(bdd), "--direct", direct])
            for direct in oracle.direct for name, options in kinds.items() if name in oracle.kinds for bdd in (0, 1, 2)]


def measure(scene, oracle, options, effort):
    """Value and standard error. What is in out/oracles already is not rendered again."""
    work = ["--passes", str(max(1, round(oracle.passes * effort))), "--photons", str(oracle.photons)]
    key = hashlib.sha256(json.dumps([oracle.body, oracle.files, work, options]).encode()).hexdigest()[:24]
    kept = ROOT / "out/oracles" / f"{key}.json"
    if not kept.exists():
        command = [PROGRAM, "render", scene, "--json", "--quiet", "-o", scene.with_name("x.exr"), *work, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{oracle.name}, {options}: {done.stderr}")
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(done.stdout, encoding="utf-8")
    result = json.loads(kept.read_text(encoding="utf-8"))
    if result["nonFinite"] or result["cutPaths"]:
        sys.exit(f"{oracle.name}, {options}: samples were dropped or paths cut")
    return result["meter"]["value"][1], result["meter"]["standardError"][1]


def row(name, value, error, truth):
    """A table row, whether the reading passes, its deviation and its standard error, both relative."""
    deviation = value / truth - 1
    passes = abs(deviation) <= 0.005 or abs(value - truth) <= 3 * error
    remark = "**fails**" if not passes else "not resolved" if error > RESOLVED * truth else ""
    return (f"| {name} | {value:.6g} | {100 * deviation:+.3f} % | {100 * error / truth:.3f} % | {remark} |\n", passes,
            abs(deviation), error / truth)


def section(oracle, folder, effort):
    """The table of an oracle, and the rows' deviations and standard errors, and how many fail."""
    for name, text in oracle.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    scene = folder / "scene.xml"
    scene.write_text(f'<scene version="3.0.0">{oracle.body}</scene>', encoding="utf-8")
    text = (f"\n## {oracle.name}\n\nTruth {oracle.truth:.7g}, by {oracle.source}. {oracle.photons} photons a pass.\n\n"
            "| method | reading | deviation | standard error | |\n|---|---|---|---|---|\n")
    rows = [row(method, *measure(scene, oracle, options, effort), oracle.truth) for method, options in methods(oracle)]
    return text + "".join(r[0] for r in rows), rows


def summary_row(oracle, rows):
    return (f"| {oracle.name} | {oracle.truth:.7g} | {len(rows)} | {100 * max(r[2] for r in rows):.3f} % | "
            f"{100 * float(np.median([r[3] for r in rows])):.3f} % | {sum(not r[1] for r in rows)} |\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--effort", type=float, default=1, help="factor on the number of passes")
    parser.add_argument("--only", default="", help="oracles whose name holds this")
    parser.add_argument("--output", default=str(ROOT / "docs/notes/oracles.md"))
    arguments = parser.parse_args()
    sections, summary, every = "", "", []
    with tempfile.TemporaryDirectory() as name:
        for oracle in oracles():
            if arguments.only not in oracle.name:
                continue
            text, rows = section(oracle, pathlib.Path(name), arguments.effort)
            sections += text
            summary += summary_row(oracle, rows)
            every += rows
            print(f"{oracle.name}: done, {sum(not r[1] for r in every)} of {len(every)} failed so far", flush=True)
    head = (f"# Oracles\n\nMade by `scripts/oracles.py --effort {arguments.effort:g}`: meters against closed forms, every oracle by every "
            "method. A\nreading fails that is off by more than 0.5 % and by more than three standard errors. Methods that do the same where\n"
            "light comes straight from lamps read the same there, with the same random numbers.\n\n"
            f"{len(every)} readings: {sum(not r[1] for r in every)} fail; {sum(r[3] > RESOLVED for r in every)} are not resolved (standard "
            f"error above 1 %). More than three standard errors\naway, whatever the percentage: {sum(r[2] > 3 * r[3] + 2e-6 for r in every)}.\n\n"
            "| oracle | truth | readings | largest deviation | median standard error | fail |\n|---|---|---|---|---|---|\n" + summary)
    path = pathlib.Path(arguments.output)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(head + sections, encoding="utf-8")


if __name__ == "__main__":
    main()

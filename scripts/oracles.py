#!/usr/bin/env python3
"""Meters against closed forms by every method: makes docs/accuracy/oracles.md.

Usage: scripts/oracles.py [--effort X] [--only TEXT] [--output FILE]
Needs the program build/release/quasilux. Every oracle runs by every method; no row is left out, and deviations of more
than 0.5 % and three standard errors are marked.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/quasilux"
PI = math.pi

RESOLVED = 0.01  # largest standard error of a reading that tells anything

METER = ('<sensor type="irradiancemeter"><film type="hdrfilm"><rfilter type="box"/>'
         '<integer name="width" value="1"/><integer name="height" value="1"/></film></sensor>')
# Directional albedo of GGX with Smith's separable masking, no Fresnel factor; single scattering. By alpha and angle.
GGX_ALBEDO = {
    0.1: {0: 0.9883066479003688, 45: 0.9816739405407694, 75: 0.9232398588418846},
    0.5: {0: 0.6878490202958776, 45: 0.6784508404468321, 75: 0.7233998286863739},
}
SKY = '<emitter type="constant"><rgb name="radiance" value="1"/></emitter>'


def diffuse(reflectance, quasi_specular=False):
    """Half of the reflectance as a lobe declared quasi-specular, if asked for."""
    plain = f'<bsdf type="diffuse"><rgb name="reflectance" value="{reflectance}"/>'
    if not quasi_specular:
        return plain + "</bsdf>"
    return (f'<bsdf type="blendbsdf"><float name="weight" value="0.5"/>{plain}</bsdf>'
            f'{plain}<?quasilux quasi-specular="yes"?></bsdf></bsdf>')


def light(radiance):
    return f'<emitter type="area"><rgb name="radiance" value="{radiance}"/></emitter>'


def meter_at(tilt, half=0.05):
    """A black square at the origin, turned from +z about y; `half` is half its side."""
    return (f'<shape type="rectangle"><transform name="to_world"><scale value="{half}"/><rotate y="1" angle="{tilt}"/>'
            f'</transform>{diffuse(0)}{METER}</shape>')


def square(side, place):
    return (f'<shape type="rectangle"><transform name="to_world"><scale value="{side / 2}"/><rotate x="1" angle="180"/>'
            f'<translate {place}/></transform>{light(1)}</shape>')


def sphere(place):
    return f'<shape type="sphere"><point name="center" {place}/>{light(1)}</shape>'


def point(intensity, place='x="0" y="0" z="0"'):
    return (f'<emitter type="point"><rgb name="intensity" value="{intensity}"/>'
            f'<point name="position" {place}/></emitter>')


def room(parts):
    """Cube of side 1, faces z0 z1 x0 x1 y0 y1, seen from within."""
    turns = ["", '<rotate x="1" angle="180"/>', '<rotate y="1" angle="90"/>', '<rotate y="1" angle="-90"/>',
             '<rotate x="1" angle="-90"/>', '<rotate x="1" angle="90"/>']
    places = ['z="-0.5"', 'z="0.5"', 'x="-0.5"', 'x="0.5"', 'y="-0.5"', 'y="0.5"']
    return "".join(f'<shape type="rectangle"><transform name="to_world"><scale value="0.5"/>{t}<translate {p}/></transform>'
                   f'{part}</shape>' for t, p, part in zip(turns, places, parts))


def furnace(reflectance):
    parts = [diffuse(reflectance, True) + light(1)] * 6
    return room([parts[0] + METER] + parts[1:])


def cube(meter):
    parts = [diffuse(0.5, True)] * 6
    parts[1] += light(1)
    parts[meter] += METER
    return room(parts)


def integrating_sphere(reflectance):
    return (point(1000 / (4 * PI)) + '<shape type="sphere"><boolean name="flip_normals" value="true"/>'
            + diffuse(reflectance, True) + METER + "</shape>")


def mean_over_square(function, half, tilt=0.0, steps=200):
    """Mean of E(x, y, z) over the meter: its size is part of the oracle."""
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    total = 0.0
    for i in range(steps):
        for j in range(steps):
            x, y = half * (2 * (i + 0.5) / steps - 1), half * (2 * (j + 0.5) / steps - 1)
            total += function((c * x, y, -s * x), (s, 0.0, c))
    return total / steps**2


def point_irradiance(intensity, at):
    def e(p, n):
        d = [a - b for a, b in zip(at, p)]
        r = math.sqrt(sum(v * v for v in d))
        return intensity * max(0.0, sum(a * b for a, b in zip(d, n))) / r**3
    return e


def sphere_irradiance(center, radius=1.0):
    """Whole sphere above the horizon."""
    def e(p, n):
        d = [a - b for a, b in zip(center, p)]
        r = math.sqrt(sum(v * v for v in d))
        return PI * radius**2 * sum(a * b for a, b in zip(d, n)) / r**3
    return e


def square_irradiance(side, center):
    """Lambert's contour integral over a square parallel to xy, all of it above the horizon."""
    h = side / 2
    corners = [(center[0] - h, center[1] - h, center[2]), (center[0] - h, center[1] + h, center[2]),
               (center[0] + h, center[1] + h, center[2]), (center[0] + h, center[1] - h, center[2])]

    def e(p, n):
        total = 0.0
        for k in range(4):
            a = [u - v for u, v in zip(corners[k], p)]
            b = [u - v for u, v in zip(corners[(k + 1) % 4], p)]
            cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            length = math.sqrt(sum(v * v for v in cross))
            total += math.atan2(length, sum(u * v for u, v in zip(a, b))) * sum(u * v for u, v in zip(cross, n)) / length
        return abs(total) / 2
    return e


def ball_lens(index, height, half, samples=1_000_000, orders=40):
    """Mean irradiance of a square of half side `half` under a ball of radius 1, its centre `height` above: parallel light of
    irradiance 1 from above, all orders of internal reflection, by quadrature over the impact parameter."""
    sine = np.sqrt((np.arange(samples) + 0.5) / samples)
    outer, inner = np.arcsin(sine), np.arcsin(sine / index)
    reflected = fresnel(outer, index)
    place, weight, total = PI / 2 - outer, 1 - reflected, 0.0  # angle of the place on the ball
    for _ in range(1, orders):
        place = place - (PI - 2 * inner)
        # Leaves at the angle `outer` to the normal, going on round the ball as the chord did.
        x, z = np.cos(place), np.sin(place)
        dx, dz = np.cos(outer) * x + np.sin(outer) * z, np.cos(outer) * z - np.sin(outer) * x
        down = dz < -1e-12
        landed = np.abs(x + np.where(down, (-height - z) / np.where(down, dz, -1), 0) * dx)
        share = np.where(landed < half * math.sqrt(2), 1 - 4 / PI * np.arccos(np.minimum(1, half / np.maximum(landed, half))), 0)
        total += float(np.sum(weight * (1 - reflected) * share * down)) / samples * PI
        weight = weight * reflected
    return total / (4 * half**2)


def fresnel(angle, index):
    """Mean of both polarisations."""
    c, ct = np.cos(angle), np.sqrt(1 - (np.sin(angle) / index)**2)
    return (((c - index * ct) / (c + index * ct))**2 + ((index * c - ct) / (index * c + ct))**2) / 2


def pane_transmittance(degrees, index):
    r = float(fresnel(math.radians(degrees), index))
    return (1 - r) / (1 + r)


def beam(x, y, z):
    return f'<emitter type="directional"><vector name="direction" value="{x},{y},{z}"/></emitter>'


def beam_at(degrees):
    return beam(math.sin(math.radians(degrees)), 0, -math.cos(math.radians(degrees)))


def rectangle(scale, turn, place, parts):
    return (f'<shape type="rectangle"><transform name="to_world"><scale value="{scale}"/>{turn}<translate value="{place}"/>'
            f'</transform>{parts}</shape>')


DOWN, UPRIGHT = '<rotate x="1" angle="180"/>', '<rotate x="1" angle="90"/>'


def meter(turn, place, half):
    """Through which light passes as if it were not there."""
    return rectangle(f"{half},{half},1", turn, place, '<bsdf type="null"/>' + METER)


def radiance_meter(degrees):
    """At (0, 0, 1), looking down at an angle to the vertical."""
    film = METER[METER.index("<film"):METER.index("</sensor>")]
    t = math.radians(degrees)
    return (f'<sensor type="radiancemeter"><point name="origin" value="{-math.tan(t)},0,1"/>'
            f'<vector name="direction" value="{math.sin(t)},0,{-math.cos(t)}"/>{film}</sensor>')


def closed_room(height, reflectance):
    return (f'<shape type="cube"><boolean name="flip_normals" value="true"/><transform name="to_world">'
            f'<translate value="1,1,1"/><scale value="2,2,{height / 2}"/></transform>{diffuse(reflectance, reflectance > 0)}'
            f'{METER}</shape>')


def glass_pane(index, half, lower, thickness):
    return (f'<shape type="cube"><transform name="to_world"><scale value="{half},{half},{thickness / 2}"/>'
            f'<translate z="{lower + thickness / 2}"/></transform>{glass(index)}</shape>')


def glass(index):
    return (f'<bsdf type="dielectric"><float name="int_ior" value="{index}"/><float name="ext_ior" value="1"/></bsdf>')


def disc(corners=720):
    """A fan of triangles in z = 1 about (1, 0), as large as a disc of radius 0.5."""
    rim = 0.5 * math.sqrt(2 * PI / corners / math.sin(2 * PI / corners))
    lines = ["v 1 0 1"] + [f"v {1 + rim * math.cos(2 * PI * k / corners):.9f} {rim * math.sin(2 * PI * k / corners):.9f} 1"
                           for k in range(corners)]
    lines += [f"f 1 {2 + (k + 1) % corners} {2 + k}" for k in range(corners)]
    return "\n".join(lines) + "\n"


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
    return [
        Oracle("furnace, ρ 0.5", furnace(0.5), 2 * PI, "π e / (1 − ρ)"),
        Oracle("furnace, ρ 0.9", furnace(0.9), 10 * PI, "π e / (1 − ρ)"),
        Oracle("integrating sphere, 1000 lm, ρ 0.8", integrating_sphere(0.8), 318.30988618379075 + 250 / PI,
               "Φ / (A (1 − ρ)), Goebel 1967"),
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
                passes=64) for rho in (0.2, 0.5, 0.8, 0.95)]


def oracles():
    return direct_oracles() + interreflection_oracles() + glass_oracles() + albedo_oracles() + cie_oracles()


def methods(oracle):
    """Name and options."""
    kinds = {"standard": ["--quasi-specular", "none"], "main": ["--variant", "main"],
             "alternative": ["--variant", "alternative"]}
    return [(f"{name}, BDD {bdd}, {direct}", [*options, "--bdd", str(bdd), "--direct", direct])
            for direct in oracle.direct for name, options in kinds.items() if name in oracle.kinds for bdd in (0, 1, 2)]


def measure(scene, oracle, options, effort):
    command = [PROGRAM, "render", scene, "--json", "--quiet", "-o", scene.with_name("x.exr"), "--passes",
               str(max(1, round(oracle.passes * effort))), "--photons", str(oracle.photons), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{oracle.name}, {options}: {done.stderr}")
    result = json.loads(done.stdout)
    if result["nonFinite"] or result["cutPaths"]:
        sys.exit(f"{oracle.name}, {options}: samples were dropped or paths cut")
    meter_reading = result["meter"]
    return meter_reading["value"][1], meter_reading["standardError"][1]


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
    parser.add_argument("--output", default=str(ROOT / "docs/accuracy/oracles.md"))
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

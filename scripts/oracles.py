#!/usr/bin/env python3
"""Meters against closed forms by every method: makes docs/accuracy/oracles.md.

Usage: scripts/oracles.py [--passes N] [--photons N] [--only TEXT] [--output FILE]
Needs the program build/release/quasilux. Every oracle runs by every method; no row is left out, and deviations of more
than 0.5 % and three standard errors are marked.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/quasilux"
PI = math.pi

METER = ('<sensor type="irradiancemeter"><film type="hdrfilm"><rfilter type="box"/>'
         '<integer name="width" value="1"/><integer name="height" value="1"/></film></sensor>')
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


def oracles():
    """Name, scene body, irradiance, source."""
    at = 'x="1" y="0" z="2"'
    ground = ('<shape type="rectangle"><transform name="to_world"><scale value="1000"/><translate z="-0.2"/></transform>'
              + diffuse(0) + "</shape>")
    law, howell = "inverse square and cosine law", "Howell, configuration factors"
    contour = "Lambert's contour integral"
    return [
        ("point light", point(100, at) + meter_at(0), mean_over_square(point_irradiance(100, (1, 0, 2)), 0.05), law),
        ("point light, tilt 40°", point(100, at) + meter_at(40),
         mean_over_square(point_irradiance(100, (1, 0, 2)), 0.05, 40), law),
        ("unit square at 1", square(1, 'z="1"') + meter_at(0),
         mean_over_square(square_irradiance(1, (0, 0, 1)), 0.05, 0, 60), contour),
        ("unit square, upright receiver", square(1, 'x="1" z="1"') + meter_at(90),
         mean_over_square(square_irradiance(1, (1, 0, 1)), 0.05, 90, 60), contour),
        ("sphere R 1 at 2", sphere('x="0" y="0" z="2"') + meter_at(0),
         mean_over_square(sphere_irradiance((0, 0, 2)), 0.05, 0, 60), "π L (R/d)² cos θ"),
        ("sphere R 1 at 2, tilt 45°", sphere('x="0" y="0" z="2"') + meter_at(45),
         mean_over_square(sphere_irradiance((0, 0, 2)), 0.05, 45, 60), "π L (R/d)² cos θ"),
        ("sky", SKY + meter_at(0), PI, "π L"),
        ("sky, tilt 60° over black ground", SKY + ground + meter_at(60), 0.75 * PI, "π L (1 + cos β) / 2"),
        ("parallel unit squares", square(1, 'z="1"') + meter_at(0, 0.5), PI * 0.19982489569838746, howell + " C-11"),
        ("perpendicular unit squares", square(1, 'x="0.5" z="0.5"') + meter_at(90, 0.5), PI * 0.20004377607540316,
         howell + " C-14"),
        ("furnace, ρ 0.5", furnace(0.5), 2 * PI, "π e / (1 − ρ)"),
        ("furnace, ρ 0.9", furnace(0.9), 10 * PI, "π e / (1 − ρ)"),
        ("integrating sphere, 1000 lm, ρ 0.8", integrating_sphere(0.8), 318.30988618379075 + 250 / PI,
         "Φ / (A (1 − ρ)), Goebel 1967"),
        ("radiosity cube, floor", cube(0), 2 * 0.5378909483623088, "matrix of 21² patches a face, extrapolated"),
        ("radiosity cube, side", cube(2), 2 * 0.5689696851585091, "matrix of 21² patches a face, extrapolated"),
    ]


def methods():
    """Name and options."""
    kinds = [("standard", ["--quasi-specular", "none"]), ("main", ["--variant", "main"]),
             ("alternative", ["--variant", "alternative"])]
    return [(f"{name}, BDD {bdd}, {direct}", [*options, "--bdd", str(bdd), "--direct", direct])
            for direct in ("emitters", "photons") for name, options in kinds for bdd in (0, 1, 2)]


def measure(scene, options, arguments, folder):
    command = [PROGRAM, "render", scene, "--json", "--quiet", "-o", folder / "x.exr", "--passes", str(arguments.passes),
               "--photons", str(arguments.photons), *options]
    result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    if result["nonFinite"] or result["cutPaths"]:
        raise SystemExit(f"{command}: samples were dropped or paths cut")
    meter = result["meter"]
    return meter["value"][1], meter["standardError"][1]


def row(name, value, error, truth):
    deviation = value / truth - 1
    passes = abs(deviation) <= 0.005 or abs(value - truth) <= 3 * error
    return (f"| {name} | {value:.6g} | {100 * deviation:+.3f} % | {100 * error / truth:.3f} % | "
            f"{'' if passes else '**fails**'} |\n"), passes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--passes", type=int, default=24)
    parser.add_argument("--photons", type=int, default=20000)
    parser.add_argument("--only", default="", help="oracles whose name holds this")
    parser.add_argument("--output", default=str(ROOT / "docs/accuracy/oracles.md"))
    arguments = parser.parse_args()
    sections, failed, count = "", 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for oracle, body, truth, source in oracles():
            if arguments.only not in oracle:
                continue
            scene = folder / "scene.xml"
            scene.write_text(f'<scene version="3.0.0">{body}</scene>', encoding="utf-8")
            sections += (f"\n## {oracle}\n\nE = {truth:.7g}, by {source}.\n\n"
                         "| method | reading | deviation | standard error | |\n|---|---|---|---|---|\n")
            for method, options in methods():
                text, passes = row(method, *measure(scene, options, arguments, folder), truth)
                sections += text
                failed += not passes
                count += 1
            print(f"{oracle}: done, {failed} of {count} failed so far", flush=True)
    head = ("# Oracles\n\nMade by `scripts/oracles.py"
            + f" --passes {arguments.passes} --photons {arguments.photons}`: irradiance meters against closed forms, every oracle by\n"
            "every method. A reading fails that is off by more than 0.5 % and by more than three standard errors.\n\n"
            f"{count} readings, {failed} fail.\n")
    path = pathlib.Path(arguments.output)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(head + sections, encoding="utf-8")


if __name__ == "__main__":
    main()

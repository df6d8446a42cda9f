#!/usr/bin/env python3
"""Everyday scenes of many kinds, in metres, z up, which quasilux and Mitsuba 3 both render.

They are made to find what a renderer is poor at: light through blinds and curtains, lamps in shades and under cupboards, a door ajar,
streets by day and night. scripts/real_scenes.sh compares any of them with Mitsuba.
"""
import argparse
import pathlib
import random

BLACK = '<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>'
PANE = '<bsdf type="thindielectric"/>'


# --- bsdfs ---


def diffuse(reflectance):
    return f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{reflectance}"/></bsdf></bsdf>'


def plastic(reflectance, alpha=None):
    roughness = "" if alpha is None else f'<float name="alpha" value="{alpha}"/>'
    kind = "plastic" if alpha is None else "roughplastic"
    return f'<bsdf type="twosided"><bsdf type="{kind}"><rgb name="diffuse_reflectance" value="{reflectance}"/>{roughness}</bsdf></bsdf>'


def metal(material, alpha=None):
    roughness = "" if alpha is None else f'<float name="alpha" value="{alpha}"/>'
    kind = "conductor" if alpha is None else "roughconductor"
    return f'<bsdf type="twosided"><bsdf type="{kind}"><string name="material" value="{material}"/>{roughness}</bsdf></bsdf>'


def glass(alpha=None):
    roughness = "" if alpha is None else f'<float name="alpha" value="{alpha}"/>'
    return f'<bsdf type="{"dielectric" if alpha is None else "roughdielectric"}">{roughness}</bsdf>'


WALL, FLOOR, GROUND, WOOD = diffuse("0.7,0.7,0.68"), diffuse("0.35,0.3,0.25"), diffuse("0.2"), plastic("0.35,0.2,0.1", 0.15)
CLOTH = (
    '<bsdf type="principledthin"><rgb name="base_color" value="0.8,0.75,0.65"/><float name="roughness" value="0.8"/>'
    '<float name="diff_trans" value="1"/></bsdf>'
)
PAINT = (
    '<bsdf type="principled"><rgb name="base_color" value="0.5,0.02,0.02"/><float name="roughness" value="0.3"/>'
    '<float name="metallic" value="0.3"/><float name="clearcoat" value="1"/></bsdf>'
)


# --- shapes ---


def lamp(radiance):
    return f'{BLACK}<emitter type="area"><rgb name="radiance" value="{radiance}"/></emitter>'


def vector(tag, name, v):
    return f'<{tag} name="{name}" x="{v[0]:.6g}" y="{v[1]:.6g}" z="{v[2]:.6g}"/>'


def placed(kind, scale, turns, centre, inner):
    """`turns`: (axis, degrees), in their order."""
    rotate = "".join(f'<rotate {axis}="1" angle="{angle}"/>' for axis, angle in turns)
    x, y, z = centre
    sx, sy, sz = scale
    transform = f'<scale x="{sx:.6g}" y="{sy:.6g}" z="{sz:.6g}"/>{rotate}<translate x="{x:.6g}" y="{y:.6g}" z="{z:.6g}"/>'
    return f'<shape type="{kind}"><transform name="to_world">{transform}</transform>{inner}</shape>'


def box(low, high, bsdf, turns=()):
    scale = [(h - l) / 2 for l, h in zip(low, high)]
    return placed("cube", scale, turns, [(l + h) / 2 for l, h in zip(low, high)], bsdf)


def rectangle(centre, half_x, half_y, inner, turns=()):
    """It faces up before its turns."""
    return placed("rectangle", (half_x, half_y, 1), turns, centre, inner)


def ceiling_lamp(centre, half_x, half_y, radiance):
    return rectangle(centre, half_x, half_y, lamp(radiance), [("x", 180)])


def ball(centre, radius, inner):
    return f'<shape type="sphere">{vector("point", "center", centre)}<float name="radius" value="{radius}"/>{inner}</shape>'


def tube(begin, end, radius, bsdf):
    ends = vector("point", "p0", begin) + vector("point", "p1", end)
    return f'<shape type="cylinder">{ends}<float name="radius" value="{radius}"/>{bsdf}</shape>'


def spot(origin, target, intensity, cutoff, medium=""):
    place = f'<transform name="to_world"><lookat origin="{origin}" target="{target}" up="0,0,1"/></transform>'
    return f'<emitter type="spot">{place}<rgb name="intensity" value="{intensity}"/><float name="cutoff_angle" value="{cutoff}"/>{medium}</emitter>'


def sky(radiance):
    return f'<emitter type="constant"><rgb name="radiance" value="{radiance}"/></emitter>'


def sun(direction, irradiance):
    return f'<emitter type="directional">{vector("vector", "direction", direction)}<rgb name="irradiance" value="{irradiance}"/></emitter>'


def room(width, depth, height, wall=WALL, floor=FLOOR, north_hole=None):
    """Slabs of 0.1 about [0, width] x [0, depth] x [0, height]; `north_hole`: (x, z), (x, z) left open in the wall at y = depth."""
    (x0, z0), (x1, z1) = north_hole or ((width, 0), (width, height))
    north = [(0, x0, 0, height), (x1, width, 0, height), (x0, x1, 0, z0), (x0, x1, z1, height)]
    slabs = [
        box((-0.1, -0.1, -0.1), (width + 0.1, depth + 0.1, 0), floor),
        box((-0.1, -0.1, height), (width + 0.1, depth + 0.1, height + 0.1), wall),
        box((-0.1, 0, 0), (0, depth, height), wall),
        box((width, 0, 0), (width + 0.1, depth, height), wall),
        box((0, -0.1, 0), (width, 0, height), wall),
    ]
    slabs += [box((a, depth, low), (b, depth + 0.1, high), wall) for a, b, low, high in north if b > a and high > low]
    return "".join(slabs)


def scene(origin, target, fov, *parts, integrator="path", medium=""):
    """`integrator`: Mitsuba's, `volpath` where light passes panes or fog; `medium`: a reference to what the camera stands in."""
    camera = f'<lookat origin="{origin}" target="{target}" up="0,0,1"/>'
    film = (
        '<film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="120"/><rfilter type="box"/>'
        '<string name="pixel_format" value="rgb"/></film>'
    )
    sensor = f'<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world">{camera}</transform>{film}{medium}</sensor>'
    head = f'<scene version="3.0.0"><integrator type="{integrator}"><integer name="max_depth" value="-1"/></integrator>'
    return "\n".join([head, sensor, *parts, "</scene>\n"])


# --- scenes ---

WINDOW = ((1.2, 0.9), (2.8, 2.1))
SITE = box((-40, -40, -0.3), (40, 40, -0.1), GROUND)


def kitchen():
    """Lamps below the cupboards, whose fronts shine."""
    front = plastic("0.75,0.72,0.65", 0.2)
    return scene(
        "2.2,0.2,1.6", "1.6,3,1.1", 70, room(4, 3, 2.5), box((0, 2.4, 0), (3.2, 3, 0.88), front),
        box((0, 2.38, 0.88), (3.2, 3, 0.92), plastic("0.12,0.1,0.1", 0.05)), box((0, 2.6, 1.45), (3.2, 3, 2.2), front),
        *(box((x, 2.62, 1.42), (x + 0.7, 2.66, 1.44), lamp("50,44,34")) for x in (0.3, 1.3, 2.3)),
        box((3.25, 2.3, 0), (3.95, 3, 1.9), metal("Cr", 0.15)), tube((0.8, 2.6, 0.92), (0.8, 2.6, 1.1), 0.1, metal("Cu", 0.1)),
        *(ball((1.5 + 0.25 * k, 2.55, 1), 0.08, glass()) for k in range(4)), ball((3, 1.3, 2.2), 0.12, lamp("4,3.6,3")),
    )


def curtain():
    """Sun on folded cloth before a window."""
    folds = [
        rectangle((1.1 + 0.1 * k, 2.9 - 0.03 * (k % 2), 1.5), 0.056, 0.75, CLOTH, [("x", 90), ("z", 25 if k % 2 else -25)])
        for k in range(18)
    ]
    return scene(
        "2,0.3,1.5", "2,3,1.1", 65, sun((0.2, -0.7, -0.6), "30,28,25"), sky("1,1.2,1.6"), SITE, room(4, 3, 2.8, north_hole=WINDOW),
        *folds, box((0.4, 1.8, 0), (1.2, 2.5, 0.6), plastic("0.4,0.2,0.1")), ball((3.1, 2, 0.3), 0.3, diffuse("0.2,0.4,0.7")),
    )


def blinds():
    """Sun and sky between slats, a glossy desk."""
    slats = [box((1.2, 3, 0.95 + 0.07 * k), (2.8, 3.06, 0.955 + 0.07 * k), WALL, [("x", 35)]) for k in range(17)]
    return scene(
        "2,0.3,1.5", "2,3,1", 65, sun((0.3, -0.7, -0.5), "30,28,25"), sky("1,1.2,1.6"), SITE, room(4, 3, 2.8, north_hole=WINDOW),
        *slats, box((1, 1, 0.7), (3, 1.8, 0.75), WOOD), box((1.3, 1.2, 0.75), (1.6, 1.5, 0.8), WALL),
        ball((2.5, 1.5, 0.85), 0.1, metal("Al")),
    )


def desk():
    """A small lamp in a tube of metal."""
    return scene(
        "2.6,0.6,1.7", "1.4,2.4,0.9", 55, room(4, 3, 2.8), box((0.6, 1.9, 0.72), (2.4, 2.8, 0.76), WOOD),
        tube((1.2, 2.5, 1.15), (1.35, 2.35, 1.28), 0.09, metal("Al", 0.3)), ball((1.3, 2.4, 1.24), 0.03, lamp("300,260,200")),
        tube((1.1, 2.6, 0.76), (1.2, 2.5, 1.15), 0.012, metal("Cr", 0.1)), box((1.5, 2.1, 0.76), (1.8, 2.35, 0.78), WALL),
        ball((2, 2.5, 0.84), 0.08, glass()), rectangle((3.99, 1.5, 1.5), 0.5, 0.6, lamp("0.02,0.03,0.06"), [("y", -90)]),
    )


def corridor():
    """Ten lamps over a floor that shines."""
    doors = [box((-0.02, 1 + 6 * k, 0.005), (0.02, 1.9 + 6 * k, 2), WOOD) for k in range(5)]
    return scene(
        "1,0.5,1.6", "1,20,1.3", 60, room(2, 30, 2.5, floor=plastic("0.3,0.32,0.3", 0.08)), *doors,
        *(ceiling_lamp((1, 2 + 3 * k, 2.48), 0.15, 0.5, "12,11.5,10") for k in range(10)),
    )


def candle():
    """A flame on a table, with glass and silver about it."""
    return scene(
        "0,-1.2,0.6", "0,0,0.15", 45, placed("cube", (3, 3, 1.5), (), (0, 0, 0.6), WALL),
        box((-0.6, -0.5, -0.04), (0.6, 0.5, 0), plastic("0.4,0.22,0.1", 0.1)),
        tube((-0.1, 0, 0), (-0.1, 0, 0.2), 0.025, diffuse("0.8,0.75,0.6")), ball((-0.1, 0, 0.235), 0.012, lamp("900,500,180")),
        ball((0.18, -0.05, 0.09), 0.09, glass()), ball((0.02, 0.2, 0.07), 0.07, metal("Ag")), ball((-0.28, -0.12, 0.06), 0.06, glass(0.2)),
    )


def ajar():
    """The lamp is in the next room, the door ajar."""
    return scene(
        "2,0.3,1.5", "2,3,1.0", 65, room(4, 3, 2.8, north_hole=((2.6, 0), (3.4, 2.1))),
        box((2.6, 3.02, 0), (3.36, 3.07, 2.08), WALL, [("z", -12)]), box((0.5, 1.9, 0), (1.1, 2.4, 0.7), plastic("0.4,0.2,0.1")),
        box((-0.1, 3.1, -0.1), (4.1, 7, 0), FLOOR), box((-0.1, 3.1, 2.8), (4.1, 7, 2.9), WALL), box((-0.1, 7, 0), (4.1, 7.1, 2.8), WALL),
        box((-0.2, 3.1, 0), (-0.1, 7, 2.8), WALL), box((4.1, 3.1, 0), (4.2, 7, 2.8), WALL), ceiling_lamp((2, 6, 2.75), 0.3, 0.3, 20),
    )


def shade():
    """A floor lamp whose shade lets light out above and below."""
    return scene(
        "3.6,0.3,1.4", "1,2.6,1.0", 65, room(4, 3, 2.8), tube((1, 2.2, 1.3), (1, 2.2, 1.65), 0.2, WALL),
        ball((1, 2.2, 1.45), 0.04, lamp("400,330,240")), tube((1, 2.2, 0), (1, 2.2, 1.3), 0.015, metal("Cu", 0.1)),
        box((1.8, 2.1, 0), (3.4, 2.9, 0.45), GROUND), ball((2.6, 1.5, 0.25), 0.25, glass()),
    )


def car():
    """Car paint in a studio."""
    return scene(
        "0,-4,1.6", "0,0,0.7", 45, box((-8, -8, -0.1), (8, 8, 0), plastic("0.3", 0.1)), ball((0, 0, 0.8), 0.8, PAINT),
        ball((1.4, -0.6, 0.35), 0.35, glass()), ball((-1.3, -0.7, 0.4), 0.4, metal("Al")), ceiling_lamp((-2, -1, 3.5), 1, 0.3, 12),
        ceiling_lamp((2, -1, 3.5), 1, 0.3, "12,11,9"), sky(0.1),
    )


def product():
    """Glass, lacquer and gold on a sweep, between two large lamps."""
    return scene(
        "0,-2.2,0.9", "0,0,0.3", 35, box((-6, -6, -0.1), (6, 2.5, 0), diffuse(0.75)), box((-6, 2.5, -0.1), (6, 2.6, 5), diffuse(0.75)),
        rectangle((-1.5, -1, 2.2), 0.5, 0.5, lamp(14), [("y", 145)]), rectangle((1.8, -0.6, 1.6), 0.4, 0.6, lamp("9,9,10"), [("y", -120)]),
        tube((0, 0, 0), (0, 0, 0.5), 0.12, glass()), ball((0.4, 0.1, 0.18), 0.18, plastic("0.7,0.1,0.1", 0.1)),
        ball((-0.4, 0.05, 0.18), 0.18, metal("Au", 0.15)), ball((0.18, -0.3, 0.1), 0.1, glass(0.1)), sky(0.05),
    )


def houses(numbers, rows):
    return [
        box((side * 10 - 4, 10 * k, 0), (side * 10 + 4, 10 * k + 9, numbers.uniform(6, 14)), diffuse(f"{numbers.uniform(0.3, 0.7):.2f},0.45,0.4"))
        for side in (-1, 1)
        for k in range(rows)
    ]


def street():
    """Houses, cars and panes in the sun."""
    numbers = random.Random(3)
    panes = [
        rectangle((5.99 * side, 10 * k + 2 + 2.6 * w, 3), 0.8, 1.1, metal("Al", 0.02) if w == 1 else plastic("0.03"), [("z", 90), ("y", -90 * side)])
        for side in (-1, 1)
        for k in range(6)
        for w in range(3)
    ]
    cars = [box((2 if k % 2 else -4, 6 + 9 * k, 0.3), (4 if k % 2 else -2, 10 + 9 * k, 1.3), plastic("0.5,0.05,0.05", 0.1)) for k in range(4)]
    return scene(
        "0,-2,1.7", "0.5,20,3", 60, sun((0.6, 0.3, -0.75), "20,19,17"), sky("0.8,1,1.4"), box((-100, -50, -0.1), (100, 150, 0), GROUND),
        *houses(numbers, 6), *panes, *cars,
    )


def night_street():
    """Lamp posts with globes of glass, headlights, wet ground."""
    posts = [
        tube((x, y, 0), (x, y, 4.4), 0.06, metal("Cr", 0.2)) + ball((x, y, 4.6), 0.2, glass()) + ball((x, y, 4.6), 0.08, lamp("120,90,50"))
        for x in (-4, 4)
        for y in (2, 10, 18, 26)
    ]
    return scene(
        "1,-3,1.7", "0,14,1.6", 60, *posts, spot("-2.3,24,0.7", "-2.3,10,0.2", 150, 20), spot("-0.9,24,0.7", "-0.9,10,0.2", 150, 20),
        *houses(random.Random(4), 4), box((-60, -40, -0.1), (60, 80, 0), plastic("0.12", 0.12)),
        box((-2.6, 24.1, 0.2), (-0.6, 28, 1.5), plastic("0.1,0.1,0.3", 0.1)), sky("0.002,0.003,0.006"),
    )


def glazed():
    """Sun and sky through a pane of glass."""
    return scene(
        "2,0.3,1.5", "2,3,1", 65, sun((0.3, -0.7, -0.5), "30,28,25"), sky("1,1.2,1.6"), SITE, room(4, 3, 2.8, north_hole=WINDOW),
        rectangle((2, 3.05, 1.5), 0.8, 0.6, PANE, [("x", 90)]), box((1, 1, 0.7), (3, 1.8, 0.75), WOOD), box((1.3, 1.2, 0.75), (1.6, 1.5, 0.8), WALL),
        ball((2.5, 1.5, 0.85), 0.1, diffuse("0.2,0.4,0.7")), integrator="volpath",
    )


def hall():
    """Sun through a glass roof between beams, seen from below a gallery."""
    roof = [((-20, -15), (-8, 15)), ((8, -15), (20, 15)), ((-8, 6), (8, 15)), ((-8, -15), (8, -6))]
    return scene(
        "-9,-2,1.7", "-2,4,1.8", 65, sun((-0.3, 0.4, -0.75), "30,28,25"), sky("1,1.2,1.6"), box((-20, -15, -0.1), (20, 15, 0), plastic("0.4,0.38,0.35", 0.15)),
        box((-20, 15, 0), (20, 15.1, 8), WALL), box((-20, -15.1, 0), (20, -15, 8), WALL), box((-20.1, -15, 0), (-20, 15, 8), WALL),
        box((20, -15, 0), (20.1, 15, 8), WALL), *(box((*low, 8), (*high, 8.1), WALL) for low, high in roof), rectangle((0, 0, 8.02), 8, 6, PANE),
        *(box((-8.07 + 2 * k, -6, 8.05), (-7.93 + 2 * k, 6, 8.25), diffuse("0.3")) for k in range(9)), box((-20, -15, 3.4), (-8, 15, 3.7), WALL),
        *(box((-8.5, -12.2 + 6 * k, 0), (-8, -11.8 + 6 * k, 3.4), WALL) for k in range(5)),
        *(box((-3.5 + 3 * k, 3.5, 0), (-2.5 + 3 * k, 4.5, 1), plastic(f"{0.6 - 0.15 * k:.2f},{0.1 + 0.15 * k:.2f},0.4")) for k in range(4)),
        integrator="volpath",
    )


def stage():
    """Three spots in fog."""
    fog, inside = '<ref id="fog"/>', '<ref name="interior" id="fog"/>'
    lights = ((-3, "900,200,100"), (0, "800,800,700"), (3, "100,300,900"))
    return scene(
        "0,-7,1.6", "0,0,1.4", 55,
        '<medium type="homogeneous" id="fog"><rgb name="sigma_t" value="0.08"/><rgb name="albedo" value="0.9"/>'
        '<phase type="hg"><float name="g" value="0.5"/></phase></medium>',
        box((-5, -8, -0.1), (5, 8, 0), plastic("0.1,0.08,0.06", 0.1)), box((-5, 8, 0), (5, 8.1, 6), diffuse("0.05")),
        *(spot(f"{x},-1,5.6", f"{x / 10},1,0.5", colour, 14, fog) for x, colour in lights), tube((0, 1, 0), (0, 1, 1.5), 0.25, diffuse("0.6,0.5,0.4")),
        ball((0, 1, 1.7), 0.2, diffuse("0.7,0.5,0.4")), box((-5.5, -8.5, -0.5), (5.5, 8.5, 6.5), '<bsdf type="null"/>' + inside),
        integrator="volpath", medium=fog,
    )


SCENES = {function.__name__: function for function in
          (kitchen, curtain, blinds, desk, corridor, candle, ajar, shade, car, product, street, night_street, glazed, hall, stage)}


def write(folder, name):
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.xml"
    path.write_text(SCENES[name](), encoding="ascii")
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"all, or some of {', '.join(SCENES)}")
    arguments = parser.parse_args()
    if unknown := set(arguments.scenes) - set(SCENES):
        parser.error(f"unknown scene {', '.join(sorted(unknown))}, expected {', '.join(SCENES)}")
    for name in arguments.scenes or SCENES:
        print(write(arguments.folder, name))


if __name__ == "__main__":
    main()

"""Scenes of meters as XML, and the closed forms of what they read (scripts/oracles.py)."""
import math

import numpy as np

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

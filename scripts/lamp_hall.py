#!/usr/bin/env python3
"""Writes a scene of many lamps to stdout: a hall of N x N m, 4 m high, with a lamp for each square metre of the ceiling; with
--rooms walls divide it into rooms of 10 x 10 m. The camera stands in one corner. Figures: docs/method/learning.md.

usage: lamp_hall.py N [--rooms]"""
import argparse

HEAD = """<?xml version="1.0"?>
<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="-1"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="60"/>
        <transform name="to_world"><lookat origin="2,2,1.7" target="8,9,1" up="0,0,1"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="160"/><integer name="height" value="120"/><rfilter type="box"/>
        </film>
    </sensor>
    <bsdf type="diffuse" id="grey"><rgb name="reflectance" value="0.6"/></bsdf>"""
LAMP = '<emitter type="area"><rgb name="radiance" value="10"/></emitter>'


def shape(kind, scale, translate, rotate="", emitter=""):
    return (f'    <shape type="{kind}"><transform name="to_world"><scale x="{scale[0]}" y="{scale[1]}" z="{scale[2]}"/>{rotate}'
            f'<translate x="{translate[0]}" y="{translate[1]}" z="{translate[2]}"/></transform><ref id="grey"/>{emitter}</shape>')


def turn(axis, angle):
    return f'<rotate {axis}="1" angle="{angle}"/>'


def shapes(side, rooms):
    middle = side / 2
    yield shape("rectangle", (middle, middle, 1), (middle, middle, 0))
    yield shape("rectangle", (middle, middle, 1), (middle, middle, 4), turn("x", 180))
    for x, angle in ((0, 90), (side, -90)):
        yield shape("rectangle", (2, middle, 1), (x, middle, 2), turn("y", angle))
    for y, angle in ((0, -90), (side, 90)):
        yield shape("rectangle", (middle, 2, 1), (middle, y, 2), turn("x", angle))
    for x in range(side):
        for y in range(side):
            yield shape("rectangle", (0.1, 0.1, 1), (x + 0.5, y + 0.5, 3.9), turn("x", 180), LAMP)
    for k in range(5):
        yield shape("cube", (0.3, 0.3, 0.5), (4 + 2 * k, 6 + k, 0.5))
    for wall in range(10, side, 10) if rooms else ():
        yield shape("cube", (0.05, middle, 2), (wall, middle, 2))
        yield shape("cube", (middle, 0.05, 2), (middle, wall, 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("side", type=int, metavar="N", help="metres, and lamps in a row")
    parser.add_argument("--rooms", action="store_true")
    arguments = parser.parse_args()
    print("\n".join([HEAD, *shapes(arguments.side, arguments.rooms), "</scene>"]))


if __name__ == "__main__":
    main()

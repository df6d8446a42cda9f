#!/usr/bin/env python3
"""Draws the diagrams of the documents: docs/figures/pass.svg (the flow of a pass), classes.svg (the four classes of light), split.svg (the
split of a lobe and of a phase function). Needs nothing but Python; the same input gives the same bytes.

The curves are computed: Lambert plus a Phong lobe, and Henyey & Greenstein with g = 0.7 cut at the level 0.1 per sr."""

import argparse
import math
from pathlib import Path

FIGURES = Path(__file__).resolve().parent.parent / "docs" / "figures"
INK, GREY, DIFFUSE, QUASI, SPECULAR, LIGHT, PAPER = "#1b1b1b", "#6b6b6b", "#0072b2", "#d55e00", "#009e73", "#e69f00", "#ffffff"


class Drawing:
    """An SVG of so many units; lengths are in pixels at its natural size."""

    def __init__(self, width, height, title):
        self.width, self.height, self.title = width, height, title
        self.parts = []

    def add(self, text):
        self.parts.append(text)

    def line(self, points, colour=INK, width=1.5, arrow=False, dashed=False, fill="none"):
        path = " ".join(f"{'M' if i == 0 else 'L'}{x:.1f},{y:.1f}" for i, (x, y) in enumerate(points))
        end = f' marker-end="url(#arrow-{colour[1:]})"' if arrow else ""
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        self.add(f'<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}"{dash}{end}/>')

    def area(self, points, colour, opacity=0.35):
        path = " ".join(f"{'M' if i == 0 else 'L'}{x:.1f},{y:.1f}" for i, (x, y) in enumerate(points))
        self.add(f'<path d="{path}Z" fill="{colour}" fill-opacity="{opacity}" stroke="{colour}"/>')

    def box(self, x, y, width, height, colour=INK, fill=PAPER):
        self.add(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{fill}" stroke="{colour}" stroke-width="1.5"/>')

    def dot(self, x, y, radius, colour):
        self.add(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{colour}"/>')

    def text(self, x, y, words, size=14, colour=INK, anchor="start", bold=False, mono=False):
        family = "DejaVu Sans Mono, monospace" if mono else "DejaVu Sans, Arial, sans-serif"
        weight = ' font-weight="bold"' if bold else ""
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.add(f'<text x="{x}" y="{y}" font-family="{family}" font-size="{size}" fill="{colour}" text-anchor="{anchor}"{weight}>{words}</text>')

    def save(self, folder, name):
        arrows = "".join(
            f'<marker id="arrow-{c[1:]}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
            f'<path d="M0,0 L10,5 L0,10 Z" fill="{c}"/></marker>'
            for c in (INK, GREY, DIFFUSE, QUASI, SPECULAR, LIGHT)
        )
        body = "\n".join(self.parts)
        (folder / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" height="{self.height}" role="img">\n'
            f"<title>{self.title}</title>\n<defs>{arrows}</defs>\n"
            f'<rect width="{self.width}" height="{self.height}" fill="{PAPER}"/>\n{body}\n</svg>\n'
        )


def draw_pass(folder):
    d = Drawing(880, 400, "The flow of a pass, with photons stored (above) and with camera points stored (below)")

    def row(y, name, stages):
        d.text(20, y - 14, name, 15, bold=True, mono=True)
        for i, (title, what, files, colour) in enumerate(stages):
            x = 20 + i * 215
            d.box(x, y, 190, 96, colour)
            d.text(x + 12, y + 26, title, 15, colour, bold=True)
            for k, line in enumerate(what):
                d.text(x + 12, y + 47 + 17 * k, line, 12)
            d.text(x + 12, y + 87, files, 11, GREY, mono=True)
            if i < len(stages) - 1:
                d.line([(x + 192, y + 48), (x + 213, y + 48)], arrow=True)

    row(60, "--map photons (default)", [
        ("1 Photons", ["emit, trace, store", "by class of light"], "photon_trace.cl", LIGHT),
        ("2 Index", ["count, prefix sum,", "place, move"], "photon_map.cl", GREY),
        ("3 Camera paths", ["trace, gather photons", "as the law says"], "camera_paths.cl", DIFFUSE),
        ("4 Film", ["sums, squares, bias", "by component"], "film.clh", INK),
    ])
    row(230, "--map camera", [
        ("1 Camera paths", ["trace, store points", "where light is taken"], "camera_point_paths.cl", DIFFUSE),
        ("2 Index", ["count, prefix sum,", "place"], "camera_point_map.cl", GREY),
        ("3 Photons", ["trace, splat to points", "about every hit"], "photon_splat.cl", LIGHT),
        ("4 Film", ["own light + splats", "of each pixel"], "film.clh", INK),
    ])
    d.text(20, 366, "Every pass is numbered and seeded by its number. The image is the mean of all passes; their scatter is its noise.", 13, GREY)
    d.save(folder, "pass.svg")


def draw_classes(folder):
    d = Drawing(880, 400, "The four classes of light, by what a photon has met since it left the emitter")
    panels = [
        ("direct", "in E0", [], "nothing"),
        ("caustic", "in E0", ["s", "s"], "specular events only"),
        ("quasi-caustic", "Eqc", ["q", "s"], "at least one quasi-specular event,\nno genuine diffuse one"),
        ("diffuse", "Ei", ["q", "d"], "at least one\ngenuine diffuse event"),
    ]
    colours = {"s": SPECULAR, "q": QUASI, "d": DIFFUSE}
    for i, (name, symbol, events, words) in enumerate(panels):
        x = 20 + i * 215
        d.box(x, 20, 200, 268)
        d.text(x + 12, 46, name, 16, bold=True)
        d.text(x + 188, 46, symbol, 15, GREY, anchor="end")
        d.add(f'<circle cx="{x + 34}" cy="80" r="9" fill="{LIGHT}" stroke="{INK}"/>')
        target = (x + 150, 255)
        d.line([(x + 15, 262), (x + 185, 262)], GREY, 3)
        corners = {0: [], 2: [(x + 165, 135), (x + 45, 185)]}[len(events)]
        points = [(x + 43, 86), *corners, target]
        for k in range(len(points) - 1):
            colour = INK if k == 0 else colours[events[k - 1]]
            d.line([points[k], points[k + 1]], colour, 2, arrow=True)
        for (cx, cy), event in zip(corners, events):
            side = 1 if cx > x + 100 else -1
            if event == "q":
                d.area([(cx, cy), (cx - side * 58, cy + 14), (cx - side * 66, cy + 27), (cx - side * 54, cy + 36)], QUASI)
            if event == "d":
                d.area([(cx, cy)] + [(cx + 26 * (1 + math.cos(a)), cy + 26 * math.sin(a)) for a in [k * math.pi / 12 - math.pi for k in range(25)]], DIFFUSE, 0.25)
            d.line([(cx + side * 3, cy - 22), (cx + side * 3, cy + 22)], colours[event], 4)
        d.dot(*target, 4, INK)
        for k, line in enumerate(words.split("\n")):
            d.text(x + 100, 312 + 17 * k, line, 12, anchor="middle")
    for k, (event, name) in enumerate([("s", "specular (delta): mirror, glass"), ("q", "quasi-specular: narrow lobe"), ("d", "genuine diffuse")]):
        x = 30 + k * 270
        d.line([(x, 374), (x + 26, 374)], colours[event], 4)
        d.text(x + 36, 379, name, 13)
    d.save(folder, "classes.svg")


def polar(x, y, value, angles, scale, axis=math.pi / 2):
    """Points at these angles from `axis`, as far away as the function says; y runs down."""
    return [(x + scale * value(a) * math.cos(axis - a), y - scale * value(a) * math.sin(axis - a)) for a in angles]


def henyey_greenstein(g, cosine):
    return (1 - g * g) / (4 * math.pi * (1 + g * g - 2 * g * cosine) ** 1.5)


def draw_split(folder):
    d = Drawing(880, 430, "The split of a lobe and of a phase function into a genuine diffuse and a quasi-specular part")
    # A bsdf: Lambert plus Phong about the mirror direction at 40 degrees.
    d.text(30, 40, "A bsdf: lobe by lobe", 16, bold=True)
    x, y, tilt, scale = 210, 320, math.radians(40), 130
    d.line([(40, y), (400, y)], GREY, 3)
    angles = [math.radians(k) / 2 for k in range(-180, 181)]
    d.area(polar(x, y, lambda a: 0.62 * math.cos(a), angles, scale), DIFFUSE)
    d.area(polar(x, y, lambda a: 1.7 * max(0.0, math.cos(a - tilt)) ** 60 if math.cos(a - tilt) > 0 else 0.0, angles, scale), QUASI)
    start = (x - 190 * math.sin(tilt), y - 190 * math.cos(tilt))
    d.line([start, (x - 3, y - 4)], INK, 2, arrow=True)
    d.line([(x, y), (x, y - 205)], GREY, 1, dashed=True)
    d.text(start[0] - 6, start[1] - 8, "light", 13, anchor="middle")
    d.text(40, 352, "F_d: Lambert lobe,", 13, DIFFUSE)
    d.text(40, 370, "genuine diffuse", 13, DIFFUSE)
    d.text(250, 352, "F_qs: narrow lobe,", 13, QUASI)
    d.text(250, 370, "followed like a mirror", 13, QUASI)
    # A phase function, value over angle.
    d.text(470, 40, "A phase function: by a level c", 16, bold=True)
    left, right, bottom, top, g, level, highest = 500, 850, 320, 90, 0.7, 0.1, 0.5
    tox = lambda degrees: left + (right - left) * (degrees + 180) / 360
    toy = lambda p: bottom - (bottom - top) * min(p, highest) / highest
    degrees = list(range(-180, 181))
    value = {a: henyey_greenstein(g, math.cos(math.radians(a))) for a in degrees}
    low = [(tox(a), toy(min(value[a], level))) for a in degrees]
    peak = [a for a in degrees if value[a] >= level]
    d.area([(left, bottom)] + low + [(right, bottom)], DIFFUSE)
    d.area([(tox(a), toy(value[a])) for a in peak] + [(tox(a), toy(level)) for a in reversed(peak)], QUASI)
    d.line([(left, bottom), (right + 6, bottom)])
    d.line([(left, bottom), (left, top - 8)])
    d.line([(left, toy(level)), (right, toy(level))], INK, 1, dashed=True)
    d.text(left - 8, toy(level) + 5, "c", 14, anchor="end")
    d.text(left - 8, top - 14, "p, per sr", 12, GREY)
    for a in (-180, -90, 0, 90, 180):
        d.text(tox(a), bottom + 18, f"{a}°", 12, GREY, anchor="middle")
    d.text(right, bottom + 36, "scattering angle", 12, GREY, anchor="end")
    d.text(left, 370, "p_d = min(p, c): genuine diffuse", 13, DIFFUSE)
    d.text(left, 390, "p_qs = max(p - c, 0): the peak, quasi-specular", 13, QUASI)
    d.text(left, 412, "Henyey & Greenstein, g = 0.7, c = 0.1; the top (1.5) is cut", 12, GREY)
    d.save(folder, "split.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=FIGURES, help="where to (default docs/figures)")
    folder = parser.parse_args().folder
    draw_pass(folder)
    draw_classes(folder)
    draw_split(folder)


if __name__ == "__main__":
    main()

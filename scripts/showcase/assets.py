#!/usr/bin/env python3
"""Meshes and textures of scenes/showcase/. usage: assets.py FOLDER"""
import pathlib
import sys

import meshes
import smoke
import textures


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("parquet", "rug", "painting"):
        textures.write_png(folder / f"{name}.png", getattr(textures, name)())
    textures.write_hdr(folder / "studio.hdr", textures.studio())
    smoke.write(folder / "smoke.vol")
    meshes.torus_knot(folder / "knot.obj")
    # Points (radius, height), the outside on the right on the way along the profile.
    table = [(1e-4, 0.0), (0.26, 0.0), (0.26, 0.012), (0.05, 0.05), (0.035, 0.12), (0.035, 0.6), (0.09, 0.71), (0.55, 0.715), (0.56, 0.73),
             (0.555, 0.748), (0.545, 0.75), (1e-4, 0.75)]
    outside = meshes.smooth([(1e-4, 0.0), (0.055, 0.0), (0.075, 0.03), (0.085, 0.1), (0.06, 0.2), (0.035, 0.27), (0.05, 0.33)], 12)
    inside = meshes.smooth([(0.046, 0.33), (0.031, 0.27), (0.056, 0.2), (0.08, 0.1), (0.07, 0.035), (0.05, 0.012), (1e-4, 0.01)], 12)
    bowl_outside = meshes.smooth([(1e-4, 0.0), (0.05, 0.0), (0.1, 0.02), (0.15, 0.07)], 12)
    bowl_inside = meshes.smooth([(0.147, 0.071), (0.098, 0.024), (0.05, 0.005), (1e-4, 0.005)], 12)
    cup_outside = meshes.smooth([(1e-4, 0.0), (0.028, 0.0), (0.038, 0.03), (0.042, 0.085)], 12)
    cup_inside = meshes.smooth([(0.039, 0.086), (0.035, 0.032), (0.024, 0.006), (1e-4, 0.005)], 12)
    shade = meshes.smooth([(0.2, 0.0), (0.17, 0.1), (0.08, 0.22), (0.012, 0.28)], 12)
    for name, profile in (("table", meshes.bevelled(table)), ("vase", [*outside, *inside]), ("bowl", [*bowl_outside, *bowl_inside]),
                          ("cup", [*cup_outside, *cup_inside]), ("shade", shade)):
        meshes.lathe(folder / f"{name}.obj", profile)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

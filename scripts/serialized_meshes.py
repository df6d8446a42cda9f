"""Writes tests/data/two_meshes.serialized, the meshes of tests/scenes/compare/serialized.xml: python3 scripts/serialized_meshes.py.

A wavy patch in double precision with normals and texture coordinates, and a tent in single precision without.
"""
import pathlib
import struct
import zlib

import numpy as np

HAS_NORMALS, HAS_UVS, SINGLE, DOUBLE = 0x0001, 0x0002, 0x1000, 0x2000
FILE = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data" / "two_meshes.serialized"


def mesh(name, flags, positions, triangles, normals=(), uvs=()):
    scalar = "<f8" if flags & DOUBLE else "<f4"
    body = struct.pack("<I", flags) + name.encode() + b"\0" + struct.pack("<QQ", len(positions), len(triangles))
    body += b"".join(np.array(values, scalar).tobytes() for values in (positions, normals, uvs))
    return struct.pack("<HH", 0x041C, 4) + zlib.compress(body + np.array(triangles, "<u4").tobytes())


def patch(side=12):
    v, u = (grid.ravel() for grid in np.mgrid[0:1:side * 1j, 0:1:side * 1j])
    x, y = 2 * u - 1, 2 * v - 1
    normals = np.stack([0.5 * np.sin(2 * x) * np.cos(2 * y), 0.5 * np.cos(2 * x) * np.sin(2 * y), np.ones_like(x)], 1)
    corners = [j * side + i for j in range(side - 1) for i in range(side - 1)]
    triangles = [t for a in corners for t in ((a, a + 1, a + side + 1), (a, a + side + 1, a + side))]
    return mesh("patch", DOUBLE | HAS_NORMALS | HAS_UVS, np.stack([x, y, 0.25 * np.cos(2 * x) * np.cos(2 * y)], 1), triangles,
                normals / np.linalg.norm(normals, axis=1, keepdims=True), np.stack([u, v], 1))


def tent():
    return mesh("tent", SINGLE, [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 0.4)], [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])


if __name__ == "__main__":
    meshes = [patch(), tent()]
    FILE.write_bytes(b"".join(meshes) + struct.pack("<QQI", 0, len(meshes[0]), len(meshes)))

"""Writes cloud.vol and tint.vol beside this file: small grids for the scenes with heterogeneous media."""
import pathlib
import struct

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent


def write(name, values, lower=(0, 0, 0), upper=(1, 1, 1)):
    """`values` by z, y, x and channel, as float32 of a .vol file of version 3."""
    z, y, x, channels = values.shape
    header = struct.pack("<3sBiiiii6f", b"VOL", 3, 1, x, y, z, channels, *lower, *upper)
    (FOLDER / name).write_bytes(header + np.ascontiguousarray(values, "<f4").tobytes())


def main():
    axis = (np.arange(9) + 0.5) / 9 - 0.5
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    ball = np.clip(1 - (x * x + y * y + z * z) / 0.25, 0, None)
    cloud = 6 * ball * (0.4 + 0.6 * np.sin(9 * x + 4 * y) ** 2) * (1 + np.cos(7 * z))
    write("cloud.vol", cloud[..., None], (-1, -1, -1), (1, 1, 1))
    rng = np.random.default_rng(1)
    write("tint.vol", 0.35 + 0.6 * rng.random((3, 4, 5, 3)))


if __name__ == "__main__":
    main()

"""A plume of smoke that rises, widens and breaks up, as a file of voxels (.vol, version 3)."""
import struct

import numpy as np

SEED, OCTAVES = 5, 4


def smooth_noise(rng, shape, cells):
    """Values in [-1, 1] at random places of a lattice, interpolated smoothly."""
    lattice = rng.uniform(-1, 1, [c + 2 for c in cells])
    for axis, (n, c) in enumerate(zip(shape, cells)):
        place = (np.arange(n) + 0.5) / n * c
        low = place.astype(int)
        f = place - low
        f = (f * f * (3 - 2 * f)).reshape([-1 if a == axis else 1 for a in range(3)])
        lattice = (1 - f) * np.take(lattice, low, axis) + f * np.take(lattice, low + 1, axis)
    return lattice


def turbulence(rng, shape, cells):
    """Octaves of noise, each half as strong as the one before."""
    return sum(smooth_noise(rng, shape, [c << k for c in cells]) / 2**k for k in range(OCTAVES))


def plume(n):
    """Density by z, y, x in a box of 1 x 1 x 2, up is z."""
    shape = (2 * n, n, n)
    rng = np.random.default_rng(SEED)
    z, y, x = np.meshgrid((np.arange(2 * n) + 0.5) / (2 * n), *2 * [(np.arange(n) + 0.5) / n - 0.5], indexing="ij")
    wander = [0.11 * z * turbulence(rng, shape, (5, 2, 2)) for _ in range(2)]
    swirl = 5 * z
    x, y = x - wander[0] - 0.05 * z * np.cos(swirl), y - wander[1] - 0.05 * z * np.sin(swirl)
    width = 0.1 + 0.28 * z**0.8
    body = np.exp(-0.5 * (x * x + y * y) / (0.45 * width) ** 2)
    wisps = np.clip(0.5 + 0.9 * turbulence(rng, shape, (8, 4, 4)), 0, None)
    fade = np.clip(z / 0.04, 0, 1) * np.clip((1 - z) / 0.25, 0, 1)
    density = np.clip(body * wisps - 0.06, 0, None) * fade * (0.1 / width) ** 0.6
    return density / np.percentile(density[density > 0], 97)


def write(path, voxels=64):
    """`voxels` in a row across the plume, twice as many along it."""
    header = struct.pack("<3sBiiiii6f", b"VOL", 3, 1, voxels, voxels, 2 * voxels, 1, 0, 0, 0, 1, 1, 1)
    path.write_bytes(header + plume(voxels).astype("<f4").tobytes())

"""Textures computed from noise, and the files that hold them: PNG (8 bits, sRGB) and Radiance HDR (RGBE, linear)."""
import struct
import zlib

import numpy as np


def write_png(path, linear):
    """`linear`: rows x columns x 3 in [0, 1]."""
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    pixels = np.round(255 * np.clip(encoded, 0, 1)).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def write_hdr(path, radiance):
    """`radiance`: rows x columns x 3, linear, at least 0."""
    largest = radiance.max(axis=2)
    mantissa, exponent = np.frexp(largest)
    scale = np.where(largest > 1e-32, mantissa * 256 / np.maximum(largest, 1e-32), 0)
    pixels = np.concatenate([radiance * scale[..., None], np.where(largest > 1e-32, exponent + 128, 0)[..., None]], axis=2)
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % radiance.shape[:2])
        file.write(np.floor(pixels).astype(np.uint8).tobytes())


def noise(rows, columns, cells, random):
    """Smooth noise in [0, 1] that repeats: values on a grid of cells[0] x cells[1], joined by cubics."""
    grid = random.random(cells)
    y, x = np.arange(rows) * cells[0] / rows, np.arange(columns) * cells[1] / columns
    i, j = y.astype(int), x.astype(int)
    fy, fx = (y - i)[:, None], (x - j)[None, :]
    fy, fx = fy * fy * (3 - 2 * fy), fx * fx * (3 - 2 * fx)

    def value(di, dj):
        return grid[np.ix_((i + di) % cells[0], (j + dj) % cells[1])]

    return (value(0, 0) * (1 - fx) + value(0, 1) * fx) * (1 - fy) + (value(1, 0) * (1 - fx) + value(1, 1) * fx) * fy


def parquet(size=1024, boards=8, seed=1):
    """Boards of oak: each with a shade of its own, grain along it, and dark joints."""
    random = np.random.default_rng(seed)
    height = size // boards
    image = np.zeros((size, size, 3))
    dark, light = np.array([0.16, 0.075, 0.03]), np.array([0.42, 0.24, 0.11])
    for board in range(boards):
        grain = 0.5 * noise(height, size, (height // 4, 6), random) + 0.3 * noise(height, size, (height // 2, 24), random)
        rings = 0.5 + 0.5 * np.sin(40 * noise(height, size, (3, 2), random))
        shade = 0.25 * random.random() + 0.55 * grain + 0.2 * rings
        ends = random.integers(0, size, 2)
        strip = dark + (light - dark) * np.clip(shade, 0, 1)[..., None]
        strip[:2] *= 0.35
        for end in ends:
            strip[:, end : end + 2] *= 0.35
        image[board * height : (board + 1) * height] = strip
    return image


def rug(size=512, seed=2):
    """A woven rug: bands and diamonds in three colours, with the threads' shade."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:size, 0:size] / size
    diamonds = np.abs((6 * x) % 1 - 0.5) + np.abs((6 * y) % 1 - 0.5)
    colours = np.array([[0.35, 0.05, 0.04], [0.55, 0.42, 0.25], [0.06, 0.09, 0.2]])
    edge = np.minimum(np.minimum(x, 1 - x), np.minimum(y, 1 - y))
    index = np.where(edge < 0.05, 2, np.where(edge < 0.09, 1, np.where(diamonds < 0.28, 1, np.where(diamonds < 0.4, 2, 0))))
    threads = 0.85 + 0.15 * np.sin(np.pi * size / 2 * x) * np.sin(np.pi * size / 2 * y)
    return np.clip(colours[index] * (threads * (0.8 + 0.4 * noise(size, size, (64, 64), random)))[..., None], 0, 1)


def painting(size=512, seed=3):
    """Hills in mist, from near to far."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:size, 0:size] / size
    image = np.array([0.75, 0.6, 0.45]) * (1 - y[..., None]) + np.array([0.85, 0.75, 0.6]) * y[..., None]
    sun = np.hypot(x - 0.68, y - 0.3) < 0.08
    image[sun] = [0.9, 0.35, 0.15]
    for layer in range(5):
        ridge = 0.42 + 0.11 * layer - 0.16 * noise(1, size, (1, 4 + layer), random)[0] - 0.04 * noise(1, size, (1, 24), random)[0]
        image[y > ridge[None, :]] = np.array([0.5, 0.5, 0.55]) * 0.62**layer + np.array([0.02, 0.05, 0.04])
    return image[::-1]  # its first row is at v = 0, the lower side


def studio(rows=512):
    """Surroundings of a photographer's table, latitude by longitude: a dim room, one large soft lamp, a strip, a small bright one."""
    latitude = np.pi * (np.arange(rows) + 0.5) / rows
    longitude = 2 * np.pi * (np.arange(2 * rows) + 0.5) / (2 * rows)
    y, x = np.meshgrid(latitude, longitude, indexing="ij")
    image = np.array([0.10, 0.12, 0.16]) * (0.4 + 0.6 * np.cos(y / 2) ** 2)[..., None]

    def lamp(middle, width, height, colour):
        inside = (np.abs((x - middle[0] + np.pi) % (2 * np.pi) - np.pi) < width) & (np.abs(y - middle[1]) < height)
        image[inside] = colour

    lamp((1.0, 0.95), 0.45, 0.35, [9, 8.4, 7.5])
    lamp((4.2, 1.1), 0.08, 0.5, [10, 13, 18])
    lamp((2.6, 0.6), 0.03, 0.03, [2500, 2200, 1700])
    return image

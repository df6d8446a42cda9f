"""Triangle meshes with normals and texture coordinates, written as OBJ files."""
import numpy as np


def write_obj(path, positions, normals, uvs, closed=False):
    """A grid of rows x columns points as quadrilaterals; `closed`: the last row meets the first. Columns always close."""
    rows, columns = positions.shape[:2]
    with open(path, "w", encoding="ascii") as file:
        for name, values in (("v", positions), ("vn", normals), ("vt", uvs)):
            for value in values.reshape(-1, values.shape[-1]):
                file.write(name + "".join(f" {x:.6g}" for x in value) + "\n")
        for i in range(rows if closed else rows - 1):
            for j in range(columns):
                corners = [(i, j), (i, (j + 1) % columns), ((i + 1) % rows, (j + 1) % columns), ((i + 1) % rows, j)]
                numbers = [1 + row * columns + column for row, column in corners]
                for triangle in ((0, 1, 2), (0, 2, 3)):
                    file.write("f" + "".join(f" {numbers[k]}/{numbers[k]}/{numbers[k]}" for k in triangle) + "\n")


def smooth(profile, steps):
    """A Catmull-Rom curve through the points of `profile`, `steps` points for each of its pieces."""
    points = np.array([2 * np.array(profile[0]) - profile[1], *profile, 2 * np.array(profile[-1]) - profile[-2]], float)
    curve = []
    for k in range(1, len(points) - 2):
        a, b, c, d = points[k - 1 : k + 3]
        for t in np.arange(steps) / steps:
            curve.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    return np.array([*curve, points[-2]])


def bevelled(profile, width=0.002):
    """The polygon `profile` with each corner cut off at `width`, so that its sides keep normals of their own."""
    points = [np.asarray(point, float) for point in profile]
    result = [points[0]]
    for before, corner, after in zip(points, points[1:], points[2:]):
        for other in (before, after):
            way = other - corner
            result.append(corner + way * min(width / np.linalg.norm(way), 0.4))
    return np.array([*result, points[-1]])


def lathe(path, profile, sectors=96):
    """The points (radius, height) of `profile` turned about the z axis; the outside is on the right of the profile's way up."""
    profile = np.asarray(profile, float)
    tangent = np.gradient(profile, axis=0)
    outward = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-12)
    angle = 2 * np.pi * np.arange(sectors) / sectors

    def turned(values):
        return np.stack([values[:, :1] * np.cos(angle), values[:, :1] * np.sin(angle), values[:, 1:] * np.ones(sectors)], axis=2)

    v = np.linspace(0, 1, len(profile))
    uvs = np.stack(np.broadcast_arrays(angle / (2 * np.pi), v[:, None]), axis=2)
    write_obj(path, turned(profile), turned(outward), uvs)


def torus_knot(path, p=2, q=3, radius=1.0, tube=0.3, steps=400, sectors=48):
    """A tube about the curve that winds p times about the axis of a torus and q times through its hole."""
    t = 2 * np.pi * np.arange(steps) / steps

    def curve(s):
        r = radius * (1 + 0.45 * np.cos(q * s))
        return np.stack([r * np.cos(p * s), r * np.sin(p * s), 0.5 * radius * np.sin(q * s)], axis=-1)

    h = 1e-4
    tangent = curve(t + h) - curve(t - h)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    across = np.cross(tangent, curve(t) * [1, 1, 0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(tangent, across)
    angle = 2 * np.pi * np.arange(sectors) / sectors
    normals = across[:, None] * np.cos(angle)[None, :, None] + other[:, None] * np.sin(angle)[None, :, None]
    uvs = np.stack(np.broadcast_arrays(angle[None, :] / (2 * np.pi), t[:, None] / (2 * np.pi)), axis=2)
    write_obj(path, curve(t)[:, None] + tube * normals, normals, uvs, closed=True)

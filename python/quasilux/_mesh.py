"""Meshes from arrays, by files that live as long as a scene is loaded."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Columns = list[tuple[Sequence[str], NDArray[Any]]]
"""Names of properties, and as many values in each row."""


def write_mesh(path: Path, entries: Mapping[str, Any]) -> dict[str, Any]:
    """Writes a PLY file of ``vertices``, ``faces`` and what else there is of ``normals``, ``uv``, ``vertex_NAME``, ``face_NAME``. Returns the
    other entries. ValueError: what is wrong with which array."""
    rest = dict(entries)
    vertices = _array(rest, "vertices", 3)
    faces = _faces(rest, len(vertices))
    vertex_columns: Columns = [("xyz", vertices)]
    for name, properties in (("normals", ("nx", "ny", "nz")), ("uv", ("u", "v"))):
        if rest.get(name) is not None:
            vertex_columns.append((properties, _array(rest, name, len(properties), len(vertices))))
        rest.pop(name, None)
    face_columns: Columns = []
    for name in [name for name in rest if re.match("(vertex|face)_", str(name)) and name != "face_normals"]:
        kind, _, attribute = name.partition("_")
        columns, count = (vertex_columns, len(vertices)) if kind == "vertex" else (face_columns, len(faces))
        values = _array(rest, name, (1, 3), count)
        columns.append(([f"{attribute}_{letter}" for letter in "xyz"[: values.shape[1]]], values))
    _write(path, vertex_columns, faces, face_columns)
    return rest


def _array(rest: dict[str, Any], name: str, widths: int | tuple[int, ...], count: int | None = None) -> NDArray[Any]:
    """Takes rows of finite numbers out of ``rest``."""
    if rest.get(name) is None:
        raise ValueError(f"a mesh needs '{name}', an array.")
    widths = widths if isinstance(widths, tuple) else (widths,)
    try:
        array = np.asarray(rest.pop(name), dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"'{name}' is no array of numbers.") from None
    if array.ndim == 1 and 1 in widths:
        array = array[:, None]
    if array.ndim != 2 or array.shape[1] not in widths or (count is not None and len(array) != count):
        wanted = " or ".join(f"({'n' if count is None else count}, {width})" for width in widths)
        raise ValueError(f"'{name}' has the shape {array.shape}; expected {wanted}.")
    if not np.isfinite(array).all():
        row = int(np.argmin(np.isfinite(array).all(axis=1)))
        raise ValueError(f"'{name}' is not finite in row {row}.")
    return array


def _faces(rest: dict[str, Any], vertices: int) -> NDArray[Any]:
    if rest.get("faces") is None:
        raise ValueError("a mesh needs 'faces', an array of indices into 'vertices'.")
    faces = np.asarray(rest.pop("faces"))
    if faces.ndim != 2 or not 3 <= faces.shape[1] <= 255 or faces.dtype.kind not in "iu":
        raise ValueError(f"'faces' is an array of {faces.dtype} of the shape {faces.shape}; expected whole numbers of the shape (m, 3).")
    if len(faces) == 0:
        raise ValueError("'faces' has no rows.")
    wrong = ((faces < 0) | (faces >= vertices)).any(axis=1)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ValueError(f"'faces' has {faces[row].tolist()} in row {row}; there are {vertices} vertices, counted from 0.")
    return faces.astype("<u4")


def _write(path: Path, vertex_columns: Columns, faces: NDArray[Any], face_columns: Columns) -> None:
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertex_columns[0][1])}"]
    header += [f"property double {name}" for names, _ in vertex_columns for name in names]
    header += [f"element face {len(faces)}", "property list uchar uint vertex_indices"]
    header += [f"property double {name}" for names, _ in face_columns for name in names]
    vertices = np.hstack([values for _, values in vertex_columns]).astype("<f8")
    corners = faces.shape[1]
    rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<u4", (corners,)), ("values", "<f8", (sum(v.shape[1] for _, v in face_columns),))])
    rows["count"] = corners
    rows["corners"] = faces
    if face_columns:
        rows["values"] = np.hstack([values for _, values in face_columns])
    with open(path, "wb") as file:
        file.write(("\n".join(header) + "\nend_header\n").encode())
        file.write(np.ascontiguousarray(vertices).tobytes())
        file.write(rows.tobytes())

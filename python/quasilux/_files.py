"""Pictures and volumes from arrays, by files that live as long as a scene is loaded."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._values import array_of, short


def write_picture(path: Path, picture: Any, is_raw: bool) -> Path:
    """Writes an array (height, width) or (height, width, 1 to 4), or a bitmap of Mitsuba; the first row is the upper one, and alpha is left
    out. Returns the file, whose ending says its format. ValueError: what is wrong.

    Floats are linear. Whole numbers are sRGB, unless the bitmap says that they are not, or the texture is raw."""
    array = _array(picture, "(height, width) or (height, width, channels)")
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or array.shape[2] not in (1, 2, 3, 4) or array.size == 0:
        raise ValueError(f"has the shape {array.shape}; expected (height, width) or (height, width, channels) with 1 to 4 channels.")
    array = array[:, :, : 3 if array.shape[2] >= 3 else 1]
    if array.dtype.kind == "f":
        return _write_floats(path.with_suffix(".pfm"), array)
    if array.dtype not in (np.uint8, np.uint16):
        raise ValueError(f"is an array of {array.dtype}; expected floats, or bytes or uint16 in sRGB.")
    encoded = getattr(picture, "srgb_gamma", None)
    if is_raw or encoded is None or encoded():
        return _write_whole(path.with_suffix(".ppm"), array)
    return _write_floats(path.with_suffix(".pfm"), array / np.iinfo(array.dtype).max)


def write_volume(path: Path, volume: Any) -> Path:
    """Writes an array (z, y, x) or (z, y, x, 1 or 3), or a grid of Mitsuba, as a .vol file. ValueError: what is wrong."""
    wanted = "(z, y, x) or (z, y, x, channels)"
    array = _array(volume, wanted)
    if array.ndim == 3:
        array = array[:, :, :, None]
    if array.ndim != 4 or array.shape[3] not in (1, 3) or array.size == 0 or array.dtype.kind not in "iuf":
        raise ValueError(f"is an array of {array.dtype} of the shape {array.shape}; expected numbers of the shape {wanted}, with 1 or 3 channels.")
    depth, height, width, channels = array.shape
    header = b"VOL\x03" + struct.pack("<5i6f", 1, width, height, depth, channels, 0, 0, 0, 1, 1, 1)
    path = path.with_suffix(".vol")
    path.write_bytes(header + np.ascontiguousarray(array, dtype="<f4").tobytes())
    return path


def _array(value: Any, wanted: str) -> NDArray[Any]:
    array = np.asarray(value) if isinstance(value, (list, tuple)) else array_of(value)
    if array is None or array.dtype.kind not in "iuf":
        raise ValueError(f"is {short(value)}; expected an array {wanted}.")
    return array


def _write_floats(path: Path, array: NDArray[Any]) -> Path:
    height, width, channels = array.shape
    rows = np.ascontiguousarray(array[::-1], dtype="<f4")  # the lower one first
    path.write_bytes(f"{'PF' if channels == 3 else 'Pf'}\n{width} {height}\n-1.0\n".encode() + rows.tobytes())
    return path


def _write_whole(path: Path, array: NDArray[Any]) -> Path:
    height, width, _ = array.shape
    pixels = np.broadcast_to(array, (height, width, 3)).astype(array.dtype.newbyteorder(">"))
    path.write_bytes(f"P6\n{width} {height}\n{np.iinfo(array.dtype).max}\n".encode() + pixels.tobytes())
    return path

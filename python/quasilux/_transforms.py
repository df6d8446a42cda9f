"""Transforms as arrays, by the rules of the scene language. They are joined by ``@``: the one on the right is applied first."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._tree import Node
from ._values import number_text


def _matrix(tag: str, **attributes: str) -> NDArray[np.float64]:
    operation = Node(tag, attributes, [], [], tag)
    return np.array(_core.transform(Node("transform", {"name": tag}, [operation], [], tag)))


def _triple(values: Sequence[float]) -> str:
    return ", ".join(number_text(value) for value in values)


def look_at(origin: Sequence[float], target: Sequence[float], up: Sequence[float] = (0, 1, 0)) -> NDArray[np.float64]:
    """4 x 4: a camera at ``origin`` that looks at ``target``; +z ahead, +y up, +x to the left of the image."""
    return _matrix("lookat", origin=_triple(origin), target=_triple(target), up=_triple(up))


def translate(by: Sequence[float]) -> NDArray[np.float64]:
    """4 x 4: a shift by x, y, z, in scene units."""
    return _matrix("translate", value=_triple(by))


def scale(by: float | Sequence[float]) -> NDArray[np.float64]:
    """4 x 4: factors along x, y, z, or one for all."""
    return _matrix("scale", value=number_text(by) if np.ndim(by) == 0 else _triple(by))  # type: ignore[arg-type]


def rotate(axis: Sequence[float], angle: float) -> NDArray[np.float64]:
    """4 x 4: a turn by ``angle`` degrees about ``axis``, counter-clockwise for who looks against it."""
    x, y, z = (number_text(value) for value in axis)
    return _matrix("rotate", x=x, y=y, z=z, angle=number_text(angle))

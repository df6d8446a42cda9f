"""Comparison of images."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._render import Render, RenderWarning


def compare(
    image: str | os.PathLike[str] | NDArray[Any] | Render,
    reference: str | os.PathLike[str] | NDArray[Any] | Render,
    *,
    mask: str | os.PathLike[str] | None = None,
    regions: Mapping[str, Sequence[Any]] | None = None,
    reference_noise: float | Mapping[str, float] | None = None,
    net_of_image_noise: bool = False,
    max_non_finite: int = 0,
    worst: int = 5,
) -> dict[str, Any]:
    """The error of an image against a reference: what `quasilux compare --json` says, by the same keys but those of its files and limits (``regions``, ``worst`` …).

    Images are files, arrays of floats (height, width, 3) or (height, width), or renders; renders and files know their standard errors.

    mask: a picture whose values or colours are regions. regions: names for values of it, ``{"walls": [30, 60]}``.
    reference_noise: relMSE of the reference's own noise, one or by region. net_of_image_noise: subtract the image's own, too.
    max_non_finite: as many pixels that are not finite are left out. worst: how many of the worst pixels to list.

    Raises InputError.
    """
    if regions and mask is None:
        raise _core.InputError("regions are values of a mask; give one.")
    groups = [(name, [str(value) for value in values]) for name, values in (regions or {}).items()]
    noise = {"": float(reference_noise)} if isinstance(reference_noise, (int, float, np.number)) else dict(reference_noise or {})
    text, said = _core.compare(
        _image(image, "image"), _image(reference, "reference"), "" if mask is None else os.fspath(mask), groups, noise,
        net_of_image_noise, max_non_finite, worst)
    for warning in said:
        warnings.warn(warning, RenderWarning, stacklevel=2)
    report: dict[str, Any] = json.loads(text)
    return report


def _image(given: Any, name: str) -> Any:
    if isinstance(given, Render):
        return given._core
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    array = np.asarray(given)
    if array.dtype.kind != "f":
        raise _core.InputError(f"{name}: an array of {array.dtype} holds no linear radiance; expected floats.")
    return array

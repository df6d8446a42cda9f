"""Loading of scenes."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _core
from ._tree import scene_tree


class SceneError(_core.InputError):
    """A scene that is wrong: the message names ``file:line:column``, or of dicts the keys, such as ``scene.lamp.radiance``."""


class SceneWarning(UserWarning):
    """What a scene says without an effect."""


def load(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    *,
    parameters: Mapping[str, Any] | None = None,
    sensor: int | str | None = None,
    lenient: bool = False,
    folder: str | os.PathLike[str] = ".",
) -> _core.Scene:
    """Loads a scene: a file of Mitsuba 3 XML or glTF 2.0, or a dict as Mitsuba's ``load_dict`` takes it.

    In a dict, objects are dicts with the name of a plugin as ``type``; their keys are their ids, which
    ``{"type": "ref", "id": ...}`` refers to. Numbers, bools, strings, three numbers (a point or vector), 4 x 4 arrays (a
    transform), ``{"type": "rgb", "value": [r, g, b]}`` and ``{"type": "spectrum", ...}`` are parameters; so are the numbers,
    vectors, colours, transforms, bitmaps and grids of Mitsuba, but not objects that it has loaded. Besides there are

    - ``{"type": "mesh", "vertices": (n, 3), "faces": (m, 3)}``, with ``normals`` (n, 3), ``uv`` (n, 2), ``vertex_NAME`` and
      ``face_NAME`` (1 or 3 columns) where wanted, and what else a ``ply`` takes;
    - pictures and volumes from arrays: ``"bitmap": (height, width, channels)`` of a ``bitmap`` or ``envmap``, ``"data": (z, y, x)`` of a
      ``gridvolume``, instead of a ``filename``;
    - ``"quasilux": {...}`` in the scene, a bsdf or a medium: quasilux' own settings, with underscores for hyphens; in the scene also
      ``"quasilux": {"illuminance_grid": {...}}``.

    parameters: values of the ``<default>`` elements of the file, by name.
    sensor: the one to render, by its number from 0 or its id; None: the first one.
    lenient: what is not known is left out or something plain stands in for it, and values out of range become the nearest within, with a
        warning each, instead of an error.
    folder: of dicts, where the files that they name lie.

    Raises SceneError. Warns by SceneWarning of what has no effect.
    """
    chosen = "" if sensor is None else str(sensor)
    try:
        if isinstance(scene, Mapping):
            if parameters:
                raise SceneError("parameters are of scene files; write the values into the dict.")
            with tempfile.TemporaryDirectory(prefix="quasilux-") as files:
                loaded = _core.load_tree(scene_tree(scene, Path(files)), os.fspath(folder), chosen, lenient)
        else:
            given = [(name, _text(value)) for name, value in (parameters or {}).items()]
            loaded = _core.load_file(os.fspath(scene), given, chosen, lenient)
    except _core.InputError as wrong:
        raise SceneError(str(wrong)) from None
    for warning in loaded.warnings:
        warnings.warn(warning, SceneWarning, stacklevel=2)
    return loaded


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)

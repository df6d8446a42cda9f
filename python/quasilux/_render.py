"""Renders and measurements."""

from __future__ import annotations

import json
import os
import re
import tempfile
import warnings
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

import numpy as np
from numpy.typing import NDArray

from . import _core

if TYPE_CHECKING:
    from typing_extensions import Unpack


class RenderOptions(TypedDict, total=False):
    """Options of `quasilux render` by their names with underscores; None: the default."""

    time: float | None
    passes: int | tuple[int, int] | None
    error: float | None
    bdd: int | None
    variant: Literal["main", "alternative"] | None
    quasi_specular: str | Sequence[str] | None
    direct: Literal["emitters", "photons"] | None
    caustics: Literal["photons", "paths"] | None
    map: Literal["photons", "camera"] | None
    emission: Literal["guided", "plain"] | None
    photons: int | None
    camera_paths: int | None
    camera_sampling: Literal["even", "adaptive"] | None
    seed: int | None
    radius: Literal["adaptive", "fixed"] | None
    radius_scale: float | None
    energy_balance: bool | None
    auto: bool | None
    fixed: bool | None
    device: int | None
    work_group_size: int | None
    device_memory: int | None
    without: Sequence[str] | None
    kernels: Literal["scene", "generic"] | None
    checkpoint: str | os.PathLike[str] | None
    every: float | None
    resume: str | os.PathLike[str] | None


class RenderWarning(UserWarning):
    """What should be known of an image, such as light that too few photons have brought."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a render. ``result``: what there is by then, or None before the first pass."""

    def __init__(self, result: Render | None = None):
        super().__init__("the render was interrupted")
        self.result = result


class Render:
    """A finished render. Arrays are float32, row 0 is the top; they are not writable (copy them to change them) and show the memory of the
    render itself, which lives as long as any of them."""

    def __init__(self, core: _core.Rendered):
        self._core = core

    @cached_property
    def image(self) -> NDArray[np.float32]:
        """(height, width, 3): radiance in linear R, G, B, W sr^-1 m^-2; of irradiance meters irradiance, W m^-2."""
        return self._core.image

    @cached_property
    def layers(self) -> dict[str, NDArray[np.float32]]:
        """All layers of the EXR beside the image, by name, each (height, width, channels): components, ``stderr``, ``bias``, ``bias_stderr``,
        those of integrator ``aov`` (``stderr.T`` where a layer has the name of another one), and ``A`` where the film has alpha; not the ``Y``, ``X`` and
        ``Z`` of the film's ``pixel_format``."""
        return self._core.layers

    @cached_property
    def components(self) -> dict[str, NDArray[np.float32]]:
        """The image by class of light, as far as there is some, each (height, width, 3): ``direct``, ``caustic``, ``quasi_caustic``,
        ``diffuse``, ``emission``. They add up to the image."""
        return self._core.components

    @property
    def stderr(self) -> NDArray[np.float32]:
        """(height, width, 3): standard error of the image, in its unit; not finite after a single pass."""
        return self.layers.get("stderr", np.full_like(self.image, np.inf))

    @property
    def bias(self) -> NDArray[np.float32] | None:
        """(height, width, 3): estimate of the bias that the density radius leaves, in the image's unit; None where it was not estimated."""
        return self.layers.get("bias")

    @cached_property
    def record(self) -> dict[str, Any]:
        """What `quasilux render --stats` writes: settings, counters, errors, times. Only ``gatheredPhotons``, which takes another pass, is None."""
        record: dict[str, Any] = json.loads(self._core.record())
        return record

    @property
    def passes(self) -> int:
        """That the image is the mean of."""
        return self._core.passes

    @property
    def error(self) -> float | None:
        """Estimated relative error, as a ratio: noise and bias; None after a single pass."""
        error: float | None = self.record["error"]["relativeError"]
        return error

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C or the callback ended it."""
        return bool(self.record["stop"]["interrupted"])

    @property
    def warnings(self) -> list[str]:
        return self._core.warnings

    def save(self, path: str | os.PathLike[str], *, exposure: float | None = None, exposure_scale: float | None = None) -> None:
        """Writes what `quasilux render` writes: ``.exr`` (all layers), ``.png``, ``.json`` (the record), or ``.csv`` (a grid's table).

        exposure: of the PNG, in stops relative to the automatic one. exposure_scale: a factor on radiance instead, per W sr^-1 m^-2.
        Raises InputError for names and folders that are not right."""
        if exposure is not None and exposure_scale is not None:
            raise _core.InputError("exposure and exposure_scale are both given; keep one.")
        self._core.save(os.fspath(path), exposure, exposure_scale)

    def _repr_png_(self) -> bytes:
        """The picture in a notebook."""
        with tempfile.TemporaryDirectory(prefix="quasilux-") as folder:
            path = Path(folder) / "picture.png"
            self.save(path)
            return path.read_bytes()

    def __repr__(self) -> str:
        height, width = self.image.shape[:2]
        error = "unknown" if self.error is None else f"{100 * self.error:.3g} %"
        return f"<quasilux.Render {width} x {height}, {self.passes} passes, estimated relative error {error}>"


class GridReading(NamedTuple):
    """What was measured at the points of one grid; arrays as Reading has them."""

    value: NDArray[np.float64]
    stderr: NDArray[np.float64]
    points: NDArray[np.float64]


class Reading:
    """What a meter has measured: its film's pixels, or the points of grids."""

    def __init__(self, render: Render):
        self.render = render
        readings = render._core.readings
        _, self.value, self.stderr, self.points = readings[0]
        self.grids = {name: GridReading(value, stderr, points) for name, value, stderr, points in readings if name is not None and points is not None}

    grids: dict[str, GridReading]
    """By name, all grids of the scene; value, stderr and points are those of the first one."""

    value: NDArray[np.float64]
    """(height, width), float64: illuminance in lx, of a radiancemeter luminance in cd/m^2. Row j, column i of a grid."""
    stderr: NDArray[np.float64]
    """(height, width), float64: its standard error, an upper bound."""
    points: NDArray[np.float64] | None
    """(height, width, 3), float64: the points of a grid, scene units; None for other meters."""

    @property
    def summary(self) -> dict[str, Any]:
        """What `quasilux render --json` says as ``meter``: the mean with its standard error, components, of grids minimum, maximum, U0, Ud, and
        the daylight factor in per cent where it was asked for."""
        summary: dict[str, Any] = self.render.record["meter"]
        return summary

    def save(self, path: str | os.PathLike[str]) -> None:
        """Render.save: ``.csv`` is the table of a grid."""
        self.render.save(path)

    def __repr__(self) -> str:
        height, width = self.value.shape
        unit = "lx" if self.summary["quantity"] == "irradiance" else "cd/m^2"
        return f"<quasilux.Reading {width} x {height}, mean {self.value.mean():.6g} {unit}>"


def render(
    scene: _core.Scene,
    *,
    callback: Callable[[_core.Progress], bool | None] | None = None,
    **options: Unpack[RenderOptions],
) -> Render:
    """Renders a scene until the first of the stop rules is reached; without one for 30 s.

    Stop rules: time, in seconds; passes, a count, or (first, end) as for `--passes A:B`; error, the estimated relative error to reach, a ratio.

    callback: called after each pass with a Progress; if it returns False the render ends, and what there is is returned (RuntimeError: before
    the first pass). In the search that may come first its ``phase`` is "pilot passes" and its ``passes`` is 0.

    options: those of `quasilux render` by their names with underscores, None for the default:
    bdd, variant, quasi_specular, direct, caustics, map, emission, photons, camera_paths, camera_sampling, seed, radius, radius_scale, energy_balance, auto,
    fixed, device, work_group_size, device_memory (bytes), without (names, such as ["bias"]), kernels, checkpoint, every (s), resume.

    The same seed gives the same bits as the program on the same device. Other Python threads go on meanwhile. Ctrl-C ends the render
    after the running pass and raises Interrupted, a KeyboardInterrupt, whose ``result`` is what there is.

    Raises InputError for options and what is wrong with the scene, DeviceError where the device fails (with what there is as ``result``).
    Warns by RenderWarning.
    """
    return _run(scene, _arguments(options), callback, False)


def meter(
    scene: _core.Scene,
    *,
    daylight_factor: bool = False,
    callback: Callable[[_core.Progress], bool | None] | None = None,
    **options: Unpack[RenderOptions],
) -> Reading:
    """Measures with the scene's sensor, where it is a meter, or else at the points of its illuminance grids.

    daylight_factor: also as a share of the sky's illuminance of free ground, in per cent, without the sun and lamps.
    The others: as for render().
    """
    if not scene.is_meter and not scene.has_grid:
        raise _core.InputError(f"{scene.path}: there is nothing to measure; give the scene an illuminance grid, or a sensor 'irradiancemeter' or 'radiancemeter'.")
    arguments = _arguments(options) + (["--daylight-factor"] if daylight_factor else [])
    return Reading(_run(scene, arguments, callback, not scene.is_meter))


def devices() -> list[dict[str, Any]]:
    """The OpenCL devices: ``number`` (what ``device=`` takes), ``name``, ``platform``, ``globalMemory`` in bytes …"""
    rows: list[dict[str, Any]] = json.loads(_core.devices())
    return rows


def _arguments(options: RenderOptions) -> list[str]:
    """Of the command line."""
    arguments = []
    for name, value in options.items():
        if name not in RenderOptions.__annotations__:
            raise TypeError(f"a render has no option '{name}'. Known: {', '.join(RenderOptions.__annotations__)}.")
        if value is None or value is False:
            continue
        arguments.append("--" + name.replace("_", "-"))
        if value is not True:
            arguments.append(_text(name, value))
    return arguments


def _text(name: str, value: Any) -> str:
    if name == "passes" and isinstance(value, tuple):
        return ":".join(str(end) for end in value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ",".join(str(entry) for entry in value)
    return str(value)  # of paths, too


def _run(scene: _core.Scene, arguments: list[str], callback: Callable[[_core.Progress], bool | None] | None, measures_grid: bool) -> Render:
    try:
        core, raised = _core.render(scene, arguments, callback, measures_grid)
    except _core.InputError as wrong:
        message = re.sub(r"--([a-z][a-z-]*)", lambda match: match[1].replace("-", "_"), str(wrong))
        raise _core.InputError(message) from None
    result = None if core is None else Render(core)
    if isinstance(raised, KeyboardInterrupt):
        raise Interrupted(result) from None
    if raised is not None:
        raise raised
    if result is None:
        raise RuntimeError("the callback ended the render before its first pass")
    for warning in result.warnings:
        warnings.warn(warning, RenderWarning, stacklevel=3)
    if result._core.failure:
        failure = _core.DeviceError(result._core.failure)
        failure.result = result
        raise failure
    return result

"""The compiled part. Use the package, which documents what is meant for users."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str
MAXIMUM_NESTING: int

class InputError(ValueError):
    """Something that the user can mend: an option, a scene, a file's name."""

class DeviceError(RuntimeError):
    """The device or its runtime failed. ``result``: the Render of the passes before, where there are some."""

    result: Any

class Scene:
    """A loaded scene, which does not change."""

    @property
    def path(self) -> str:
        """Of its file; "scene" for dicts."""
    @property
    def width(self) -> int:
        """Of the image, in pixels."""
    @property
    def height(self) -> int: ...
    @property
    def sensor_count(self) -> int: ...
    @property
    def is_meter(self) -> bool:
        """Whether the sensor that was chosen is no camera."""
    @property
    def has_grid(self) -> bool:
        """Whether the scene has illuminance grids."""
    @property
    def warnings(self) -> list[str]: ...

class Progress:
    """How far a render is."""

    @property
    def phase(self) -> str:
        """ "pilot passes" or "rendering"."""
    @property
    def passes(self) -> int:
        """Of the image: 0 while settings are searched."""
    @property
    def seconds(self) -> float: ...
    @property
    def seconds_left(self) -> float | None:
        """None: unknown."""
    @property
    def error(self) -> float | None:
        """Estimated relative error, a ratio; None: not known yet."""

class Rendered:
    @property
    def image(self) -> NDArray[np.float32]: ...
    @property
    def components(self) -> dict[str, NDArray[np.float32]]: ...
    @property
    def layers(self) -> dict[str, NDArray[np.float32]]: ...
    @property
    def readings(self) -> list[tuple[str | None, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64] | None]]: ...
    @property
    def passes(self) -> int: ...
    @property
    def failure(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    def record(self) -> str: ...
    def save(self, path: str, stops: float | None, scale: float | None, /) -> None: ...

def load_file(path: str, parameters: Sequence[tuple[str, str]], sensor: str, lenient: bool, /) -> Scene: ...
def load_tree(root: Any, folder: str, sensor: str, lenient: bool, /) -> Scene: ...
def checksums(scene: Scene, /) -> dict[str, str]:
    """Of what kernels read: geometry; materials, textures and emitters; camera and film. The same for scenes that render the same bits by the same options."""
def transform(node: Any, /) -> list[list[float]]: ...
def tag_of_plugin(plugin: str, /) -> str: ...
def known_plugins(plugin: str, /) -> str: ...
def render(scene: Scene, arguments: Sequence[str], callback: Callable[[Progress], bool | None] | None, measures_grid: bool, /) -> tuple[Rendered | None, BaseException | None]: ...
def devices() -> str: ...
def compare(
    image: str | NDArray[Any] | Rendered,
    reference: str | NDArray[Any] | Rendered,
    mask: str,
    regions: Sequence[tuple[str, Sequence[str]]],
    reference_noise: dict[str, float],
    net_of_image_noise: bool,
    maximum_non_finite: int,
    worst: int,
    /,
) -> tuple[str, list[str]]: ...

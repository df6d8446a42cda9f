"""quasilux: images and illuminance by bidirectional Monte Carlo ray tracing, from Python.

>>> import quasilux as ql
>>> scene = ql.load("scenes/cornell_phong.xml")
>>> picture = ql.render(scene, time=10)
>>> picture.image.shape
(256, 256, 3)

Guide: docs/guide/python.md. What options mean: docs/reference/command-line.md, by the same names with hyphens."""

try:
    from ._core import DeviceError, InputError, Progress, Scene, __version__
except ImportError as error:
    if ".so" not in str(error):
        raise
    raise ImportError(
        f"{error}: quasilux was built against libraries that this machine lacks. On Debian 12: "
        "apt-get install libembree3-3 libopenimageio2.4 ocl-icd-libopencl1 pocl-opencl-icd; then `quasilux doctor` says what else is missing"
    ) from error
from ._compare import compare
from ._load import SceneError, SceneWarning, load
from ._render import GridReading, Interrupted, Reading, Render, RenderWarning, devices, meter, render
from ._transforms import look_at, rotate, scale, translate

__all__ = [
    "DeviceError",
    "GridReading",
    "InputError",
    "Interrupted",
    "Progress",
    "Reading",
    "Render",
    "RenderWarning",
    "Scene",
    "SceneError",
    "SceneWarning",
    "__version__",
    "compare",
    "devices",
    "load",
    "look_at",
    "meter",
    "render",
    "rotate",
    "scale",
    "translate",
]

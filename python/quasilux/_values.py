"""Numbers out of what scenes are written with: Python's own, NumPy's, and the scalars, vectors, colours and transforms of Mitsuba and Dr.Jit."""

from __future__ import annotations

import numbers
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


def is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def number_text(value: Any) -> str:
    """The shortest text that is read as the same double, or a whole number."""
    return str(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))


def scalar_of(value: Any) -> Any:
    """A number or bool: itself, or the only element of an array; None: it is something else."""
    if isinstance(value, (bool, np.bool_, numbers.Real)):
        return value
    array = array_of(value)
    return array.reshape(-1)[0] if array is not None and array.size == 1 and array.dtype.kind in "biuf" else None


def triple_of(value: Any) -> list[Any] | None:
    """Three numbers, or None."""
    if isinstance(value, (list, tuple)):
        return list(value) if len(value) == 3 and all(is_number(entry) for entry in value) else None
    array = array_of(value)
    if array is None or array.shape not in ((3,), (3, 1)) or array.dtype.kind not in "iuf":
        return None
    return list(array.reshape(3))


def is_color(value: Any) -> bool:
    """Whether it is a colour of Mitsuba, such as ``mi.ScalarColor3f``."""
    return _is_foreign(value) and type(value).__name__.startswith("Color")


def matrix_of(value: Any, name: str = "to_world") -> NDArray[np.float64] | None:
    """4 x 4, of an array, of lists, or of a transform of Mitsuba; in the plane, of ``to_uv``, also of 3 x 3. None: it is something else."""
    value = getattr(value, "matrix", value)
    if isinstance(value, (str, bytes, Mapping)):
        return None
    try:
        matrix = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None
    if matrix.ndim == 3 and matrix.shape[2] == 1:  # of Mitsuba's variants that compute many at once
        matrix = matrix[:, :, 0]
    if matrix.shape == (3, 3) and name == "to_uv":
        return np.insert(np.insert(matrix, 2, 0, axis=0), 2, [0, 0, 1, 0], axis=1)
    return matrix if matrix.shape == (4, 4) else None


def array_of(value: Any) -> NDArray[Any] | None:
    """What an array says it is; None where it is none, as lists and texts are not."""
    if isinstance(value, np.ndarray):
        return value
    if not (hasattr(value, "__array__") or hasattr(value, "__array_interface__")):
        return None
    array = np.asarray(value)
    return array if array.dtype.kind in "biuf" else None


def kind_of_object(value: Any) -> str:
    """Of an object that Mitsuba has loaded already, such as ``mitsuba.Mesh``; empty: it is something else."""
    if not _is_foreign(value) or not hasattr(value, "class_name"):
        return ""
    return f"{type(value).__module__}.{type(value).__name__}"


def _is_foreign(value: Any) -> bool:
    return type(value).__module__.partition(".")[0] in ("mitsuba", "drjit")


def short(value: Any) -> str:
    text = re.sub(r"\s+", " ", repr(value))
    return text if len(text) <= 60 else text[:57] + "..."

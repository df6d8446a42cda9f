"""Scenes from dicts, as Mitsuba's ``load_dict`` takes them: the tree that the reader of XML files makes, with places such as
``scene.lamp.radiance`` in it that stand for lines in messages."""

from __future__ import annotations

import numbers
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._mesh import write_mesh


class Instruction(NamedTuple):
    """``<?quasilux kind key="value"?>``"""

    kind: str
    entries: dict[str, str]
    place: str


class Node(NamedTuple):
    """An element of XML: what ``_core`` takes."""

    tag: str
    attributes: dict[str, str]
    children: list[Node]
    instructions: list[Instruction]
    place: str


def error(place: str, message: str) -> _core.InputError:
    return _core.InputError(f"{place}: {message}")


def scene_tree(scene: Mapping[str, Any], meshes: Path) -> Node:
    """Arrays become files in the folder ``meshes``, which has to last until the scene is loaded."""
    if scene.get("type") != "scene":
        raise error("scene", f"the outermost dict has the type {scene.get('type')!r}; expected 'scene'.")
    root = Node("scene", {"version": "3.0.0"}, [], [], "scene")
    _TreeMaker(meshes).fill(root, scene)
    return root


def number_text(value: Any) -> str:
    """The shortest text that is read as the same double, or a whole number."""
    return str(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))


def matrix_node(name: str, matrix: NDArray[np.float64], place: str) -> Node:
    text = " ".join(number_text(entry) for entry in matrix.ravel())
    return Node("transform", {"name": name}, [Node("matrix", {"value": text}, [], [], place)], [], place)


def matrix_of(value: Any) -> NDArray[np.float64] | None:
    """4 x 4, of an array, of lists, or of a transform of Mitsuba; None: it is something else."""
    value = getattr(value, "matrix", value)
    if isinstance(value, (str, bytes, Mapping)):
        return None
    try:
        matrix = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None
    return matrix if matrix.shape == (4, 4) else None


def triple_of(value: Any) -> list[Any] | None:
    """Three numbers, or None."""
    if not isinstance(value, (list, tuple, np.ndarray)) or len(value) != 3:
        return None
    return list(value) if all(_is_number(entry) for entry in value) else None


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


class _TreeMaker:
    def __init__(self, meshes: Path):
        self.meshes = meshes
        self.mesh_count = 0

    def fill(self, parent: Node, entries: Mapping[str, Any]) -> None:
        if parent.place.count(".") > _core.MAXIMUM_NESTING:
            raise error(parent.place, f"dicts nested deeper than {_core.MAXIMUM_NESTING}.")
        for name, value in entries.items():
            if not isinstance(name, str):
                raise error(parent.place, f"the key {name!r} is no string.")
            if name not in ("type", "id"):
                self.add(parent, name, value, f"{parent.place}.{name}")

    def add(self, parent: Node, name: str, value: Any, place: str) -> None:
        if name == "quasilux":
            parent.instructions.extend(_instructions(parent, value, place))
        elif isinstance(value, Mapping):
            parent.children.append(self.object(parent, name, value, place))
        elif parent.tag == "scene":
            raise error(place, f"{value!r} may not stand directly in the scene; expected a dict with a 'type'.")
        else:
            parent.children.append(_parameter(name, value, place))

    def object(self, parent: Node, name: str, entries: Mapping[str, Any], place: str) -> Node:
        kind = entries.get("type")
        if not isinstance(kind, str):
            raise error(place, "the dict has no 'type', the name of a plugin.")
        if kind in ("rgb", "spectrum"):
            return _color(kind, name, entries, place)
        if kind == "ref":
            return _reference(parent, name, entries, place)
        if kind == "mesh":
            entries = self.mesh(entries, place)
            kind = "ply"
        tag = _core.tag_of_plugin(kind)
        if not tag:
            raise error(place, f"unknown plugin '{kind}'.{_core.known_plugins(kind)}")
        # The key is the id, as for Mitsuba, and that of what lies deeper is made of all keys.
        attributes = {"type": kind, "id": str(entries.get("id", place.removeprefix("scene.")))}
        if parent.tag != "scene":
            attributes["name"] = name
        node = Node(tag, attributes, [], [], place)
        self.fill(node, entries)
        return node

    def mesh(self, entries: Mapping[str, Any], place: str) -> dict[str, Any]:
        """The same as a file."""
        path = self.meshes / f"{self.mesh_count}.ply"
        self.mesh_count += 1
        try:
            rest = write_mesh(path, entries)
        except ValueError as wrong:
            raise error(place, str(wrong)) from None
        return {**rest, "filename": str(path)}


def _parameter(name: str, value: Any, place: str) -> Node:
    def node(tag: str, text: str) -> Node:
        return Node(tag, {"name": name, "value": text}, [], [], place)

    if isinstance(value, (bool, np.bool_)):
        return node("boolean", "true" if value else "false")
    if isinstance(value, numbers.Integral):
        return node("integer", number_text(value))
    if isinstance(value, numbers.Real):
        return node("float", number_text(value))
    if isinstance(value, (str, Path)):
        return node("string", str(value))
    matrix = matrix_of(value)
    if matrix is not None:
        return matrix_node(name, matrix, place)
    triple = triple_of(value)
    if triple is not None:
        return node("vector", ", ".join(number_text(entry) for entry in triple))
    raise error(place, f"{_short(value)} is no parameter; expected a number, a bool, a string, three numbers, a matrix of 4 x 4, or a dict with a 'type'.")


def _color(kind: str, name: str, entries: Mapping[str, Any], place: str) -> Node:
    _only(entries, {"type", "value", "filename"} if kind == "spectrum" else {"type", "value"}, place)
    if "filename" in entries:
        return Node(kind, {"name": name, "filename": str(entries["filename"])}, [], [], place)
    if "value" not in entries:
        raise error(place, f"{kind} needs a 'value'.")
    value = entries["value"]
    if isinstance(value, str):
        text = value
    elif _is_number(value):
        text = number_text(value)
    elif kind == "rgb" and (triple := triple_of(value)) is not None:
        text = ", ".join(number_text(entry) for entry in triple)
    elif kind == "spectrum" and _are_pairs(value):
        text = ", ".join(f"{number_text(wavelength)}:{number_text(entry)}" for wavelength, entry in value)
    else:
        wanted = "three numbers or one" if kind == "rgb" else "a number, or pairs of wavelength in nm and value"
        raise error(f"{place}.value", f"{_short(value)}; expected {wanted}.")
    return Node(kind, {"name": name, "value": text}, [], [], place)


def _are_pairs(value: Any) -> bool:
    return isinstance(value, (list, tuple, np.ndarray)) and len(value) > 0 and all(
        isinstance(pair, (list, tuple, np.ndarray)) and len(pair) == 2 and all(_is_number(entry) for entry in pair) for pair in value)


def _reference(parent: Node, name: str, entries: Mapping[str, Any], place: str) -> Node:
    _only(entries, {"type", "id"}, place)
    if not isinstance(entries.get("id"), str):
        raise error(place, "the reference needs the 'id' of an object, a string.")
    attributes = {"id": entries["id"]}
    if parent.tag != "scene":
        attributes["name"] = name
    return Node("ref", attributes, [], [], place)


def _only(entries: Mapping[str, Any], known: set[str], place: str) -> None:
    for name in entries:
        if name not in known:
            raise error(f"{place}.{name}", f"unknown key of a dict of type '{entries['type']}'. Known: {', '.join(sorted(known))}.")


def _instructions(parent: Node, settings: Any, place: str) -> list[Instruction]:
    """``{"quasilux": {"bdd": 1, "illuminance_grid": {...}}}``; underscores stand for hyphens."""
    if parent.tag not in ("scene", "bsdf", "medium"):
        raise error(place, f"has no meaning in a {parent.tag}; put it into the scene, a bsdf or a medium.")
    if not isinstance(settings, Mapping):
        raise error(place, f"{_short(settings)}; expected a dict of settings.")
    plain = {name: value for name, value in settings.items() if not isinstance(value, Mapping)}
    instructions = [Instruction("", _entries(plain, place), place)] if plain else []
    for name, value in settings.items():
        if isinstance(value, Mapping):
            instructions.append(Instruction(_hyphens(name), _entries(value, f"{place}.{name}"), f"{place}.{name}"))
    return instructions


def _entries(settings: Mapping[str, Any], place: str) -> dict[str, str]:
    return {_hyphens(name): _setting(value, f"{place}.{name}") for name, value in settings.items()}


def _setting(value: Any, place: str) -> str:
    if isinstance(value, str):
        return value
    if _is_number(value):
        return number_text(value)
    triple = triple_of(value)
    if triple is None:
        raise error(place, f"{_short(value)}; expected a number, a string or three numbers.")
    return ",".join(number_text(entry) for entry in triple)


def _hyphens(name: str) -> str:
    return name.replace("_", "-")


def _short(value: Any) -> str:
    text = re.sub(r"\s+", " ", repr(value))
    return text if len(text) <= 60 else text[:57] + "..."

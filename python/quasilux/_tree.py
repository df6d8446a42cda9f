"""Scenes from dicts, as Mitsuba's ``load_dict`` takes them: the tree that the reader of XML files makes, with places such as
``scene.lamp.radiance`` in it that stand for lines in messages."""

from __future__ import annotations

import numbers
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._files import write_picture, write_volume
from ._mesh import write_mesh
from ._values import is_color, is_number, kind_of_object, matrix_of, number_text, scalar_of, short, triple_of


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


def scene_tree(scene: Mapping[str, Any], folder: Path) -> Node:
    """Arrays become files in `folder`, which has to last until the scene is loaded."""
    if scene.get("type", "scene") != "scene":
        raise error("scene", f"the outermost dict has the type {scene['type']!r}; expected 'scene', or none.")
    root = Node("scene", {"version": "3.0.0"}, [], [], "scene")
    maker = _TreeMaker(folder)
    maker.fill(root, scene)
    root.children.extend(maker.aliases)
    return root


def matrix_node(name: str, matrix: NDArray[np.float64], place: str) -> Node:
    text = " ".join(number_text(entry) for entry in matrix.ravel())
    return Node("transform", {"name": name}, [Node("matrix", {"value": text}, [], [], place)], [], place)


class _TreeMaker:
    def __init__(self, folder: Path):
        self.folder = folder
        self.files = 0
        self.aliases: list[Node] = []

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
        elif kind := kind_of_object(value):
            raise error(place, f"is an object that Mitsuba has loaded, {kind}; expected the dict that it was loaded from, or for a mesh its arrays "
                               "in a dict of type 'mesh'.")
        elif parent.tag == "scene":
            raise error(place, f"{short(value)} may not stand directly in the scene; expected a dict with a 'type'.")
        elif _is_color_parameter(parent, name, value):
            parent.children.append(_color("rgb", name, {"type": "rgb", "value": value}, place))
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
        entries = self.with_files(kind, entries, place)
        tag = _core.tag_of_plugin(kind)
        if not tag:
            raise error(place, f"unknown plugin '{kind}'.{_core.known_plugins(kind)}")
        # As for Mitsuba, the key is an id, of what lies deeper all keys with points between them; there may be another one besides.
        key = place.removeprefix("scene.")
        attributes = {"type": kind, "id": str(entries.get("id", key))}
        if attributes["id"] != key:
            self.aliases.append(Node("alias", {"id": attributes["id"], "as": key}, [], [], place))
        if parent.tag != "scene":
            attributes["name"] = name
        node = Node(tag, attributes, [], [], place)
        self.fill(node, entries)
        return node

    def mesh(self, entries: Mapping[str, Any], place: str) -> dict[str, Any]:
        """The same as a file."""
        path = self.new_file().with_suffix(".ply")
        try:
            rest = write_mesh(path, entries)
        except ValueError as wrong:
            raise error(place, str(wrong)) from None
        return {**rest, "filename": str(path)}

    def with_files(self, kind: str, entries: Mapping[str, Any], place: str) -> Mapping[str, Any]:
        """Pictures and volumes that are arrays, as files."""
        name = next((name for name in _ARRAYS.get(kind, ()) if name in entries), None)
        if name is None:
            return entries
        if "filename" in entries:
            raise error(f"{place}.{name}", "is given beside a filename; keep one.")
        try:
            if kind == "gridvolume":
                path = write_volume(self.new_file(), entries[name])
            else:
                path = write_picture(self.new_file(), entries[name], bool(entries.get("raw", False)))
        except ValueError as wrong:
            raise error(f"{place}.{name}", str(wrong)) from None
        return {**{other: value for other, value in entries.items() if other != name}, "filename": str(path)}

    def new_file(self) -> Path:
        """Without an ending."""
        self.files += 1
        return self.folder / str(self.files)


# Parameters of plugins that are arrays.
_ARRAYS = {"bitmap": ("data", "bitmap"), "envmap": ("bitmap",), "gridvolume": ("data", "grid")}


def _is_color_parameter(parent: Node, name: str, value: Any) -> bool:
    """Three numbers are a vector, but for colours of Mitsuba, and where a plugin takes nothing but a colour."""
    takes_color = name == "color" and parent.attributes["type"] in ("srgb", "d65")
    return is_color(value) or (takes_color and triple_of(value) is not None)


def _parameter(name: str, value: Any, place: str) -> Node:
    def node(tag: str, text: str) -> Node:
        return Node(tag, {"name": name, "value": text}, [], [], place)

    if isinstance(value, (str, Path)):
        return node("string", str(value))
    scalar = scalar_of(value)
    if isinstance(scalar, (bool, np.bool_)):
        return node("boolean", "true" if scalar else "false")
    if isinstance(scalar, numbers.Integral):
        return node("integer", number_text(scalar))
    if scalar is not None:
        return node("float", number_text(scalar))
    matrix = matrix_of(value, name)
    if matrix is not None:
        return matrix_node(name, matrix, place)
    triple = triple_of(value)
    if triple is not None:
        return node("vector", ", ".join(number_text(entry) for entry in triple))
    raise error(place, f"{short(value)} is no parameter; expected a number, a bool, a string, three numbers, a matrix of 4 x 4, or a dict with a 'type'.")


def _color(kind: str, name: str, entries: Mapping[str, Any], place: str) -> Node:
    _only(entries, {"type", "value", "filename"} if kind == "spectrum" else {"type", "value"}, place)
    if "filename" in entries:
        return Node(kind, {"name": name, "filename": str(entries["filename"])}, [], [], place)
    if "value" not in entries:
        raise error(place, f"{kind} needs a 'value'.")
    value = entries["value"]
    scalar = scalar_of(value)
    if isinstance(value, str):
        text = value
    elif is_number(scalar):
        text = number_text(scalar)
    elif kind == "rgb" and (triple := triple_of(value)) is not None:
        text = ", ".join(number_text(entry) for entry in triple)
    elif kind == "spectrum" and _are_pairs(value):
        text = ", ".join(f"{number_text(wavelength)}:{number_text(entry)}" for wavelength, entry in value)
    else:
        wanted = "three numbers or one" if kind == "rgb" else "a number, or pairs of wavelength in nm and value"
        raise error(f"{place}.value", f"{short(value)}; expected {wanted}.")
    return Node(kind, {"name": name, "value": text}, [], [], place)


def _are_pairs(value: Any) -> bool:
    return isinstance(value, (list, tuple, np.ndarray)) and len(value) > 0 and all(
        isinstance(pair, (list, tuple, np.ndarray)) and len(pair) == 2 and all(is_number(entry) for entry in pair) for pair in value)


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
        raise error(place, f"{short(settings)}; expected a dict of settings.")
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
    if is_number(value):
        return number_text(value)
    triple = triple_of(value)
    if triple is None:
        raise error(place, f"{short(value)}; expected a number, a string or three numbers.")
    return ",".join(number_text(entry) for entry in triple)


def _hyphens(name: str) -> str:
    return name.replace("_", "-")

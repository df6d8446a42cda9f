#!/usr/bin/env python3
"""Scenes from files and dicts: what they become, and what is said of those that are wrong.
scene_test.py PROGRAM SOURCE_FOLDER."""

import ast
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

import quasilux as ql
from quasilux import _core
from quasilux._tree import scene_tree
from scenes import lit_floor

SOURCE = sys.argv[2]
# A quarter of a square, as two triangles, whose corners are not all whole numbers.
VERTICES = numpy.array([[0, 0, 0], [1 / 3, 0, 0], [1 / 3, 0.5, 0], [0, 0.5, 1e-3]])
FACES = numpy.array([[0, 1, 2], [0, 2, 3]])


def mesh(**more):
    return {"type": "mesh", "vertices": VERTICES, "faces": FACES, **more}


def bits_of(scene):
    return ql.render(ql.load(scene), passes=2, photons=2000, seed=3, fixed=True).image.tobytes()


class Errors(unittest.TestCase):
    def check(self, scene, *said):
        with self.assertRaises(ql.SceneError) as caught:
            ql.load(scene)
        self.assertIsInstance(caught.exception, ValueError)
        for text in said:
            self.assertIn(text, str(caught.exception))

    def test_of_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "wrong.xml"
            path.write_text('<scene version="3.0.0">\n  <shape type="spere"/>\n</scene>\n')
            self.check(path, f"{path}:2:3: unknown shape plugin 'spere'", "Did you mean 'sphere'")
        self.check("missing.xml", "missing.xml", "no such file")
        with self.assertRaisesRegex(ql.SceneError, "'size' is not used"):
            ql.load(SOURCE + "/scenes/cornell_phong.xml", parameters={"size": 3})
        with self.assertRaisesRegex(ql.SceneError, "no sensor '7'"):
            ql.load(SOURCE + "/scenes/cornell_phong.xml", sensor=7)

    def test_of_dicts(self):
        lamp = {"type": "point", "position": [0, 3, 0]}
        cases = [
            ({"type": "scen"}, "scene: ", "expected 'scene'"),
            (lit_floor(8, ball={"type": "spere"}), "scene.ball: unknown plugin 'spere'", "Did you mean 'sphere'"),
            (lit_floor(8, ball={"radius": 1}), "scene.ball: ", "'type'"),
            (lit_floor(8, ball={"type": "sphere", "radius": -1.0}), "scene.ball.radius: "),
            (lit_floor(8, ball={"type": "sphere", "radius": "big"}), "scene.ball.radius: "),
            (lit_floor(8, ball={"type": "sphere", "radius": float("nan")}), "scene.ball.radius: ", "finite"),
            (lit_floor(8, ball={"type": "sphere", "centre": [0, 0, 0]}), "scene.ball.centre: unknown parameter", "center"),
            (lit_floor(8, ball={"type": "sphere", "center": [0, 0]}), "scene.ball.center: "),
            (lit_floor(8, ball={"type": "sphere", "center": None}), "scene.ball.center: "),
            (lit_floor(8, ball={"type": "sphere", "to_world": numpy.zeros((4, 4))}), "scene.ball.to_world: "),
            (lit_floor(8, ball={"type": "sphere", "bsdf": {"type": "ref", "id": "flor"}}), "scene.ball.bsdf: ", "'flor'", "floor"),
            (lit_floor(8, ball={"type": "sphere", "bsdf": {"type": "ref"}}), "scene.ball.bsdf: ", "'id'"),
            (lit_floor(8, ball={"type": "hair"}), "scene.ball: "),
            (lit_floor(8, lamp={**lamp, "intensity": {"type": "rgb", "value": [1, 2]}}), "scene.lamp.intensity.value: "),
            (lit_floor(8, lamp={**lamp, "intensity": {"type": "rgb", "values": 1}}), "scene.lamp.intensity.values: "),
            (lit_floor(8, lamp={**lamp, "intensity": {"type": "rgb", "value": [-1, 2, 1]}}), "scene.lamp.intensity: "),
            (lit_floor(8, lamp={**lamp, "intensity": {"type": "spectrum", "value": [(400, 1), 3]}}), "scene.lamp.intensity.value: "),
            (lit_floor(8, sky={"type": "constant"}, glow={"type": "constant"}), "scene.glow: a second emitter", "at scene.sky; keep one"),
            (lit_floor(8, size=3), "scene.size: "),
            (lit_floor(8, quasilux={"bdt": 1}), "scene.quasilux: ", "'bdt'", "bdd"),
            (lit_floor(8, quasilux={"illuminance_grid": {"origin": [0, 0, 0]}}), "scene.quasilux.illuminance_grid: "),
            (lit_floor(8, ball={"type": "sphere", "quasilux": {"bdd": 1}}), "scene.ball.quasilux: "),
            (lit_floor(8, glass={"type": "hg"}, ball={"type": "sphere", "g": {"type": "scene"}}), "scene.ball.g: "),
        ]
        for scene, *said in cases:
            with self.subTest(said=said):
                self.check(scene, *said)

    def test_a_dict_that_contains_itself(self):
        bsdf = {"type": "twosided"}
        bsdf["bsdf"] = bsdf
        self.check(lit_floor(8, loop=bsdf), "nested deeper")

    def test_of_arrays(self):
        wrong = VERTICES.copy()
        wrong[2, 1] = numpy.inf
        cases = [
            (mesh(vertices=VERTICES[:, :2]), "'vertices' has the shape (4, 2); expected (n, 3)"),
            (mesh(vertices=wrong), "'vertices' is not finite in row 2"),
            (mesh(vertices="cube"), "'vertices' is no array"),
            (mesh(faces=FACES.astype(float)), "'faces' is an array of float64"),
            (mesh(faces=FACES + 1), "'faces' has [1, 3, 4] in row 1; there are 4 vertices"),
            (mesh(faces=FACES[:0]), "'faces' has no rows"),
            (mesh(uv=numpy.zeros((3, 2))), "'uv' has the shape (3, 2); expected (4, 2)"),
            (mesh(vertex_color=numpy.zeros((4, 2))), "'vertex_color' has the shape (4, 2); expected (4, 1) or (4, 3)"),
            ({"type": "mesh", "vertices": VERTICES}, "a mesh needs 'faces'"),
            (mesh(smooth=True), "unknown parameter 'smooth'"),
        ]
        for shape, said in cases:
            with self.subTest(said=said):
                self.check(lit_floor(8, plate=shape), "scene.plate", said)


class Trees(unittest.TestCase):
    def test_values_are_those_of_the_dict_to_the_bit(self):
        values = {"a": 0.1, "b": numpy.float32(0.1), "c": 1 / 3, "d": 7, "e": numpy.int64(-3), "f": True, "g": "text", "h": 1e300}
        tree = scene_tree({"type": "scene", "x": {"type": "sphere", **values, "m": numpy.arange(16).reshape(4, 4) / 7}}, Path())
        found = {child.attributes["name"]: child for child in tree.children[0].children}
        for name, tag in zip("abcdefgh", ["float", "float", "float", "integer", "integer", "boolean", "string", "float"]):
            self.assertEqual(found[name].tag, tag)
        for name in "abch":
            self.assertEqual(float(found[name].attributes["value"]), float(values[name]))
        matrix = found["m"].children[0].attributes["value"].split()
        self.assertEqual([float(entry) for entry in matrix], [k / 7 for k in range(16)])

    def test_transforms_are_those_of_the_scene_language(self):
        matrix = ql.look_at((0, 0, 4), (0, 0, 0))
        numpy.testing.assert_array_equal(matrix, [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 4], [0, 0, 0, 1]])
        numpy.testing.assert_allclose(ql.rotate((0, 0, 2), 90)[:3, :3], [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15)
        numpy.testing.assert_array_equal(numpy.diag(ql.scale((1, 2, 3))), [1, 2, 3, 1])
        numpy.testing.assert_array_equal(numpy.diag(ql.scale(2)), [2, 2, 2, 1])
        numpy.testing.assert_array_equal(ql.translate((1, 2, 3))[:3, 3], [1, 2, 3])
        with self.assertRaisesRegex(ql.InputError, "axis is zero"):
            ql.rotate((0, 0, 0), 3)

    def test_every_plugin_of_mitsuba_has_its_tag(self):
        listed = [line.split()[1:] if line[1] == " " else line[1:].split() for line in Path(SOURCE, "tests/data/mitsuba_plugins.txt").read_text().splitlines()
                  if line.startswith("@")]
        self.assertGreater(len(listed), 80)
        for tag, plugin in listed:
            self.assertEqual(_core.tag_of_plugin(plugin), tag, plugin)
        self.assertEqual(_core.tag_of_plugin("quasilux_ies"), "emitter")
        self.assertEqual(_core.tag_of_plugin("spere"), "")

    def test_files_are_found_from_the_folder(self):
        sky = {"type": "bitmap", "filename": "checker.ppm"}
        scene = lit_floor(8, floor={"type": "rectangle", "bsdf": {"type": "diffuse", "reflectance": sky}})
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "checker.ppm").write_bytes(b"P6\n1 1\n255\n\x80\x80\x80")
            ql.load(scene, folder=folder)
            with self.assertRaisesRegex(ql.SceneError, "scene.floor.bsdf.reflectance.filename: "):
                ql.load(scene)


class Meshes(unittest.TestCase):
    def test_arrays_are_a_mesh(self):
        """Of a rectangle, whose two triangles are known."""
        plain = lit_floor(16)
        corners = numpy.array([[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]])
        plain["floor"] = {"type": "mesh", "vertices": corners, "faces": FACES, "face_normals": True}
        rectangle = ql.render(ql.load(lit_floor(16)), passes=16, photons=2000, seed=3, fixed=True).image
        array = ql.render(ql.load(plain), passes=16, photons=2000, seed=3, fixed=True).image
        numpy.testing.assert_allclose(array.mean(), rectangle.mean(), rtol=0.01)

    def test_arrays_are_those_of_a_file(self):
        normals = VERTICES - (0.2, 0.2, -1)
        texture = {"type": "diffuse", "reflectance": {"type": "mesh_attribute", "name": "vertex_color"}}
        array = mesh(normals=normals, uv=VERTICES[:, :2], vertex_color=abs(VERTICES), bsdf=texture, to_world=ql.scale(3))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh.ply"
            names = "x y z nx ny nz u v color_x color_y color_z".split()
            rows = numpy.hstack([VERTICES, normals, VERTICES[:, :2], abs(VERTICES)])
            text = ["ply", "format ascii 1.0", "element vertex 4", *(f"property double {name}" for name in names),
                    "element face 2", "property list uchar int vertex_indices", "end_header",
                    *(" ".join(repr(float(value)) for value in row) for row in rows), "3 0 1 2", "3 0 2 3"]
            path.write_text("\n".join(text) + "\n")
            file = {"type": "ply", "filename": str(path), "bsdf": texture, "to_world": ql.scale(3)}
            self.assertEqual(bits_of(lit_floor(16, plate=array)), bits_of(lit_floor(16, plate=file)))
        self.assertNotEqual(bits_of(lit_floor(16, plate={**array, "vertex_color": VERTICES * 0})), bits_of(lit_floor(16, plate=array)), "control")

    def test_nothing_is_left(self):
        with tempfile.TemporaryDirectory() as folder:
            before, tempfile.tempdir = tempfile.tempdir, folder
            try:
                ql.load(lit_floor(8, plate=mesh()))
                with self.assertRaises(ql.SceneError):
                    ql.load(lit_floor(8, plate=mesh(), other=mesh(faces=FACES + 9)))
                self.assertEqual(os.listdir(folder), [])
            finally:
                tempfile.tempdir = before


class Package(unittest.TestCase):
    def test_the_stubs_are_of_the_module(self):
        folder = Path(ql.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        stubs = {}
        for node in ast.parse((folder / "_core.pyi").read_text()).body:
            if isinstance(node, ast.ClassDef):
                stubs[node.name] = {inner.name for inner in node.body if isinstance(inner, ast.FunctionDef)}
            elif isinstance(node, (ast.FunctionDef, ast.AnnAssign)):
                stubs[node.name if isinstance(node, ast.FunctionDef) else node.target.id] = set()
        def public(thing):
            return {name for name in vars(thing) if not name.startswith("_")}
        self.assertEqual(set(stubs), public(_core) | {"__version__"})
        for name in ("Scene", "Progress", "Rendered"):
            self.assertEqual(stubs[name], public(getattr(_core, name)), name)

    def test_all_that_is_public_is_documented(self):
        for name in ql.__all__:
            if name != "__version__":
                self.assertTrue(getattr(ql, name).__doc__ or name in ("InputError", "DeviceError"), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

#!/usr/bin/env python3
"""Dicts as they are written for Mitsuba's load_dict: each becomes the scene of the XML beside it, to the bit of what kernels read. What Mitsuba
3.9 takes, and by which rules, was tried with it. load_dict_test.py PROGRAM SOURCE_FOLDER."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import OpenImageIO

import quasilux as ql
from quasilux import _core

SOURCE = sys.argv[2]


def mitsuba(name, values, **more):
    """Stands in for what Mitsuba has: neither list nor NumPy array, but convertible to one, of the shape that it has there."""
    array = numpy.array(values, dtype=numpy.float32)
    members = {"__module__": "mitsuba", "__array__": lambda self, dtype=None, copy=None: array if dtype is None else array.astype(dtype), **more}
    return type(name, (), members)()


def transform(matrix):
    """``mi.ScalarTransform4f``, which is no array itself."""
    return type("AffineTransform4f", (), {"__module__": "mitsuba", "matrix": mitsuba("Matrix4f", matrix)})()


def matrix_text(matrix):
    return " ".join(repr(float(entry)) for entry in numpy.asarray(matrix).ravel())


PLACE = numpy.float32([[0.5, 0, 0.25, 1 / 3], [0, 2, 0, 0.1], [-0.25, 0, 0.5, -0.2], [0, 0, 0, 1]])
EYE = ql.look_at(origin=(0, 1, 5), target=(0, 0.5, 0), up=(0, 1, 0))

SENSOR = {
    "type": "perspective",
    "fov": 39.3077,
    "fov_axis": "smaller",
    "near_clip": 0.001,
    "far_clip": 100.0,
    "focus_distance": 1000,
    "to_world": EYE,
    "film": {"type": "hdrfilm", "width": 24, "height": 16, "rfilter": {"type": "gaussian"}, "pixel_format": "rgb", "component_format": "float32"},
    "sampler": {"type": "independent", "sample_count": 64},
}
SENSOR_XML = f"""<sensor type="perspective"><float name="fov" value="39.3077"/><string name="fov_axis" value="smaller"/>
    <float name="near_clip" value="0.001"/><float name="far_clip" value="100"/><float name="focus_distance" value="1000"/>
    <transform name="to_world"><matrix value="{matrix_text(EYE)}"/></transform>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/><rfilter type="gaussian"/>
    <string name="pixel_format" value="rgb"/><string name="component_format" value="float32"/></film>
    <sampler type="independent"><integer name="sample_count" value="64"/></sampler></sensor>"""
LAMP = {"type": "point", "position": [0, 4, 1], "intensity": {"type": "spectrum", "value": 40.0}}
LAMP_XML = '<emitter type="point"><point name="position" x="0" y="4" z="1"/><spectrum name="intensity" value="40"/></emitter>'


class Dicts(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def sums_of(self, xml):
        path = self.folder / "scene.xml"
        path.write_text(f'<scene version="3.0.0">{SENSOR_XML}{LAMP_XML}{xml}</scene>')
        return _core.checksums(ql.load(path))

    def check(self, entries, xml, *control):
        """`control`: a text in the XML, and another one that makes it another scene."""
        found = _core.checksums(ql.load({"sensor": SENSOR, "lamp": LAMP, **entries}, folder=self.folder))
        self.assertEqual(found, self.sums_of(xml))
        self.assertIn(control[0], xml)
        self.assertNotEqual(found, self.sums_of(xml.replace(*control)), "control")

    def ball(self, bsdf, xml, control):
        """A ball of that bsdf."""
        self.check({"ball": {"type": "sphere", "bsdf": bsdf}}, f'<shape type="sphere">{xml}</shape>', *control)

    def test_box(self):
        """As mitsuba.cornell_box() is written."""
        self.check({
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 8},
            "white": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.885809, 0.698859, 0.666422]}},
            "light": {"type": "rectangle", "to_world": transform(PLACE), "bsdf": {"type": "ref", "id": "white"},
                      "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [18.387, 13.9873, 6.75357]}}},
            "floor": {"type": "rectangle", "to_world": transform(PLACE[:, :, None]), "bsdf": {"type": "ref", "id": "white"}},
            "small-box": {"type": "cube", "to_world": PLACE.tolist(), "bsdf": {"type": "ref", "id": "white"}},
        }, f"""<integrator type="path"><integer name="max_depth" value="8"/></integrator>
            <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.885809, 0.698859, 0.666422"/></bsdf>
            <shape type="rectangle"><transform name="to_world"><matrix value="{matrix_text(PLACE)}"/></transform><ref id="white"/>
                <emitter type="area"><rgb name="radiance" value="18.387, 13.9873, 6.75357"/></emitter></shape>
            <shape type="rectangle"><transform name="to_world"><matrix value="{matrix_text(PLACE)}"/></transform><ref id="white"/></shape>
            <shape type="cube"><transform name="to_world"><matrix value="{matrix_text(PLACE)}"/></transform><ref id="white"/></shape>""",
            'value="8"', 'value="9"')

    def test_references_by_key_by_id_and_by_path(self):
        entries = {
            "before": {"type": "sphere", "bsdf": {"type": "ref", "id": "later"}},
            "later": {"type": "diffuse", "id": "named", "reflectance": 0.25},
            "by_id": {"type": "sphere", "center": [2, 0, 0], "bsdf": {"type": "ref", "id": "named"}},
            "deep": {"type": "sphere", "center": [4, 0, 0], "coat": {"type": "plastic", "diffuse_reflectance": 0.75}},
            "by_path": {"type": "sphere", "center": [6, 0, 0], "bsdf": {"type": "ref", "id": "deep.coat"}},
        }
        self.check(entries, """<bsdf type="diffuse" id="a"><float name="reflectance" value="0.25"/></bsdf>
            <shape type="sphere"><ref id="a"/></shape>
            <shape type="sphere"><point name="center" value="2, 0, 0"/><ref id="a"/></shape>
            <shape type="sphere"><point name="center" value="4, 0, 0"/><bsdf type="plastic" id="b"><float name="diffuse_reflectance" value="0.75"/></bsdf></shape>
            <shape type="sphere"><point name="center" value="6, 0, 0"/><ref id="b"/></shape>""", '"0.75"', '"0.7"')
        with self.assertRaisesRegex(ql.SceneError, "the id 'later' is already in use at scene.other"):
            ql.load({"sensor": SENSOR, "lamp": LAMP, **entries, "other": {"type": "diffuse", "id": "later"}})

    def test_numbers_of_all_libraries(self):
        ball = {"type": "sphere", "center": mitsuba("Point3f", [[1], [2], [1 / 3]]), "radius": mitsuba("Float", [0.1]), "flip_normals": numpy.bool_(False)}
        disk = {"type": "disk", "to_world": numpy.float64(PLACE), "bsdf": {"type": "roughconductor", "alpha": numpy.array(0.25)}}
        rod = {"type": "cylinder", "p0": (0, 1, 2), "p1": numpy.array([1, 1, 2]), "radius": numpy.float32(0.5), "bsdf": {"type": "diffuse", "reflectance": 1}}
        film = {**SENSOR["film"], "width": numpy.int64(24), "height": numpy.int32(16)}
        self.check({"sensor": {**SENSOR, "film": film}, "ball": ball, "disk": disk, "rod": rod}, f"""
            <shape type="sphere"><point name="center" value="1, 2, {float(numpy.float32(1 / 3))}"/><float name="radius" value="{float(numpy.float32(0.1))}"/></shape>
            <shape type="disk"><transform name="to_world"><matrix value="{matrix_text(PLACE)}"/></transform>
                <bsdf type="roughconductor"><float name="alpha" value="0.25"/></bsdf></shape>
            <shape type="cylinder"><point name="p0" value="0, 1, 2"/><point name="p1" value="1, 1, 2"/><float name="radius" value="0.5"/>
                <bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></shape>""", '"1, 1, 2"', '"1, 1, 2.5"')

    def test_colours(self):
        rgb = '<bsdf type="diffuse"><rgb name="reflectance" value="0.25, 0.5, 0.125"/></bsdf>'
        ways = [{"type": "rgb", "value": [0.25, 0.5, 0.125]}, {"type": "rgb", "value": numpy.float32([0.25, 0.5, 0.125])},
                {"type": "rgb", "value": mitsuba("Color3f", [[0.25], [0.5], [0.125]])}, mitsuba("Color3f", [0.25, 0.5, 0.125]),
                {"type": "srgb", "color": [0.25, 0.5, 0.125]}]
        for way in ways:
            with self.subTest(way=way):
                self.ball(bsdf={"type": "diffuse", "reflectance": way}, xml=rgb, control=("0.125", "0.25"))
        for grey in (0.5, {"type": "rgb", "value": 0.5}, {"type": "spectrum", "value": 0.5}, {"type": "uniform", "value": 0.5}):
            with self.subTest(grey=grey):
                self.ball(bsdf={"type": "diffuse", "reflectance": grey}, xml='<bsdf type="diffuse"><float name="reflectance" value="0.5"/></bsdf>',
                          control=('"0.5"', '"0.25"'))
        with self.assertRaisesRegex(ql.SceneError, "scene.ball.reflectance: "):  # Mitsuba refuses it, too
            ql.load({"sensor": SENSOR, "lamp": LAMP, "ball": {"type": "diffuse", "reflectance": [0.1, 0.2, 0.3]}})

    def test_spectra(self):
        pairs = [(400.0, 0.1), (500.0, 0.8), (700, 0.25)]
        for value in (pairs, [list(pair) for pair in pairs], numpy.array(pairs)):
            self.ball(bsdf={"type": "diffuse", "reflectance": {"type": "spectrum", "value": value}},
                      xml='<bsdf type="diffuse"><spectrum name="reflectance" value="400:0.1, 500:0.8, 700:0.25"/></bsdf>', control=("0.8", "0.7"))
        (self.folder / "grey.spd").write_text("400 0.1\n700 0.3\n")
        self.ball(bsdf={"type": "diffuse", "reflectance": {"type": "spectrum", "filename": "grey.spd"}},
                  xml='<bsdf type="diffuse"><spectrum name="reflectance" filename="grey.spd"/></bsdf>', control=('filename="grey.spd"', 'value="0.2"'))
        self.ball(bsdf={"type": "diffuse", "reflectance": {"type": "irregular", "wavelengths": "400, 700", "values": "0.1, 0.3"}},
                  xml='<bsdf type="diffuse"><spectrum name="reflectance" value="400:0.1, 700:0.3"/></bsdf>', control=("0.3", "0.4"))

    def test_bsdfs(self):
        self.ball(bsdf={"type": "twosided", "material": {"type": "conductor", "material": "Au"}},
                  xml='<bsdf type="twosided"><bsdf type="conductor"><string name="material" value="Au"/></bsdf></bsdf>', control=("Au", "Cu"))
        self.ball(bsdf={"type": "dielectric", "int_ior": "bk7", "ext_ior": "air"},
                  xml='<bsdf type="dielectric"><string name="int_ior" value="bk7"/><string name="ext_ior" value="air"/></bsdf>', control=("bk7", "water"))
        self.ball(bsdf={"type": "blendbsdf", "weight": 0.25, "bsdf_0": {"type": "conductor"}, "bsdf_1": {"type": "roughplastic", "alpha": 0.2, "nonlinear": True}},
                  xml="""<bsdf type="blendbsdf"><float name="weight" value="0.25"/><bsdf type="conductor"/>
                      <bsdf type="roughplastic"><float name="alpha" value="0.2"/><boolean name="nonlinear" value="true"/></bsdf></bsdf>""",
                  control=('"0.25"', '"0.75"'))
        self.ball(bsdf={"type": "mask", "opacity": 0.5, "nested": {"type": "principled", "base_color": {"type": "rgb", "value": [1.0, 0.5, 0.25]}, "roughness": 0.4,
                                                                "metallic": 0, "spec_tint": 0.5}},
                  xml="""<bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="principled"><rgb name="base_color" value="1, 0.5, 0.25"/>
                      <float name="roughness" value="0.4"/><float name="metallic" value="0"/><float name="spec_tint" value="0.5"/></bsdf></bsdf>""",
                  control=('"0.4"', '"0.45"'))

    def test_shapes(self):
        group = {"type": "shapegroup", "first": {"type": "cube", "bsdf": {"type": "diffuse", "reflectance": 0.25}}, "second": {"type": "rectangle"}}
        (self.folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        entries = {"group": group, "one": {"type": "instance", "to_world": transform(PLACE), "shapegroup": {"type": "ref", "id": "group"}},
                   "mesh": {"type": "obj", "filename": "flat.obj", "face_normals": True, "to_world": transform(PLACE)}}
        place = f'<transform name="to_world"><matrix value="{matrix_text(PLACE)}"/></transform>'
        self.check(entries, f"""<shape type="shapegroup" id="group"><shape type="cube"><bsdf type="diffuse"><float name="reflectance" value="0.25"/></bsdf></shape>
            <shape type="rectangle"/></shape><shape type="instance">{place}<ref id="group"/></shape>
            <shape type="obj"><string name="filename" value="flat.obj"/><boolean name="face_normals" value="true"/>{place}</shape>""",
            'type="rectangle"', 'type="disk"')

    def test_emitters(self):
        beam = {"type": "directional", "direction": [0, -1, 0.5], "irradiance": {"type": "rgb", "value": 2.0}}
        spot = {"type": "spot", "cutoff_angle": 25, "to_world": transform(EYE), "intensity": {"type": "spectrum", "value": 3.0}}
        sky = {"type": "constant", "radiance": {"type": "d65", "scale": 0.5}}
        ball = {"type": "sphere", "glow": {"type": "ref", "id": "glow"}}
        glow = {"type": "area", "radiance": {"type": "blackbody", "temperature": 3000}}
        self.check({"beam": beam, "spot": spot, "sky": sky, "glow": glow, "ball": ball}, f"""
            <emitter type="directional"><vector name="direction" value="0, -1, 0.5"/><rgb name="irradiance" value="2"/></emitter>
            <emitter type="spot"><float name="cutoff_angle" value="25"/><transform name="to_world"><matrix value="{matrix_text(numpy.float32(EYE))}"/></transform>
                <spectrum name="intensity" value="3"/></emitter>
            <emitter type="constant"><rgb name="radiance" value="0.5"/></emitter>
            <shape type="sphere"><emitter type="area"><texture type="blackbody" name="radiance"><float name="temperature" value="3000"/></texture></emitter></shape>""",
            '"25"', '"30"')

    def test_media(self):
        fog = {"type": "homogeneous", "albedo": {"type": "rgb", "value": [0.9, 0.5, 0.25]}, "sigma_t": 0.5, "phase": {"type": "hg", "g": 0.3}}
        self.check({"ball": {"type": "sphere", "bsdf": {"type": "null"}, "interior": fog}}, """<shape type="sphere"><bsdf type="null"/>
            <medium type="homogeneous" name="interior"><rgb name="albedo" value="0.9, 0.5, 0.25"/><float name="sigma_t" value="0.5"/>
            <phase type="hg"><float name="g" value="0.3"/></phase></medium></shape>""", '"0.3"', '"0.2"')

    def test_volumes_from_arrays(self):
        values = numpy.float32(numpy.arange(24).reshape(2, 3, 4) / 24)
        header = b"VOL\x03" + numpy.array([1, 4, 3, 2, 1], "<i4").tobytes() + numpy.array([0, 0, 0, 1, 1, 1], "<f4").tobytes()
        (self.folder / "cloud.vol").write_bytes(header + values.tobytes())
        xml = """<shape type="cube"><bsdf type="null"/><medium type="heterogeneous" name="interior"><float name="scale" value="2"/><volume type="gridvolume" name="sigma_t">
            <string name="filename" value="cloud.vol"/><string name="filter_type" value="trilinear"/></volume><float name="albedo" value="0.8"/></medium></shape>"""
        for key, data in (("filename", "cloud.vol"), ("data", values), ("data", mitsuba("TensorXf", values[:, :, :, None])), ("grid", mitsuba("VolumeGrid", values))):
            with self.subTest(key=key, data=type(data)):
                cloud = {"type": "heterogeneous", "scale": 2.0, "sigma_t": {"type": "gridvolume", key: data, "filter_type": "trilinear"}, "albedo": 0.8}
                self.check({"cube": {"type": "cube", "bsdf": {"type": "null"}, "interior": cloud}}, xml, "trilinear", "nearest")

    def write_picture(self, name, pixels):
        height, width, channels = pixels.shape
        kind = OpenImageIO.UINT8 if pixels.dtype == numpy.uint8 else OpenImageIO.FLOAT
        output = OpenImageIO.ImageOutput.create(name)
        output.open(str(self.folder / name), OpenImageIO.ImageSpec(width, height, channels, kind))
        output.write_image(numpy.ascontiguousarray(pixels))
        output.close()

    def picture_checks(self, name, pixels, ways, raw=False):
        """Each of the textures `ways` is that of the file."""
        self.write_picture(name, pixels)
        text = f'<string name="filename" value="{name}"/>' + ('<boolean name="raw" value="true"/>' if raw else "")
        xml = f'<bsdf type="diffuse"><texture type="bitmap" name="reflectance">{text}</texture></bsdf>'
        for way in ways:
            with self.subTest(way=list(way)):
                self.ball(bsdf={"type": "diffuse", "reflectance": {"type": "bitmap", **way}}, xml=xml,
                          control=("</texture>", '<string name="wrap_mode" value="clamp"/></texture>'))

    def test_pictures_from_arrays(self):
        floats = numpy.float32(numpy.arange(36).reshape(3, 4, 3) / 36)
        alpha = numpy.concatenate([floats, numpy.ones((3, 4, 1), numpy.float32)], axis=2)
        self.picture_checks("floats.exr", floats, [{"filename": "floats.exr"}, {"bitmap": floats}, {"bitmap": mitsuba("Bitmap", floats)},
                                                   {"data": mitsuba("TensorXf", floats), "raw": True}, {"data": floats.tolist()}, {"bitmap": alpha},
                                                   {"bitmap": floats.astype(numpy.float64)}])
        grey = floats[:, :, :1]
        self.picture_checks("grey.exr", grey, [{"bitmap": grey}, {"bitmap": grey[:, :, 0]}, {"data": mitsuba("TensorXf", grey), "raw": True}])

    def test_pictures_of_bytes(self):
        whole = numpy.uint8(7 * numpy.arange(36).reshape(3, 4, 3))

        def bitmap(is_encoded):
            made = mitsuba("Bitmap", 0, srgb_gamma=lambda self: is_encoded)
            type(made).__array__ = lambda self, dtype=None, copy=None: whole
            return made

        self.picture_checks("whole.png", whole, [{"filename": "whole.png"}, {"bitmap": whole}, {"bitmap": bitmap(True)}])
        self.picture_checks("whole.png", whole, [{"bitmap": whole, "raw": True}, {"bitmap": bitmap(True), "raw": True}], raw=True)
        self.picture_checks("linear.exr", numpy.float32(whole / 255), [{"bitmap": bitmap(False)}])

    def test_surroundings_from_an_array(self):
        sky = numpy.float32(1 + numpy.arange(96).reshape(4, 8, 3))
        self.write_picture("sky.exr", sky)
        self.check({"sky": {"type": "envmap", "bitmap": mitsuba("Bitmap", sky), "scale": 2.0}, "ball": {"type": "sphere"}},
                   '<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="2"/></emitter><shape type="sphere"/>', '"2"', '"3"')

    def test_transforms_of_textures(self):
        plane = numpy.array([[5, 0, 0.25], [0, 4, 0.5], [0, 0, 1]])
        text = '<texture type="checkerboard" name="reflectance"><transform name="to_uv"><scale x="5" y="4"/><translate x="0.25" y="0.5"/></transform></texture>'
        for matrix in (transform(plane), transform(plane[:, :, None]), plane, ql.translate((0.25, 0.5, 0)) @ ql.scale((5, 4, 1))):
            self.ball(bsdf={"type": "diffuse", "reflectance": {"type": "checkerboard", "to_uv": matrix}}, xml=f'<bsdf type="diffuse">{text}</bsdf>',
                      control=('"0.25"', '"0.5"'))
        with self.assertRaisesRegex(ql.SceneError, "scene.ball.to_world: "):
            ql.load({"sensor": SENSOR, "lamp": LAMP, "ball": {"type": "sphere", "to_world": plane}})

    def test_what_is_no_dict(self):
        loaded = type("Mesh", (), {"__module__": "mitsuba", "class_name": lambda self: "Mesh"})()
        cases = [
            ({"ball": loaded}, "scene.ball: is an object that Mitsuba has loaded, mitsuba.Mesh; expected the dict"),
            ({"ball": {"type": "sphere", "bsdf": loaded}}, "scene.ball.bsdf: is an object that Mitsuba has loaded"),
            ({"ball": {"type": "sphere", "radius": numpy.ones(2)}}, "scene.ball.radius: "),
            ({"map": {"type": "bitmap", "bitmap": numpy.zeros((2, 2, 5))}}, r"scene.map.bitmap: has the shape \(2, 2, 5\)"),
            ({"map": {"type": "bitmap", "bitmap": numpy.zeros((2, 2), complex)}}, "scene.map.bitmap: is .*expected an array"),
            ({"map": {"type": "bitmap", "bitmap": numpy.zeros((2, 2), int)}}, "scene.map.bitmap: is an array of int64"),
            ({"map": {"type": "bitmap", "data": numpy.zeros((2, 2)), "filename": "x.exr"}}, "scene.map.data: is given beside a filename"),
            ({"grid": {"type": "gridvolume", "data": numpy.zeros((2, 2))}}, r"scene.grid.data: is an array of float64 of the shape \(2, 2\)"),
        ]
        for entries, said in cases:
            with self.subTest(said=said), self.assertRaisesRegex(ql.SceneError, said):
                ql.load({"sensor": SENSOR, "lamp": LAMP, "floor": {"type": "rectangle"}, **entries})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

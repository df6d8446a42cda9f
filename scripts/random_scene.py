"""Scenes made up at random, in the language that quasilux and Mitsuba 3 read, for scripts/random_scenes.py."""
import math
import random
import struct

import numpy as np
import OpenImageIO as oiio

CELLS = [(x, y, z) for x in (-1.1, 0, 1.1) for y in (-0.9, 0.6) for z in (-0.9, 0.3)]
CELL = 0.54  # radius of the ball that holds a shape
MIRROR = '<scale x="-1"/>'


def write_image(folder, name, pixels):
    height, width, channels = pixels.shape
    kind = "float" if name.endswith(".exr") else "uint8"
    file = oiio.ImageOutput.create(str(folder / name))
    file.open(str(folder / name), oiio.ImageSpec(width, height, channels, kind))
    file.write_image(pixels.astype(np.float32))
    file.close()


def write_files(folder):
    """Textures, a sky, grids and a ball of flat facets, which all scenes use; once, since other runs may read them."""
    if (folder / "ball.ply").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(1)
    write_image(folder, "colours.png", 0.1 + 0.8 * rng.random((4, 5, 3)))
    write_image(folder, "grey.png", 0.1 + 0.8 * rng.random((5, 3, 1)))
    write_image(folder, "lamp.exr", 3 * rng.random((3, 4, 3)) ** 2)
    write_image(folder, "sky.exr", 0.2 + rng.random((8, 16, 3)) + 4 * (rng.random((8, 16, 1)) > 0.95))
    write_image(folder, "normals.png", np.clip(rng.random((4, 4, 3)) * (0.4, 0.4, 0) + (0.3, 0.3, 0.95), 0, 1))
    for name, shape in (("density.vol", (4, 3, 5, 1)), ("albedo.vol", (3, 4, 2, 3))):
        header = struct.pack("<3sB5i6f", b"VOL", 3, 1, *shape[2::-1], shape[3], 0, 0, 0, 1, 1, 1)
        (folder / name).write_bytes(header + (0.1 + 0.85 * rng.random(shape)).astype("<f4").tobytes())
    columns, rows = 8, 6
    lines, faces = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            a, b = 2 * math.pi * (i % columns) / columns, math.pi * j / rows
            colour = 0.5 + 0.4 * np.sin([3 * a, 2 * b, a + b])
            place = math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), math.cos(b)
            lines.append(" ".join(f"{value:.6f}" for value in (*place, i / columns, j / rows, *colour)))
    for j in range(rows):
        for i in range(columns):
            at = j * (columns + 1) + i
            faces += [f"3 {at} {at + columns + 1} {at + columns + 2}"] * (j < rows - 1) + [f"3 {at} {at + columns + 2} {at + 1}"] * (j > 0)
    properties = "".join(f"property float {name}\n" for name in "x y z u v r g b".split())
    (folder / "ball.ply").write_text(f"ply\nformat ascii 1.0\nelement vertex {len(lines)}\n{properties}element face {len(faces)}\n"
                                  "property list uchar int vertex_indices\nend_header\n" + "\n".join(lines + faces) + "\n")


def tag(kind, plugin, *children, **attributes):
    given = "".join(f' {name}="{value}"' for name, value in attributes.items() if value)
    return f'<{kind} type="{plugin}"{given}>' + "".join(children) + f"</{kind}>"


def value(kind, name, given):
    if kind == "boolean":
        given = "true" if given else "false"
    elif kind == "float":
        given = f"{given:.3f}"
    return f'<{kind} name="{name}" value="{given}"/>'


def triple(values):
    return ",".join(f"{v:.3f}" for v in values)


class Maker:
    """One scene. `points`: lit by points too, so that nothing is smooth; `passages`: needs volpath."""

    def __init__(self, key, width, height):
        self.rng, self.width, self.height = random.Random(key), width, height
        self.points, self.passages, self.outside, self.attributes = self.chance(0.35), False, "", False

    def chance(self, share):
        return self.rng.random() < share

    def pick(self, *choices):
        return self.rng.choice(choices)

    def between(self, low, high):
        return self.rng.uniform(low, high)

    def maybe(self, share, *texts):
        return "".join(texts) if self.chance(share) else ""

    # Transforms

    def turn(self):
        axis = np.array([self.rng.gauss(0, 1) for _ in range(3)])
        x, y, z = axis / np.linalg.norm(axis)  # Mitsuba takes it as it is
        return f'<rotate value="{x:.8f}, {y:.8f}, {z:.8f}" angle="{self.between(0, 360):.1f}"/>'

    def placement(self, radius, centre, size, rigid=False, mirrors=True, right_handed=False):
        """A to_world that puts what lies within `radius` of the origin into the ball of `size` about `centre`."""
        matrix = np.eye(3)
        if not rigid and self.chance(0.5):
            matrix = np.diag([self.between(0.4, 1) for _ in range(3)])
            matrix[self.pick((0, 1), (1, 2), (2, 0))] = self.between(-0.6, 0.6) * self.chance(0.6)
        if mirrors and self.chance(0.35):
            matrix = np.diag([self.pick(-1, 1), self.pick(-1, 1), -1]) @ matrix
        if right_handed and np.linalg.det(matrix) < 0:
            matrix = -matrix
        matrix = np.round(matrix * size / radius / np.linalg.norm(matrix, 2), 4)
        operations = f'<matrix value="{" ".join(str(v) for v in matrix.ravel())}"/>' + self.turn()
        return f'<transform name="to_world">{operations}<translate value="{triple(centre)}"/></transform>'

    def to_uv(self):
        return self.maybe(0.6, f'<transform name="to_uv"><scale x="{self.between(-3, 3):.2f}" y="{self.between(0.3, 3):.2f}"/>',
                          f'<rotate z="1" angle="{self.between(0, 360):.0f}"/>', f'<translate x="{self.between(-1, 1):.2f}"/></transform>')

    # Colours and textures

    def colour(self, name, low, high, kinds=("rgb", "float", "spectrum")):
        kind = self.pick(*kinds)
        if kind == "spectrum":
            return value(kind, name, ", ".join(f"{nm}:{self.between(low, high * 0.9):.3f}" for nm in (380, 480, 560, 620, 780)))
        return value(kind, name, self.between(low, high) if kind == "float" else triple(self.between(low, high) for _ in range(3)))

    def bitmap(self, name, file, raw):
        return tag("texture", "bitmap", value("string", "filename", file), value("boolean", "raw", raw), self.to_uv(),
                   value("string", "filter_type", self.pick("bilinear", "nearest")),
                   value("string", "wrap_mode", self.pick("repeat", "mirror", "clamp")), name=name)

    def reflectance(self, name="reflectance", low=0.05, high=0.9, depth=1, volumes=True):
        kind = self.pick("colour", "colour", "bitmap", "checkerboard", "volume", "attribute")
        if kind == "bitmap":
            return self.bitmap(name, self.pick("colours.png", "grey.png"), self.chance(0.4))
        if kind == "checkerboard" and depth:
            return tag("texture", kind, self.reflectance("color0", low, high, 0, volumes), self.reflectance("color1", low, high, 0, volumes),
                       self.to_uv(), name=name)
        if kind == "volume" and volumes:  # it has no mean, which plastic asks for
            return tag("texture", kind, self.grid("volume", "albedo.vol", (0, 0, 0), 2), name=name)
        if kind == "attribute" and self.attributes and volumes:
            return tag("texture", "mesh_attribute", value("string", "name", "vertex_color"), name=name)
        return self.colour(name, low, high)

    def number(self, name, low, high):
        if self.chance(0.7):
            return value("float", name, self.between(low, high))
        if self.chance(0.5):
            return self.bitmap(name, self.pick("grey.png", "colours.png"), True)
        return tag("texture", "checkerboard", value("float", "color0", self.between(low, high)), value("float", "color1", self.between(low, high)),
                   self.to_uv(), name=name)

    # Bsdfs

    def indices(self):
        return self.maybe(0.7, value("float", "int_ior", self.between(1.2, 2)), self.maybe(0.4, value("float", "ext_ior", self.between(1.0, 2.2))))

    def roughness(self, textured=True):
        low = 0.15 if self.points else 0.06
        kind = value("string", "distribution", self.pick("ggx", "beckmann"))
        if textured and self.chance(0.35):
            return kind + value("float", "alpha_u", self.between(low, 0.6)) + value("float", "alpha_v", self.between(low, 0.6))
        return kind + (self.number("alpha", low, 0.6) if textured else value("float", "alpha", self.between(low, 0.6)))

    def factor(self, name):
        return self.maybe(0.4, self.reflectance(name, 0.3))

    def metal(self, kind):
        index = self.pick(value("string", "material", self.pick("Au", "Cu", "Al", "W", "none")),
                          self.colour("eta", 0.2, 2, ("rgb",)) + self.colour("k", 1, 4, ("rgb",)))
        return tag("bsdf", kind, index, self.roughness() if kind == "roughconductor" else "", self.factor("specular_reflectance"))

    def coated(self, kind):
        factor = self.maybe(0.4, self.reflectance("specular_reflectance", 0.3, volumes=False))
        return tag("bsdf", kind, self.indices(), self.reflectance("diffuse_reflectance", volumes=False), factor,
                   value("boolean", "nonlinear", self.chance(0.4)), self.roughness(False) if kind == "roughplastic" else "")

    def glass(self, kind):
        return tag("bsdf", kind, self.indices(), self.factor("specular_reflectance"), self.factor("specular_transmittance"),
                   self.roughness() if kind == "roughdielectric" else "")

    def principled(self, kind, glassy):
        thin = kind == "principledthin"
        names = ["anisotropic", "spec_tint", "sheen", "sheen_tint", "flatness"] + ["metallic", "clearcoat", "clearcoat_gloss"] * (not thin)
        some = "".join(self.maybe(0.4, self.number(name, 0, 1)) for name in names)
        some += self.number("spec_trans", 0.2, 0.9) if glassy else ""
        some += self.maybe(0.5, value("float", "eta", self.between(1.1, 1.9))) + self.maybe(0.5 * thin, self.number("diff_trans", 0, 1))
        return tag("bsdf", kind, self.reflectance("base_color"), self.number("roughness", 0.35, 0.9), some)

    def relief(self, inner):
        if self.chance(0.5):
            return tag("bsdf", "normalmap", self.bitmap("normalmap", "normals.png", True), inner)
        heights = self.bitmap("", "grey.png", True).replace("nearest", "bilinear")
        return tag("bsdf", "bumpmap", heights, value("float", "scale", self.between(-0.15, 0.15)), inner)

    def one_sided(self, depth, relief=True):
        kinds = ["diffuse", "diffuse", "roughconductor", "roughplastic", "principled"] + ["conductor", "plastic"] * (not self.points)
        kind = self.pick(*kinds, *["blendbsdf", "relief"] * (depth > 0))
        if kind == "blendbsdf":
            return tag("bsdf", kind, self.one_sided(depth - 1, False), self.one_sided(depth - 1, False), self.number("weight", 0, 1))
        if kind == "relief" and relief:
            return self.relief(self.one_sided(depth - 1, False))
        if kind in ("conductor", "roughconductor"):
            return self.metal(kind)
        if kind in ("plastic", "roughplastic"):
            return self.coated(kind)
        return self.principled(kind, False) if kind == "principled" else tag("bsdf", "diffuse", self.reflectance())

    def bsdf(self, depth=2, relief=True):
        kinds = ["one", "one", "twosided", "twosided", "roughdielectric", "principled", "principledthin"]
        kind = self.pick(*kinds, *["dielectric", "thindielectric"] * (not self.points), *["mask", "blendbsdf", "relief"] * (depth > 0))
        if kind == "twosided":
            return tag("bsdf", kind, self.one_sided(depth, relief), self.maybe(0.5, self.one_sided(depth, False)))
        if kind == "mask":
            self.passages = True
            return tag("bsdf", kind, self.number("opacity", 0, 1), self.bsdf(depth - 1, relief))
        if kind == "blendbsdf":
            parts = [tag("bsdf", "twosided", self.one_sided(depth - 1, False)) for _ in range(2)]  # no glass
            return tag("bsdf", kind, *parts, self.number("weight", 0, 1))
        if kind == "relief" and relief:
            return self.relief(self.bsdf(depth - 1, False))
        if kind in ("principled", "principledthin"):
            return self.principled(kind, kind == "principledthin" or self.chance(0.5))
        return self.glass(kind) if "dielectric" in kind else self.one_sided(depth, relief)

    # Media

    def grid(self, name, file, centre, size):
        place = f'<translate value="-0.5,-0.5,-0.5"/><scale value="{2 * size:.3f}"/>{self.turn()}<translate value="{triple(centre)}"/>'
        return tag("volume", "gridvolume", value("string", "filename", file), f'<transform name="to_world">{place}</transform>',
                   value("string", "filter_type", self.pick("trilinear", "nearest")),
                   value("string", "wrap_mode", self.pick("clamp", "repeat", "mirror")), name=name)

    def phase(self, depth=1):
        kind = self.pick("isotropic", "hg", "rayleigh", "tabphase", *["blendphase"] * depth)
        inner = {"hg": lambda: value("float", "g", self.between(-0.7, 0.8)), "tabphase": lambda: value("string", "values", "0.5, 0.2, 0.1, 0.6, 1.5"),
                 "blendphase": lambda: value("float", "weight", self.between(0, 1)) + self.phase(0) + self.phase(0)}
        return tag("phase", kind, inner.get(kind, str)())

    def medium(self, name, centre, size, thin=1):
        self.passages = True
        if self.chance(0.4):
            albedo = self.grid("albedo", "albedo.vol", centre, size) if self.chance(0.5) else self.colour("albedo", 0.3, 0.95)
            return tag("medium", "heterogeneous", self.grid("sigma_t", "density.vol", centre, size), albedo,
                       value("float", "scale", self.between(0.5, 3) * thin), self.phase(), name=name)
        return tag("medium", "homogeneous", self.colour("sigma_t", 0.1, 1), value("float", "scale", self.between(0.5, 2.5) * thin),
                   self.colour("albedo", 0.3, 0.95), self.phase(), name=name)

    # Shapes and lights

    def shape(self, centre, size, light="", medium=False, group=False):
        kind = self.pick(*["sphere"] * (not group), "cube", "ball", *[] if medium else ["rectangle", "disk", "cylinder"])
        self.attributes = kind == "ball" and not group  # Mitsuba looks those of instances up where they are not
        radius = {"rectangle": 1.4143, "cube": 1.7321}.get(kind, 1)
        inside = value("boolean", "flip_normals", True) if not medium and self.chance(0.3) else ""
        # Mirrored, Mitsuba fills the outside; normals of a mirrored cube look inwards (docs/notes/validation.md).
        inside += self.placement(radius, centre, size, kind in ("sphere", "cylinder"), not medium, kind == "cube")
        if kind == "cylinder":
            inside += '<point name="p0" value="0,0,-0.8"/><point name="p1" value="0,0,0.7"/>' + value("float", "radius", 0.5)
        if kind == "ball":
            inside += value("string", "filename", "ball.ply") + value("boolean", "face_normals", True)
        if medium:
            borders = ["null", "null", "roughdielectric"] + ["dielectric"] * (not self.points)
            border = self.pick(*borders, "mask")
            self.passages = True
            inside += tag("bsdf", "null") if border == "null" else self.glass(border) if border != "mask" else tag(
                "bsdf", border, self.number("opacity", 0, 1), self.bsdf(0))
            inside += self.medium("interior", centre, size) + self.outside.replace("NAME", "exterior")
        elif light:
            if kind in ("cube", "sphere"):  # textured Mitsuba samples them wrongly (docs/notes/validation.md)
                light = tag("emitter", "area", self.colour("radiance", 1, 8, ("rgb",)))
            inside += light + self.maybe(0.3, tag("bsdf", "diffuse", self.reflectance()))
        else:
            inside += self.bsdf()
        return tag("shape", "ply" if kind == "ball" else kind, inside)

    def area(self):
        texture = self.pick(self.colour("radiance", 1, 8, ("rgb",)), self.bitmap("radiance", "lamp.exr", True))
        return tag("emitter", "area", texture)

    def point_light(self):
        place = [self.between(-3, 3), self.between(-3, -1), self.between(1.5, 3)]
        aim = f'<lookat origin="{triple(place)}" target="{triple(self.between(-0.5, 0.5) for _ in range(3))}" up="0,0.1,1"/>'
        before = self.maybe(0.4, self.pick(MIRROR, '<rotate z="1" angle="70"/>'))
        aim = f'<transform name="to_world">{before}{aim}</transform>'
        strength = self.colour("intensity", 5, 20, ("rgb", "float"))
        kind = self.pick("point", "spot", "projector", "directional")
        if kind == "point":
            return tag("emitter", kind, strength, f'<point name="position" value="{triple(place)}"/>', self.outside.replace("NAME", "medium"))
        if kind == "directional":
            return tag("emitter", kind, self.colour("irradiance", 0.5, 2, ("rgb",)), aim)
        if kind == "projector":
            return tag("emitter", kind, self.bitmap("irradiance", "lamp.exr", True), value("float", "scale", self.between(3, 9)), aim,
                       value("float", "fov", self.between(20, 70)), value("string", "fov_axis", self.pick("x", "y", "larger")))
        texture = self.maybe(0.5, self.bitmap("texture", "colours.png", False))
        return tag("emitter", kind, strength, aim, texture, value("float", "cutoff_angle", self.between(15, 50)),
                   self.maybe(0.4, value("float", "beam_width", self.between(5, 14))))

    def sky(self):
        if self.chance(0.5):
            return tag("emitter", "constant", self.colour("radiance", 0.2, 1, ("rgb",)))
        return tag("emitter", "envmap", value("string", "filename", "sky.exr"), value("float", "scale", self.between(0.3, 1.5)),
                   f'<transform name="to_world">{self.maybe(0.3, MIRROR)}{self.turn()}</transform>')

    def sensor(self):
        place = [self.between(-1.5, 1.5), self.between(-4.6, -4), self.between(-0.8, 1.5)]
        aim = f'<lookat origin="{triple(place)}" target="0,0,-0.3" up="{triple((self.between(-0.3, 0.3), 0, 1))}"/>'
        kind = self.pick("perspective", "perspective", "thinlens", "orthographic")
        scale = '<scale x="1.9" y="1.9"/>' if kind == "orthographic" else ""
        lens = value("float", "fov", self.between(35, 55)) + value("string", "fov_axis", self.pick("x", "y", "diagonal", "larger", "smaller"))
        lens += value("float", "aperture_radius", 0.1) + value("float", "focus_distance", 4) if kind == "thinlens" else ""
        lens += value("float", "principal_point_offset_x", self.between(-0.2, 0.2)) if kind == "perspective" and self.chance(0.3) else ""
        size = f'<integer name="width" value="{self.width}"/><integer name="height" value="{self.height}"/>'
        crop = size.replace("width", "crop_width").replace("height", "crop_height")
        crop += value("integer", "crop_offset_x", 5) + value("integer", "crop_offset_y", 9)
        size = self.pick(size, size, '<integer name="width" value="48"/><integer name="height" value="40"/>' + crop)
        film = tag("film", "hdrfilm", size, value("string", "pixel_format", "rgb"), value("boolean", "sample_border", True),
                   tag("rfilter", self.pick("box", "box", "gaussian", "mitchell")))
        world = f'<transform name="to_world">{scale}{self.maybe(0.25, MIRROR)}{aim}</transform>'
        return tag("sensor", kind, lens if kind != "orthographic" else "", world, film, self.outside.replace("NAME", "medium"))

    def scene(self):
        cells = self.rng.sample(CELLS, 7)
        parts, room = [], self.chance(0.3)
        if self.chance(0.15):  # fog that holds everything
            parts += [self.medium("", (0, 0, 0), 8, 0.15).replace("<medium", '<medium id="fog"', 1)]
            parts += [tag("shape", "sphere", value("float", "radius", 9), tag("bsdf", "null"), '<ref id="fog" name="interior"/>')]
            self.outside = '<ref id="fog" name="NAME"/>'
        lamps = self.rng.randint(1, 2) if room else self.rng.randint(0, 1)
        if room:
            wall = self.pick(("diffuse", "reflectance"), ("roughplastic", "diffuse_reflectance"))
            parts += [tag("shape", "cube", '<transform name="to_world"><scale x="3.5" y="5.5" z="3"/></transform>',
                          value("boolean", "flip_normals", True), tag("bsdf", wall[0], self.reflectance(wall[1], 0.2, 0.7, volumes=False)))]
        else:
            parts += [self.sky()]
            floor = '<transform name="to_world"><scale value="4"/><translate z="-1.6"/></transform>'
            parts += [tag("shape", "rectangle", floor, self.bsdf(1))] * self.chance(0.8)
        for _ in range(lamps):
            parts += [self.shape(cells.pop(), CELL, self.area())]
        parts += [self.point_light() for _ in range(self.rng.randint(1, 2) if self.points else 0)]
        if self.chance(0.3):
            members = [self.shape((x, 0, 0), 0.45, group=True) for x in (-0.5, 0.5)[:self.rng.randint(1, 2)]]
            parts += [tag("shape", "shapegroup", *members, id="group")]
            parts += [tag("shape", "instance", '<ref id="group"/>', self.placement(1, cells.pop(), CELL)) for _ in range(2)]
        for _ in range(self.rng.randint(1, 3)):
            parts += [self.shape(cells.pop(), CELL, medium=self.chance(0.3))]
        sensor = self.sensor()
        integrator = tag("integrator", "volpath" if self.passages or self.chance(0.2) else "path",
                         value("integer", "max_depth", self.pick(-1, -1, 2, 3, 5)),
                         value("boolean", "hide_emitters", self.passages and self.chance(0.2)))
        return '<scene version="3.0.0">\n' + "\n".join([integrator, sensor, *parts]) + "\n</scene>\n"

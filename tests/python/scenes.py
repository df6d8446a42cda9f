"""Scenes of the tests, as dicts, and images that the program wrote."""

import numpy
import OpenImageIO

import quasilux as ql

WALL = {"type": "ref", "id": "wall"}


def cornell_phong(resolution):
    """scenes/cornell_phong.xml."""
    box = {"type": "ref", "id": "box"}

    def wall(placement):
        return {"type": "rectangle", "to_world": placement, "wall": WALL}

    turn, shift, size = ql.rotate, ql.translate, ql.scale
    return {
        "type": "scene",
        "quasilux": {"bdd": 0, "variant": "main"},
        "integrator": {"type": "path", "max_depth": -1},
        "camera": {
            "type": "perspective",
            "fov": 39.3077,
            "to_world": ql.look_at((0, 0, 3.9), (0, 0, 0)),
            "sampler": {"type": "independent", "sample_count": 64},
            "film": {
                "type": "hdrfilm",
                "width": resolution,
                "height": resolution,
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
                "component_format": "float32",
            },
        },
        "wall": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.5, 0.5, 0.5]}},
        "box": {
            "type": "phong",
            "diffuse_reflectance": {"type": "rgb", "value": [0.5, 0, 0]},
            "specular_reflectance": {"type": "rgb", "value": [0.025, 0.25, 0.025]},
            "exponent": 1000.0,
            "quasilux": {"quasi_specular": "specular"},
        },
        "floor": wall(shift((0, -1, 0)) @ turn((1, 0, 0), -90)),
        "ceiling": wall(shift((0, 1, 0)) @ turn((1, 0, 0), 90)),
        "back": wall(shift((0, 0, -1))),
        "left": wall(shift((-1, 0, 0)) @ turn((0, 1, 0), 90)),
        "right": wall(shift((1, 0, 0)) @ turn((0, 1, 0), -90)),
        "short": {"type": "cube", "to_world": shift((0.335, -0.7, 0.38)) @ turn((0, 1, 0), -17) @ size(0.3), "box": box},
        "tall": {"type": "cube", "to_world": shift((-0.33, -0.39, -0.28)) @ turn((0, 1, 0), 18.25) @ size((0.3, 0.61, 0.3)), "box": box},
        "light": {
            "type": "rectangle",
            "to_world": shift((0, 0.99, 0)) @ turn((1, 0, 0), -90) @ size(0.25),
            "glass": {"type": "null"},
            "lamp": {"type": "area", "radiance": {"type": "rgb", "value": 100.0}},
        },
    }


def lit_floor(width, **more):
    """A lamp above a floor, the fewest objects that make a picture."""
    return {
        "type": "scene",
        "camera": {
            "type": "perspective",
            "to_world": ql.look_at((0, 3, 6), (0, 0, 0)),
            "film": {"type": "hdrfilm", "width": width, "height": width},
        },
        "floor": {"type": "rectangle", "to_world": ql.rotate((1, 0, 0), -90) @ ql.scale(4)},
        "lamp": {"type": "point", "position": [0, 3, 0], "intensity": {"type": "rgb", "value": [30, 30, 30]}},
        **more,
    }


GRID = {"illuminance_grid": {"origin": [-1, 0.1, 1], "edge_u": [2, 0, 0], "edge_v": [0, 0, -2], "nx": 4, "ny": 3}}


def layers_of(path):
    """Channels of an image file by name."""
    image = OpenImageIO.ImageInput.open(str(path))
    names = image.spec().channelnames
    pixels = image.read_image(0, len(names), OpenImageIO.FLOAT)
    image.close()
    return {name: numpy.ascontiguousarray(pixels[:, :, k]) for k, name in enumerate(names)}

"""Builds a furnished room in Blender and exports it as glTF: blender -b --python scripts/blender_room.py -- FILE [bare]

bare: the lamps and the floor alone, whose illuminance has a closed form (scripts/blender_lux.py). Lamps are in watts, as Blender has them.
Places are Blender's, whose z is up.
Blender's area lamps are no part of KHR_lights_punctual: a panel that emits stands in for one, with the radiance of a Lambertian lamp of
that power.
"""

import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
from blender_lamps import EFFICACY, PANEL, POINT, SPOT

GRID = {"origin": [-2, 0, 1.5], "edge-u": [4, 0, 0], "edge-v": [0, 0, -3], "nx": 8, "ny": 6}  # of glTF: y is up


def material(name, color, roughness=0.8, metallic=0.0, emission=0.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    if emission > 0:
        shader.inputs["Emission"].default_value = (1, 1, 1, 1)
        shader.inputs["Emission Strength"].default_value = emission
        shader.inputs["Specular"].default_value = 0
        made.use_backface_culling = True
    return made


def box(name, place, size, look):
    bpy.ops.mesh.primitive_cube_add(size=1, location=place)
    bpy.context.object.name = name
    bpy.context.object.scale = size
    bpy.context.object.data.materials.append(look)


def plate(name, place, size, turn, look):
    bpy.ops.mesh.primitive_plane_add(size=1, location=place, rotation=turn)
    bpy.context.object.name = name
    bpy.context.object.scale = (*size, 1)
    bpy.context.object.data.materials.append(look)


def ball(name, place, radius, look):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=radius, location=place)
    bpy.ops.object.shade_smooth()
    bpy.context.object.name = name
    bpy.context.object.data.materials.append(look)


def lamps():
    point = bpy.data.lights.new("pendant", "POINT")
    point.energy = POINT["watts"]
    spot = bpy.data.lights.new("spot", "SPOT")
    spot.energy = SPOT["watts"]
    spot.spot_size, spot.spot_blend = SPOT["angle"], SPOT["blend"]
    for light, lamp in ((point, POINT), (spot, SPOT)):
        thing = bpy.data.objects.new(light.name, light)
        thing.location = lamp["place"]
        bpy.context.collection.objects.link(thing)
    width, depth = PANEL["size"]
    radiance = PANEL["watts"] / (math.pi * width * depth)
    look = material("panel", (0, 0, 0), emission=EFFICACY * radiance)
    plate("panel", PANEL["place"], PANEL["size"], (math.pi, 0, 0), look)


def walls(white, floor):
    plate("ceiling", (0, 0, 2.6), (4, 3), (math.pi, 0, 0), white)
    plate("back wall", (0, 1.5, 1.3), (4, 2.6), (math.pi / 2, 0, 0), white)
    plate("front wall", (0, -1.5, 1.3), (4, 2.6), (-math.pi / 2, 0, 0), white)
    plate("left wall", (-2, 0, 1.3), (2.6, 3), (0, math.pi / 2, 0), material("green wall", (0.35, 0.5, 0.35)))
    plate("right wall", (2, 0, 1.3), (2.6, 3), (0, -math.pi / 2, 0), white)


def furniture():
    wood, dark = material("wood", (0.45, 0.25, 0.12), 0.4), material("dark", (0.08, 0.08, 0.1), 0.6)
    box("table top", (1.2, 0.2, 0.74), (1.2, 0.7, 0.04), wood)
    for x in (0.66, 1.74):
        for y in (-0.1, 0.5):
            box("leg", (x, y, 0.36), (0.05, 0.05, 0.72), wood)
    for height in (0.4, 0.8, 1.2, 1.6):
        box("shelf", (-1.4, 1.3, height), (1.09, 0.34, 0.03), wood)
    for x in (-1.96, -0.84):
        box("side", (x, 1.3, 0.85), (0.03, 0.36, 1.7), wood)
    books = [material("red book", (0.5, 0.08, 0.06)), material("blue book", (0.06, 0.12, 0.4)), dark]
    for k in range(12):
        box("book", (-1.85 + 0.07 * k, 1.3, 0.945), (0.05, 0.2, 0.26), books[k % 3])
    box("sofa", (-1.2, -0.8, 0.22), (1.3, 0.75, 0.44), dark)
    box("sofa back", (-1.2, -1.2, 0.5), (1.3, 0.16, 0.6), dark)
    ball("vase", (1.45, 0.25, 0.88), 0.12, material("brass", (0.9, 0.65, 0.3), 0.15, 1))
    ball("globe", (-1.05, 1.28, 1.35), 0.13, material("glaze", (0.1, 0.25, 0.6), 0.1))


def camera():
    data = bpy.data.cameras.new("camera")
    data.lens = 20
    thing = bpy.data.objects.new("camera", data)
    thing.location = (1.85, -1.4, 1.75)
    thing.rotation_euler = (math.radians(75), 0, math.radians(48))
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 800, 600


def main():
    options = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    floor = material("floor", (0.4, 0.33, 0.27), 0.5)
    plate("floor", (0, 0, 0), (4, 3), (0, 0, 0), floor)
    lamps()
    if "bare" not in options:
        walls(material("white", (0.8, 0.8, 0.78)), floor)
        furniture()
        camera()
    bpy.context.scene["quasilux"] = {"illuminance-grid": GRID}
    bpy.ops.export_scene.gltf(filepath=options[0], export_format="GLB", export_lights=True, export_cameras=True, export_extras=True)


if __name__ == "__main__":
    main()

"""Renders a room by Blender's Cycles, the light of each luminaire apart: nothing of luxfit takes part.

  blender -b -noaudio -P render.py -- ROOM FOLDER SAMPLES [VIEW...]

Writes FOLDER/VIEW_LUMINAIRE.exr, luminance in 1000 cd/m2, and FOLDER/sensors.json, illuminance in lx by sensor and luminaire (unless views
are named). Lambertian paint, mirrored shares that do not depend on the angle, 16 bounces, no denoising. VIEW_index.exr, VIEW_normal.exr,
VIEW_colour.exr and VIEW_shining.exr say which thing a pixel shows, how that faces, what it reflects and whether it shines (denoise.py).
"""
import json
import math
import os
import pathlib
import sys

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
import bpy
import cv2
import mathutils
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from rooms import ROOMS  # noqa: E402

KILO = 1e-3  # pictures are in 1000 cd/m2: Cycles' own thresholds are made for values near 1
SENSOR_M, SENSOR_REFLECTANCE = 0.03, 0.8
TAG_WHITE, TAG_BLACK = 0.85, 0.04
GUIDE_SAMPLES = 16


def nodes_of(material):
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    return tree, tree.nodes.new("ShaderNodeOutputMaterial")


def paint(description):
    tree, output = nodes_of(material := bpy.data.materials.new(description.name))
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*[description.reflectance] * 3, 1)
    if description.pattern > 0:  # a sum of sines about the mean
        wave = tree.nodes.new("ShaderNodeTexWave")
        wave.inputs["Scale"].default_value = 12.0
        place = tree.nodes.new("ShaderNodeNewGeometry")
        tree.links.new(place.outputs["Position"], wave.inputs["Vector"])
        span = tree.nodes.new("ShaderNodeMapRange")
        span.inputs["To Min"].default_value = description.reflectance * (1 - description.pattern)
        span.inputs["To Max"].default_value = description.reflectance * (1 + description.pattern)
        tree.links.new(wave.outputs["Fac"], span.inputs["Value"])
        tree.links.new(span.outputs["Result"], diffuse.inputs["Color"])
    surface = diffuse.outputs[0]
    if description.gloss > 0:
        glossy, mix = tree.nodes.new("ShaderNodeBsdfGlossy"), tree.nodes.new("ShaderNodeMixShader")
        glossy.inputs["Roughness"].default_value = description.roughness
        mix.inputs["Fac"].default_value = description.gloss
        tree.links.new(surface, mix.inputs[1])
        tree.links.new(glossy.outputs[0], mix.inputs[2])
        surface = mix.outputs[0]
    tree.links.new(surface, output.inputs["Surface"])
    return material


def combine(tree, operation, a, b):
    """Returns the socket of an arithmetic node; its inputs are sockets or numbers."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for i, value in enumerate((a, b)):
        if isinstance(value, float):
            node.inputs[i].default_value = value
        else:
            tree.links.new(value, node.inputs[i])
    return node.outputs[0]


def distribution(tree, luminaire):
    """Returns cos^power (1 + wings sin^2) of the direction that light takes."""
    geometry, dot = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeVectorMath")
    dot.operation = "DOT_PRODUCT"
    tree.links.new(geometry.outputs["Incoming"], dot.inputs[0])
    tree.links.new(geometry.outputs["Normal"], dot.inputs[1])
    cosine = combine(tree, "MAXIMUM", dot.outputs["Value"], 0.0)
    value = combine(tree, "POWER", cosine, float(luminaire.power))
    sine2 = combine(tree, "SUBTRACT", 1.0, combine(tree, "MULTIPLY", cosine, cosine))
    return combine(tree, "MULTIPLY", value, combine(tree, "ADD", 1.0, combine(tree, "MULTIPLY", sine2, float(luminaire.wings))))


def emit(tree, strength, output):
    light = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(strength, light.inputs["Strength"])
    tree.links.new(light.outputs[0], output.inputs["Surface"])


def emission(luminaire):
    """Returns a material that shines at the front alone."""
    tree, output = nodes_of(material := bpy.data.materials.new("light of " + luminaire.name))
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    front = combine(tree, "SUBTRACT", 1.0, geometry.outputs["Backfacing"])
    shape = combine(tree, "MULTIPLY", front, distribution(tree, luminaire))
    emit(tree, combine(tree, "MULTIPLY", shape, luminaire.luminance() * KILO), output)
    return material


def mesh(name, corners, faces, material, group=""):
    data = bpy.data.meshes.new(name)
    data.from_pydata([tuple(c) for c in corners], [], faces)
    data.materials.append(material)
    thing = bpy.data.objects.new(name, data)
    thing.lightgroup = group
    bpy.context.collection.objects.link(thing)
    return thing


def box(description, material):
    c, s = math.cos(description.turn), math.sin(description.turn)
    corners = []
    for z in (-0.5, 0.5):
        for y in (-0.5, 0.5):
            for x in (-0.5, 0.5):
                dx, dy = x * description.size[0], y * description.size[1]
                corners.append((description.centre[0] + c * dx - s * dy, description.centre[1] + s * dx + c * dy,
                                description.centre[2] + z * description.size[2]))
    return mesh(description.name, corners, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)], material)


def frame(luminaire):
    aim = np.array(luminaire.aim) / np.linalg.norm(luminaire.aim)
    along = np.array(luminaire.heading) - np.dot(luminaire.heading, aim) * aim
    along /= np.linalg.norm(along)
    return aim, along, np.cross(aim, along)


def rectangle(luminaire, centre, aim, along, across, material):
    a, b = 0.5 * luminaire.size[0] * along, 0.5 * luminaire.size[1] * across
    corners = [centre - a - b, centre + a - b, centre + a + b, centre - a + b]
    is_front = np.dot(np.cross(a, b), aim) > 0
    mesh(luminaire.name, corners, [(0, 1, 2, 3) if is_front else (3, 2, 1, 0)], material, luminaire.name)


def add_disc(luminaire):
    """Adds a small opening as a lamp of Cycles, which finds lamps more often than small meshes. Its power is pi d^2 L."""
    data = bpy.data.lights.new(luminaire.name, "AREA")
    data.shape, data.size, data.use_nodes = "DISK", luminaire.size[0], True
    data.energy = math.pi * luminaire.size[0] ** 2 * luminaire.luminance() * KILO
    tree = data.node_tree
    tree.nodes.clear()
    emit(tree, distribution(tree, luminaire), tree.nodes.new("ShaderNodeOutputLight"))
    thing = bpy.data.objects.new(luminaire.name, data)
    thing.lightgroup = luminaire.name
    aim, along, across = (mathutils.Vector(v) for v in frame(luminaire))
    thing.matrix_world = mathutils.Matrix.Translation(luminaire.position) @ mathutils.Matrix((along, -across, -aim)).transposed().to_4x4()
    bpy.context.collection.objects.link(thing)


def add_luminaire(luminaire, housing):
    light = emission(luminaire)
    if luminaire.shape == "sphere":
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.5 * luminaire.size[0], location=luminaire.position)
        bpy.context.object.data.materials.append(light)
        bpy.context.object.lightgroup = luminaire.name
        bpy.ops.object.shade_smooth()
        return
    if luminaire.shape == "disc":
        add_disc(luminaire)
        return
    aim, along, across = frame(luminaire)
    centre, gap = np.array(luminaire.position), 0.5 * luminaire.housing_m + 5e-4
    if luminaire.housing_m > 0:  # its body, between the openings or behind the one
        body = centre if luminaire.both_sides else centre - gap * aim
        corners = [body + i * 0.5 * luminaire.size[0] * along + j * 0.5 * luminaire.size[1] * across + k * 0.5 * luminaire.housing_m * aim
                   for k in (-1, 1) for j in (-1, 1) for i in (-1, 1)]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        mesh(luminaire.name + " housing", corners, faces, housing)
    sides = [(1, aim), (-1, -aim)] if luminaire.both_sides else [(0, aim)]
    for side, direction in sides:
        rectangle(luminaire, centre + side * gap * aim, direction, along, across, light)


def add_tag(tag):
    dictionary = cv2.aruco.Dictionary_get(cv2.aruco.DICT_APRILTAG_36h11)
    cells = np.full((10, 10), 255, np.uint8)
    cells[1:9, 1:9] = np.rot90(cv2.aruco.drawMarker(dictionary, tag.number, 8), 2)  # OpenCV has AprilTag's upside down
    materials = []
    for name, value in (("tag white", TAG_WHITE), ("tag black", TAG_BLACK)):
        materials.append(bpy.data.materials.get(name) or paint(type("P", (), {"name": name, "reflectance": value, "pattern": 0, "gloss": 0})))
    normal, up = np.array(tag.normal, float), np.array(tag.up, float)
    right = np.cross(up, normal)
    origin = np.array(tag.centre) + 1e-3 * normal
    corners, faces = [], []
    for row in range(11):
        for column in range(11):
            corners.append(origin + tag.size / 8 * ((column - 5) * right + (5 - row) * up))
    for row in range(10):
        for column in range(10):
            faces.append((row * 11 + column, (row + 1) * 11 + column, (row + 1) * 11 + column + 1, row * 11 + column + 1))
    thing = mesh(f"tag {tag.number}", corners, faces, materials[0])
    thing.data.materials.append(materials[1])
    for i, polygon in enumerate(thing.data.polygons):
        polygon.material_index = 0 if cells[i // 10, i % 10] > 127 else 1


def build(room):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    layer = bpy.context.view_layer
    for luminaire in room.luminaires:
        layer.lightgroups.add(name=luminaire.name)
    paints = {m.name: paint(m) for m in room.materials}
    n = len(room.outline)
    low = [(x, y, 0.0) for x, y in room.outline]
    high = [(x, y, room.height) for x, y in room.outline]
    mesh("floor", low, [tuple(range(n))], paints[room.floor])
    mesh("ceiling", high, [tuple(range(n))[::-1]], paints[room.ceiling])
    for i in range(n):
        mesh(f"wall {i + 1}", [low[i], low[(i + 1) % n], high[(i + 1) % n], high[i]], [(3, 2, 1, 0)], paints[room.wall])
    for description in room.boxes:
        box(description, paints[description.material])
    housing = paint(type("P", (), {"name": "housing", "reflectance": 0.6, "pattern": 0, "gloss": 0}))
    for luminaire in room.luminaires:
        add_luminaire(luminaire, housing)
    for tag in room.tags:
        add_tag(tag)


def settings(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = samples, False, False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 16
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    scene.render.film_transparent = False
    scene.render.resolution_percentage = 100
    scene.world = bpy.data.worlds.new("none")
    scene.world.color = (0, 0, 0)
    layer = bpy.context.view_layer
    layer.use_pass_object_index = layer.use_pass_normal = layer.use_pass_diffuse_color = layer.use_pass_emit = True
    for number, thing in enumerate(bpy.data.objects):
        thing.pass_index = number + 1


def write_layers(folder, layers_of_files):
    """Lets a rendering write layers to files, `layers_of_files` by their names."""
    scene = bpy.context.scene
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    layers, files = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("CompositorNodeOutputFile")
    files.base_path = str(folder)
    files.format.file_format, files.format.color_depth = "OPEN_EXR", "32"
    files.file_slots.clear()
    for name, layer in layers_of_files.items():
        files.file_slots.new(name + "_")
        tree.links.new(layers.outputs[layer], files.inputs[-1])


def camera(position, target, up=(0, 0, 1)):
    data = bpy.data.cameras.new("camera")
    thing = bpy.data.objects.new("camera", data)
    back = mathutils.Vector(position) - mathutils.Vector(target)
    back.normalize()
    right = mathutils.Vector(up).cross(back)
    right.normalize()
    above = back.cross(right)
    thing.matrix_world = mathutils.Matrix.Translation(position) @ mathutils.Matrix((right, above, back)).transposed().to_4x4()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing
    return thing


def render_layers(folder, layers_of_files, width, height):
    """Renders, and returns the path of each file."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.frame_set(1)
    write_layers(folder, layers_of_files)
    bpy.ops.render.render()
    return {name: (folder / f"{name}_0001.exr").rename(folder / f"{name}.exr") for name in layers_of_files}


def render(room, folder, prefix, width, height):
    """Returns by luminaire the file of its light."""
    files = render_layers(folder, {f"{prefix}_{l.name}": f"Combined_{l.name}" for l in room.luminaires}, width, height)
    return {l.name: files[f"{prefix}_{l.name}"] for l in room.luminaires}


def render_guides(room, view, folder):
    """Renders what a view shows without its light."""
    cycles = bpy.context.scene.cycles
    samples, cycles.samples = cycles.samples, GUIDE_SAMPLES
    guides = {"index": "IndexOB", "normal": "Normal", "colour": "DiffCol", "shining": "Emit"}
    render_layers(folder, {f"{view.name}_{name}": layer for name, layer in guides.items()}, room.width, room.height_px)
    cycles.samples = samples


def render_view(room, view, folder):
    thing = camera(view.position, view.target)
    thing.data.sensor_fit, thing.data.sensor_width = "HORIZONTAL", 36.0
    thing.data.lens = room.focal_px * 36.0 / room.width
    thing.data.clip_start = 0.01
    render(room, folder, view.name, room.width, room.height_px)
    render_guides(room, view, folder)


def measure(room, sensor, folder):
    """Returns lx by luminaire: what a small matt square at the sensor's place shows, times pi over its reflectance."""
    normal = np.array(sensor.normal, float)
    first = np.cross(normal, (1, 0, 0) if abs(normal[0]) < 0.9 else (0, 1, 0))
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    centre, half = np.array(sensor.position), SENSOR_M / 2
    corners = [centre - half * first - half * second, centre + half * first - half * second,
               centre + half * first + half * second, centre - half * first + half * second]
    white = bpy.data.materials.get("sensor") or paint(
        type("P", (), {"name": "sensor", "reflectance": SENSOR_REFLECTANCE, "pattern": 0, "gloss": 0}))
    square = mesh("sensor", corners, [(0, 1, 2, 3)], white)
    thing = camera(tuple(centre + 0.05 * normal), tuple(centre), tuple(first))
    thing.data.type, thing.data.ortho_scale, thing.data.clip_start = "ORTHO", 0.8 * SENSOR_M, 0.001
    files = render(room, folder, sensor.name, 16, 16)
    lx = {name: float(cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[..., :3].mean()) / KILO * math.pi / SENSOR_REFLECTANCE for name, path in files.items()}
    for path in files.values():
        path.unlink()
    bpy.data.objects.remove(square)
    return lx


def main(name, folder, samples, views):
    room = ROOMS[name]()
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    build(room)
    settings(samples)
    for view in room.views:
        if not views or view.name in views:
            render_view(room, view, folder)
    if views:
        return
    bpy.context.scene.cycles.samples = 16 * samples
    readings = {sensor.name: measure(room, sensor, folder) for sensor in room.sensors}
    (folder / "sensors.json").write_text(json.dumps(readings, indent=1))


arguments = sys.argv[sys.argv.index("--") + 1:]
main(arguments[0], arguments[1], int(arguments[2]), arguments[3:])

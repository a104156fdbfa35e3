# Run by cycles_time.sh inside Blender: a model of random-walk subsurface scattering under a sun, by
# Cycles on the processor. Prints the seconds of each picture.
#   blender -b -P cycles_time.py -- MODEL.ply FOLDER FREE_PATH_IN_RADII BACK(0|1) SAMPLES...
import math
import os
import sys
import time

import bpy
from mathutils import Matrix, Vector

model, folder, free_path, back, *counts = sys.argv[sys.argv.index("--") + 1:]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_mesh.ply(filepath=model)
bunny = bpy.context.object
for polygon in bunny.data.polygons:
    polygon.use_smooth = True

points = [v.co for v in bunny.data.vertices]
low = Vector(min(p[i] for p in points) for i in range(3))
high = Vector(max(p[i] for p in points) for i in range(3))
center = (low + high) / 2
radius = max((p - center).length for p in points)

material = bpy.data.materials.new("medium")
material.use_nodes = True
shader = material.node_tree.nodes["Principled BSDF"]
shader.subsurface_method = "RANDOM_WALK"
shader.inputs["Subsurface"].default_value = 1.0
shader.inputs["Subsurface Color"].default_value = (0.9, 0.7, 0.5, 1.0)
shader.inputs["Subsurface Radius"].default_value = [float(free_path) * radius] * 3
shader.inputs["Specular"].default_value = 0.0
bunny.data.materials.append(material)


def look(thing, eye, at):
    forward = (at - eye).normalized()
    right = forward.cross(Vector((0.0, 1.0, 0.0))).normalized()
    matrix = Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
    matrix.translation = eye
    thing.matrix_world = matrix


scene = bpy.context.scene
direction = Vector((0.45, 0.35, 1.0)).normalized()
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
look(camera, center + 3.2 * radius * direction, center)
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = math.radians(40.0)

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = 3.0
sun.data.angle = 0.0
scene.collection.objects.link(sun)
toward = Vector((-0.5, -0.3, 0.8)) if back == "1" else Vector((0.35, -0.5, -0.9))
look(sun, center - 4.0 * radius * toward.normalized(), center)

scene.world = bpy.data.worlds.new("black")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.use_denoising = False
scene.cycles.use_adaptive_sampling = False
scene.cycles.pixel_filter_type = "BOX"
scene.render.threads_mode = "AUTO"
scene.render.resolution_x, scene.render.resolution_y = 800, 600
scene.render.resolution_percentage = 100
scene.render.film_transparent = True
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.use_persistent_data = True

for number, count in enumerate(counts):
    scene.cycles.samples = int(count)
    scene.cycles.seed = number
    scene.render.filepath = os.path.join(folder, f"cycles_{number}.exr")
    begin = time.time()
    bpy.ops.render.render(write_still=True)
    print(f"CYCLES {count} {time.time() - begin:.2f}", flush=True)

"""Runs in Blender: makes a small scene and exports it in many ways.

blender -b --factory-startup --python blender_scene.py -- FOLDER. Prints "variants: JSON", a list of {name, file, up,
normals, lost}: `up` is the axis that --up is to say; `normals` is "smooth", "flat" (none in the file) or "other" (not those
of the scene); `lost` says which of "uvs" and "materials" the file does not have.
"""
import json
import math
import os
import sys

import bpy

FOLDER = sys.argv[sys.argv.index("--") + 1]


def material(name, color, picture=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    if picture is not None:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = picture
        made.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    return made


def checker():
    """8x8 squares, no two corners alike, so that a turned or mirrored one is seen; in a file of its own."""
    picture = bpy.data.images.new("checker", 64, 64)
    pixels = []
    for y in range(64):
        for x in range(64):
            light = 0.9 if (x // 8 + y // 8) % 2 else 0.1
            pixels += [light, light if x < 32 else 0.1, light if y < 32 else 0.1, 1.0]
    picture.pixels = pixels
    picture.filepath_raw = os.path.join(FOLDER, "checker.png")
    picture.file_format = "PNG"
    picture.save()
    return picture


def make_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    red, textured = material("red", (0.8, 0.1, 0.05)), material("textured", (1, 1, 1), checker())

    bpy.ops.mesh.primitive_plane_add(size=6)
    bpy.context.object.data.materials.append(textured)

    bpy.ops.mesh.primitive_cube_add(size=1, location=(-1.2, 0, 0.5), rotation=(0, 0, 0.4))
    cube = bpy.context.object
    cube.data.materials.append(red)
    modifier = cube.modifiers.new("same shape", "SUBSURF")  # a modifier that leaves the shape as it is
    modifier.subdivision_type = "SIMPLE"

    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.6, location=(0.4, 0.8, 0.6))
    sphere = bpy.context.object
    bpy.ops.object.shade_smooth()
    sphere.data.materials.append(material("gray", (0.6, 0.6, 0.6)))

    bpy.ops.mesh.primitive_cube_add(size=0.4)
    child = bpy.context.object
    child.location, child.rotation_euler, child.parent = (0, 0, 0.9), (0.5, 0.2, 0), sphere
    child.data.materials.append(red)

    # A concave polygon of six corners, mirrored by its object.
    mesh = bpy.data.meshes.new("angle")
    mesh.from_pydata([(0, 0, 0), (1.2, 0, 0), (1.2, 0, 0.3), (0.3, 0, 0.3), (0.3, 0, 1.4), (0, 0, 1.4)], [],
                     [(0, 1, 2, 3, 4, 5)])
    mesh.uv_layers.new()
    angle = bpy.data.objects.new("angle", mesh)
    angle.location, angle.scale = (1.9, -0.6, 0.02), (-1, 1, 1)
    mesh.materials.append(red)
    bpy.context.collection.objects.link(angle)

    bpy.ops.object.light_add(type="POINT", location=(1, -2, 3))
    bpy.context.object.data.energy = 100
    bpy.ops.object.camera_add(location=(0.5, -6, 3.2), rotation=(math.radians(65), 0, 0))
    bpy.context.scene.camera = bpy.context.object


def export():
    variants = []

    def add(name, call, up="y", normals="smooth", lost=(), **options):
        extension = name.split("-")[0].replace("old_", "")
        call(filepath=os.path.join(FOLDER, name + "." + extension), **options)
        variants.append({"name": name, "file": name + "." + extension, "up": up, "normals": normals, "lost": lost})

    gltf, ply = bpy.ops.export_scene.gltf, bpy.ops.export_mesh.ply
    add("glb", gltf)
    add("glb-lamp-camera", gltf, export_lights=True, export_cameras=True)
    add("gltf-separate", gltf, export_format="GLTF_SEPARATE", export_texture_dir="textures")
    add("gltf-embedded", gltf, export_format="GLTF_EMBEDDED")
    add("glb-applied", gltf, export_apply=True)
    add("glb-no-normals", gltf, normals="flat", export_normals=False)
    add("glb-no-uvs", gltf, lost=["uvs"], export_texcoords=False)
    add("glb-no-materials", gltf, lost=["materials"], export_materials="NONE")
    add("glb-tangents", gltf, export_tangents=True)
    add("glb-jpeg", gltf, export_image_format="JPEG")
    add("glb-z-up", gltf, up="z", export_yup=False)
    try:
        from io_scene_gltf2.io.com import gltf2_io_draco_compression_extension as draco
        if draco.dll_exists():
            add("glb-draco", gltf, export_draco_mesh_compression_enable=True)
    except ImportError:
        pass

    if hasattr(bpy.ops.wm, "obj_export"):
        obj = bpy.ops.wm.obj_export
        add("obj", obj)
        add("obj-triangles", obj, export_triangulated_mesh=True)
        add("obj-no-normals", obj, normals="flat", export_normals=False)
        add("obj-no-uvs", obj, lost=["uvs"], export_uv=False)
        add("obj-no-materials", obj, lost=["materials"], export_materials=False)
        add("obj-no-modifiers", obj, apply_modifiers=False)
        add("obj-groups", obj, export_object_groups=True, export_material_groups=True, export_smooth_groups=True)
        add("obj-pbr", obj, export_pbr_extensions=True)
        add("obj-absolute", obj, path_mode="ABSOLUTE")
        add("obj-strip", obj, path_mode="STRIP")
        add("obj-z-up", obj, up="z", forward_axis="Y", up_axis="Z")
    if hasattr(bpy.ops.export_scene, "obj"):
        obj = bpy.ops.export_scene.obj
        add("old_obj", obj)
        add("old_obj-triangles", obj, use_triangles=True, use_smooth_groups=True, path_mode="RELATIVE")
        add("old_obj-groups", obj, group_by_object=True, group_by_material=True, keep_vertex_order=True)

    # Its normals are those of smooth shading, everywhere.
    bare = {"up": "z", "normals": "other", "lost": ["materials"]}
    add("ply", ply, **bare)
    add("ply-text", ply, **bare, use_ascii=True)
    add("ply-no-normals", ply, **{**bare, "normals": "flat"}, use_normals=False, use_uv_coords=False)
    add("ply-no-modifiers", ply, **bare, use_mesh_modifiers=False)
    add("ply-y-up", ply, **{**bare, "up": "y"}, axis_forward="-Z", axis_up="Y")
    return variants


make_scene()
print("variants: " + json.dumps(export()), flush=True)

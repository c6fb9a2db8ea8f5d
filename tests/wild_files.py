"""Files as people have them, each with one thing that Lightwell does not show.

wild_files() lists them. Python's standard library only.
"""
import base64
import json
import struct

from command_line import gray_png, png


class WildFile:
    """`files` by name, the first is the scene; `said`: a part of each warning, in any order; `refused`: of the error."""

    def __init__(self, name, files, said=(), refused=None, options=()):
        self.name, self.files, self.options, self.refused = name, files, options, refused
        self.said = [said] if isinstance(said, str) else list(said)


PNG = gray_png([[40, 200], [120, 250]])
DDS = b"DDS " + struct.pack("<7I", 124, 0x1007, 4, 4, 8, 0, 1) + bytes(96) + bytes(8)
KTX2 = b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(80)
NAN = float("nan")


def data_uri(content, kind="application/octet-stream"):
    return f"data:{kind};base64," + base64.b64encode(content).decode()


def gltf(change=lambda scene: None):
    """A textured square, a lamp and a camera; `change` is what is peculiar about it."""
    arrays = [("VEC3", [-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1]), ("VEC3", [0, 1, 0] * 4), ("VEC2", [0, 0, 1, 0, 1, 1, 0, 1]),
              ("SCALAR", [0, 2, 1, 0, 3, 2])]
    scene = {
        "asset": {"version": "2.0", "generator": "by hand"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0, "name": "square"},
                  {"translation": [0, 2, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                  {"camera": 0, "translation": [0, 1, 4]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"material": 0, "indices": 3, "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
        "materials": [{"name": "paper", "doubleSided": True, "pbrMetallicRoughness":
                       {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": data_uri(PNG, "image/png")}],
        "buffers": [],
        "bufferViews": [],
        "accessors": [],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}},
    }
    for kind, values in arrays:
        add_array(scene, kind, values)
    change(scene)
    return json.dumps(scene).replace('"NaN"', "NaN").encode()


def add_array(scene, kind, values):
    """Floats, or indices where `kind` is SCALAR; returns the accessor's index."""
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
    content = struct.pack(f"<{len(values)}{'H' if kind == 'SCALAR' else 'f'}", *values)
    scene["buffers"].append({"byteLength": len(content), "uri": data_uri(content)})
    scene["bufferViews"].append({"buffer": len(scene["buffers"]) - 1, "byteLength": len(content)})
    scene["accessors"].append({"bufferView": len(scene["bufferViews"]) - 1, "type": kind, "count": len(values) // width,
                               "componentType": 5123 if kind == "SCALAR" else 5126})
    return len(scene["accessors"]) - 1


def extended(owner, extension, value, required=False):
    """A change: `owner(scene)` has the extension."""
    def change(scene):
        scene["extensionsUsed"].append(extension)
        if required:
            scene.setdefault("extensionsRequired", []).append(extension)
        owner(scene).setdefault("extensions", {})[extension] = value
    return change


def material_with(**members):
    return lambda scene: scene["materials"][0].update(members)


def image_at(uri):
    def change(scene):
        scene["images"][0]["uri"] = uri
    return change


def primitive(scene):
    return scene["meshes"][0]["primitives"][0]


def more_attribute(name, kind, values):
    def change(scene):
        primitive(scene)["attributes"][name] = add_array(scene, kind, values)
    return change


def another_primitive(mode):
    def change(scene):
        scene["meshes"][0]["primitives"].append({"mode": mode, "attributes": {"POSITION": 0}})
    return change


def replaced_array(index, kind, values):
    def change(scene):
        scene["accessors"][index] = scene["accessors"][add_array(scene, kind, values)]
        scene["accessors"].pop()
    return change


def instances(scene):
    scene["extensionsUsed"].append("EXT_mesh_gpu_instancing")
    places, colors = add_array(scene, "VEC3", [0, 0, 0, 3, 0, 0]), add_array(scene, "VEC3", [1, 0, 0, 0, 1, 0])
    scene["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places, "_COLOR": colors,
                                                                                  "COLOR_0": colors}}}


def pointer_animation(scene):
    scene["extensionsUsed"].append("KHR_animation_pointer")
    times = add_array(scene, "VEC2", [0, 1])
    scene["accessors"][times].update(type="SCALAR", count=2)
    values = add_array(scene, "VEC4", [1, 0, 0, 1, 0, 1, 0, 1])
    scene["animations"] = [{"samplers": [{"input": times, "output": values}], "channels": [{"sampler": 0, "target": {
        "path": "pointer", "extensions": {"KHR_animation_pointer":
                                          {"pointer": "/materials/0/pbrMetallicRoughness/baseColorFactor"}}}}]}]


def node(**members):
    return lambda scene: scene["nodes"][0].update(members)


def light(**members):
    return lambda scene: scene["extensions"]["KHR_lights_punctual"]["lights"][0].update(members)


def material(scene):
    return scene["materials"][0]


def gltf_files():
    def one(name, change, said=(), more=None, refused=None):
        return WildFile(name, {name + ".gltf": gltf(change), **(more or {})}, said, refused)

    def coat(name, value, said):
        return one(name, extended(material, "KHR_materials_" + name, value), said)

    normals = {"normalTexture": {"index": 0, "scale": 0.5}}
    return [
        one("plain", lambda scene: None),
        coat("clearcoat", {"clearcoatFactor": 1}, "clear coats are not shown"),
        coat("sheen", {"sheenColorFactor": [1, 1, 1]}, "sheen is not shown"),
        coat("unlit", {}, "unlit surfaces are shown lit"),
        coat("iridescence", {"iridescenceFactor": 1}, "iridescence is not shown"),
        coat("anisotropy", {"anisotropyStrength": 0.6}, "anisotropy is not shown"),
        coat("volume", {"thicknessFactor": 0.1}, "volumes are not shown"),
        one("glass", extended(material, "KHR_materials_transmission", {"transmissionFactor": 1}, required=True),
            "transmission is not shown"),
        one("variants", extended(lambda scene: scene, "KHR_materials_variants", {"variants": [{"name": "red"}]}),
            "no variant"),
        one("studio", extended(lambda scene: scene["scenes"][0], "EXT_lights_image_based", {"light": 0}),
            "its environment is not shown"),
        one("vendor", extended(lambda scene: scene["nodes"][0], "ACME_cloth", {"stiffness": 3}), "ACME_cloth"),
        one("metal", material_with(pbrMetallicRoughness={"metallicFactor": 1}), "surfaces are shown diffuse"),
        one("bumps", material_with(**normals), "normal maps are not shown"),
        one("creases", material_with(occlusionTexture={"index": 0}), "occlusion maps are not shown"),
        one("window", material_with(alphaMode="BLEND"), "alpha mask with cutoff 0.5"),
        one("lost-texture", image_at("textures/Bark_Color.png"), "Bark_Color.png: texture not found"),
        one("linked-texture", image_at("https://example.org/bark.png"), "https://example.org/bark.png"),
        one("other-machine", image_at("C:/Users/me/bark.png"), "C:/Users/me/bark.png"),
        one("dds", image_at("bark.dds"), "bark.dds", {"bark.dds": DDS}),
        one("ktx2", image_at("bark.png"), "bark.png", {"bark.png": KTX2}),
        one("cut-off", image_at("bark.png"), "bark.png: damaged", {"bark.png": PNG[:-20]}),
        one("empty-texture", image_at("bark.png"), "bark.png", {"bark.png": b""}),
        one("huge-texture", image_at("map.png"), "map.png", {"map.png": png(200000, 100000, 8, [b"\0"])}),
        one("points", another_primitive(0), "is a set of points or lines: left out"),
        one("lines", another_primitive(1), "is a set of points or lines: left out"),
        one("six-texture-sets", more_attribute("TEXCOORD_5", "VEC2", [0] * 8), "beyond the fourth set"),
        one("two-colors", more_attribute("COLOR_1", "VEC3", [1] * 12), "beyond the first set"),
        one("painted-instances", instances, "colours of instances are not shown"),
        one("pointers", pointer_animation, ["only nodes and morph targets move", "moves nothing that is known"]),
        one("nan-vertex", replaced_array(0, "VEC3", [-1, 0, -1, NAN, 0, -1, 1, 0, 1, -1, 0, 1]), "left out"),
        one("zero-rotation", node(rotation=[0, 0, 0, 0]), "nodes[0].rotation"),
        one("dark-lamp", light(intensity=-3), "lights[0].intensity"),
        one("morph-weights", node(weights=[0.5, 0.5]), "weights"),
        one("no-texture-coordinates", lambda scene: primitive(scene)["attributes"].pop("TEXCOORD_0"),
            "no texture coordinates"),
        one("splats", extended(primitive, "ACME_geometry_splats", {}, required=True), refused="ACME_geometry_splats"),
    ]


SQUARE = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"


def obj_files():
    def one(name, text, said=(), mtl=None, more=None):
        files = {name + ".obj": text.encode()}
        if mtl is not None:
            files[name + ".mtl"] = mtl.encode()
        return WildFile("obj-" + name, {**files, **(more or {})}, said, options=["--env", "1,1,1"])

    def made_of(name, statements, said, more=None):
        text = f"mtllib {name}.mtl\n{SQUARE}vt 0 0\nusemtl m\nf 1/1 4/1 3/1 2/1\n"
        return one(name, text, said, f"newmtl m\nKd 0.5 0.5 0.5\n{statements}\n", more)

    face = "f 1 4 3 2\n"
    return [
        one("bom-and-cr", "\ufeff" + (SQUARE + "s 1\n" + face).replace("\n", "\r"), "smoothing groups"),
        one("wires", SQUARE + face + "l 1 2 3\n", "points and lines have no surface"),
        one("patch", SQUARE + face + "cstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nend\n", "free-form curves and surfaces"),
        one("no-library", "mtllib gone.mtl\n" + SQUARE + "usemtl wood\n" + face, ["gone.mtl", "wood"]),
        one("bad-numbers", SQUARE + "v 1.#IND 0 0\n" + face + "f 1 2 5\n", ["without three numbers", "has a vertex that is none"]),
        one("bad-index", SQUARE + face + "f 1 2 9\n", "no vertex of the file so far"),
        one("degenerate", SQUARE + face + "f 1 2\n", "fewer than three vertices"),
        one("bytes-as-colors", SQUARE.replace("\n", " 255 10 10\n") + face, "taken as 0 to 255"),
        made_of("gloss", "Ks 0.5 0.5 0.5\nNs 250\nillum 2", "'ks' is not shown"),
        made_of("mirror", "illum 3", "'illum' 3 and more"),
        made_of("half-glass", "d 0.6", "lets light through"),
        made_of("relief", "map_Bump -bm 0.2 bark.png", "bump maps", {"bark.png": PNG}),
        made_of("lost", "map_Kd D:\\art\\bark.tga", "bark.tga"),
        made_of("filter", "Tf 0.5 0.6 1", "'tf' is not shown"),
    ]


def ply_files():
    corners = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]

    def one(name, head, body, said=(), refused=None, more=None):
        text = "ply\nformat ascii 1.0\n" + head + "end_header\n" + body
        return WildFile("ply-" + name, {name + ".ply": text.encode(), **(more or {})}, said, refused, ["--env", "1,1,1"])

    def vertices(more=""):
        return "element vertex 4\n" + "".join(f"property float {name}\n" for name in "xyz") + more

    face = "element face 1\nproperty list uchar int vertex_indices\n"
    rows = "".join("%g %g %g\n" % corner for corner in corners)
    return [
        one("scan", vertices("property float confidence\nproperty float intensity\n") + face,
            "".join("%g %g %g 0.5 0.5\n" % corner for corner in corners) + "4 0 3 2 1\n", "not shown: confidence, intensity"),
        one("strange-lists", vertices() + face + "element zone 1\nproperty list uchar float heat\n", rows + "4 0 3 2 1\n2 1 2\n",
            "zone"),
        one("edges", vertices() + face + "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
            rows + "4 0 3 2 1\n0 1\n", "edge"),
        one("lost-texture", "comment TextureFile bark.png\n" + vertices("property float s\nproperty float t\n") + face,
            "".join("%g %g %g 0 0\n" % corner for corner in corners) + "4 0 3 2 1\n", "bark.png"),
        one("nan", vertices() + face.replace("face 1", "face 2"), rows.replace("1 0 1", "nan 0 1", 1) + "4 0 3 2 1\n3 0 1 3\n", "face"),
        one("cloud", vertices(), rows, refused="point"),
    ]


def other_files():
    return [
        WildFile("photo-as-sky", {"plain.gltf": gltf(), "sky.png": PNG}, "nothing in it is brighter than white",
                 options=["--env", "sky.png"]),
        WildFile("stl", {"part.stl": b"solid part\nendsolid part\n"}, refused="unknown kind of scene file"),
    ]


def wild_files():
    return gltf_files() + obj_files() + ply_files() + other_files()

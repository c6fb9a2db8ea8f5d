"""Small glTF 2.0 writer. Python 3 standard library only.

Same calls, same bytes: numbers are rounded to 32-bit floats, keys keep their order, PNGs are stored uncompressed
(compressed bytes may differ between zlib versions).
"""

import base64
import json
import math
import struct
import zlib

from part import look_rotation, sub

FLOAT, UBYTE, USHORT, UINT = 5126, 5121, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class Gltf:
    """A scene being written. Materials, meshes, lights and cameras are named by what add_* returned."""

    def __init__(self, name, exposure=1.0):
        self.binary = bytearray()
        self.used = set()
        self.json = {
            "asset": {"version": "2.0", "generator": "Lightwell scenes/generate.py"},
            "scene": 0,
            # The exposure that shows the scene well; ours, other programs skip it.
            "scenes": [{"name": name, "nodes": [], "extras": {"exposure": exposure}}],
            "nodes": [], "meshes": [], "materials": [], "cameras": [], "lights": [],
            "textures": [], "images": [], "samplers": [], "accessors": [], "bufferViews": [],
            "skins": [], "animations": [],
        }
        self.key_times = {}  # accessors of times that channels share

    # ---- things ----

    def texture(self, name, width, height, texel, nearest=False):
        """Embedded RGBA PNG; `texel(x, y)` gives four bytes, row 0 at v = 0."""
        rows = b"".join(b"\0" + b"".join(bytes(texel(x, y)) for x in range(width)) for y in range(height))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))
        j = self.json
        j["images"].append({"name": name, "mimeType": "image/png", "bufferView": self._view(png, None)})
        j["samplers"].append({"magFilter": 9728 if nearest else 9729, "minFilter": 9984 if nearest else 9987,
                              "wrapS": 10497, "wrapT": 10497})
        j["textures"].append({"name": name, "source": len(j["images"]) - 1, "sampler": len(j["samplers"]) - 1})
        return len(j["textures"]) - 1

    def material(self, name, color, emission=None, texture=None, texture_scale=None, emission_texture=None,
                 alpha_cutoff=None):
        """Two-sided Lambert; emission in W/(sr m^2)."""
        pbr = {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1}
        m = {"name": name, "doubleSided": True, "pbrMetallicRoughness": pbr,
             "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}
        self.used.add("KHR_materials_specular")
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
            if texture_scale:
                pbr["baseColorTexture"]["extensions"] = {"KHR_texture_transform": {"scale": list(texture_scale)}}
                self.used.add("KHR_texture_transform")
        if emission:
            strength = max(emission)
            m["emissiveFactor"] = [e / strength for e in emission]
            if strength != 1:
                m["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
                self.used.add("KHR_materials_emissive_strength")
        if emission_texture is not None:
            m["emissiveTexture"] = {"index": emission_texture}
        if alpha_cutoff is not None:
            m["alphaMode"] = "MASK"
            m["alphaCutoff"] = alpha_cutoff
        self.json["materials"].append(m)
        return len(self.json["materials"]) - 1

    def mesh(self, name, *parts):
        """`parts`: (Part, material) pairs."""
        primitives = []
        for part, material in parts:
            attributes = {"POSITION": self._accessor(part.positions, "VEC3", bounds=True),
                          "NORMAL": self._accessor(part.normals, "VEC3")}
            if part.texcoords:
                assert len(part.texcoords) == len(part.positions), name
                attributes["TEXCOORD_0"] = self._accessor(part.texcoords, "VEC2")
            if part.joints:
                attributes["JOINTS_0"] = self._bytes_accessor(part.joints)
                attributes["WEIGHTS_0"] = self._bytes_accessor(part.weights, normalized=True)
            primitives.append({"attributes": attributes, "indices": self._indices(part.indices), "material": material})
            if part.targets:
                primitives[-1]["targets"] = [{"POSITION": self._accessor(positions, "VEC3", bounds=True),
                                              "NORMAL": self._accessor(normals, "VEC3")}
                                             for positions, normals in part.targets]
        self.json["meshes"].append({"name": name, "primitives": primitives})
        return len(self.json["meshes"]) - 1

    def node(self, name, parent=None, **fields):
        """Returns its index, to be the `parent` of others."""
        index = len(self.json["nodes"])
        self.json["nodes"].append({"name": name, **fields})
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def skin(self, name, joints, bind_positions):
        """`joints`: nodes, which do not turn in the bind pose and stand at `bind_positions` of the mesh there."""
        matrices = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1) for x, y, z in bind_positions]
        self.json["skins"].append({"name": name, "joints": joints,
                                   "inverseBindMatrices": self._accessor(matrices, "MAT4", target=None)})
        return len(self.json["skins"]) - 1

    def animate(self, node, path, times, values, interpolation="LINEAR"):
        """A channel of the scene's one animation, times in seconds; a row of `values` a key, for CUBICSPLINE three:
        tangent before, value, tangent after."""
        if not self.json["animations"]:
            self.json["animations"].append({"name": "loop", "samplers": [], "channels": []})
        key = tuple(times)
        if key not in self.key_times:
            self.key_times[key] = self._accessor([(t,) for t in times], "SCALAR", bounds=True, target=None)
        if path == "weights":
            output = self._accessor([(w,) for row in values for w in row], "SCALAR", target=None)
        else:
            output = self._accessor(values, "VEC4" if path == "rotation" else "VEC3", target=None)
        animation = self.json["animations"][0]
        animation["samplers"].append({"input": self.key_times[key], "output": output, "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                      "target": {"node": node, "path": path}})

    def add(self, name, part, material):
        """A mesh of one part, used once."""
        self.node(name, mesh=self.mesh(name, (part, material)))

    def light(self, kind, name, intensity, color=(1, 1, 1), position=None, direction=None, cone_degrees=None,
              parent=None):
        """`intensity` in W/sr, directional W/m^2; `cone_degrees` = (inner, outer) from the axis. Returns its node."""
        light = {"name": name, "type": kind, "color": list(color), "intensity": intensity}
        if cone_degrees:
            light["spot"] = {"innerConeAngle": math.radians(cone_degrees[0]),
                             "outerConeAngle": math.radians(cone_degrees[1])}
        self.json["lights"].append(light)
        self.used.add("KHR_lights_punctual")
        fields = {}
        if position:
            fields["translation"] = list(position)
        if direction:
            fields["rotation"] = [round(x, 9) for x in look_rotation(direction)]
        return self.node(name, parent, **fields,
                         extensions={"KHR_lights_punctual": {"light": len(self.json["lights"]) - 1}})

    def camera(self, name, eye, target, yfov, znear=0.01, zfar=200):
        """`yfov` in radians."""
        self.json["cameras"].append({"name": name, "type": "perspective",
                                     "perspective": {"aspectRatio": 1, "yfov": yfov, "znear": znear, "zfar": zfar}})
        self.node(name, camera=len(self.json["cameras"]) - 1, translation=list(eye),
                  rotation=[round(x, 9) for x in look_rotation(sub(target, eye))])

    # ---- files ----

    def to_bytes(self, binary):
        """The file's content: .glb if `binary`, else .gltf with everything embedded."""
        j = dict(self.json)
        lights = j.pop("lights")
        if self.used:
            j["extensionsUsed"] = sorted(self.used)
        if lights:
            j["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
        buffer = {"byteLength": len(self.binary)}
        if not binary:
            buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        j["buffers"] = [buffer]
        j = {k: v for k, v in j.items() if v != []}
        if not binary:
            return _readable_json(j).encode()
        text = json.dumps(j, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        total = 12 + 8 + len(text) + 8 + len(body)
        return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(body), b"BIN\0") + body)

    # ---- inside ----

    def _view(self, data, target):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def _accessor(self, rows, kind, bounds=False, target=ARRAY_BUFFER):
        # Rounding first hides the last digit of sin and cos, which may differ between machines.
        rows = [[round(x, 7) + 0.0 for x in row] for row in rows]
        width = len(rows[0])
        data = b"".join(struct.pack("<%df" % width, *row) for row in rows)
        accessor = {"bufferView": self._view(data, target), "componentType": FLOAT, "count": len(rows), "type": kind}
        if bounds:
            stored = [struct.unpack_from("<%df" % width, data, 4 * width * i) for i in range(len(rows))]
            accessor["min"] = [float("%.9g" % min(column)) for column in zip(*stored)]
            accessor["max"] = [float("%.9g" % max(column)) for column in zip(*stored)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def _bytes_accessor(self, rows, normalized=False):
        accessor = {"bufferView": self._view(b"".join(bytes(row) for row in rows), ARRAY_BUFFER),
                    "componentType": UBYTE, "count": len(rows), "type": "VEC4"}
        if normalized:
            accessor["normalized"] = True
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def _indices(self, indices):
        short = max(indices) < 0xFFFF
        data = struct.pack("<%d%s" % (len(indices), "H" if short else "I"), *indices)
        self.json["accessors"].append({"bufferView": self._view(data, ELEMENT_ARRAY_BUFFER),
                                       "componentType": USHORT if short else UINT, "count": len(indices),
                                       "type": "SCALAR"})
        return len(self.json["accessors"]) - 1


def _readable_json(j):
    """One line for each node, mesh, material, ...: small diffs."""
    fields = []
    for key, value in j.items():
        if isinstance(value, list):
            lines = ",\n  ".join(json.dumps(item) for item in value)
            fields.append(' %s: [\n  %s\n ]' % (json.dumps(key), lines))
        else:
            fields.append(" %s: %s" % (json.dumps(key), json.dumps(value)))
    return "{\n" + ",\n".join(fields) + "\n}\n"

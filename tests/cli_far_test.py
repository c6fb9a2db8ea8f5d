#!/usr/bin/env python3
"""A box far from 0 looks as it does at 0: by both sides, in every format, with a camera that moves.

cli_far_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path += [os.path.join(ROOT, "scenes"), os.path.join(ROOT, "scripts")]

import pixels  # noqa: E402
from command_line import CommandLine, main  # noqa: E402
from gltf_writer import Gltf  # noqa: E402
from part import Part  # noqa: E402

DISTANCES = (1e4, 1e5, 1e6)  # m
EYE, TARGET = (0.3, 1.1, 0.9), (0, 0.9, -1)
# The scene's point of reference at 0 and far away are not the same point of the box.
ROUNDING = {"energy": 0.002, "ssim": 0.998}


def box():
    return Part().box((-1, 0, -1), (1, 2, 1), inward=True)


def block():
    return Part().box((-0.5, 0, -0.5), (0.1, 0.8, 0.1))


def place(distance):
    return (distance, 0, -distance)


def write_gltf(path, distance, keys_far=False):
    """The distance is in a node; with `keys_far` the camera is beside it, and its animation's keys are far away."""
    g = Gltf("far")
    there = g.node("there", translation=place(distance))
    for part, color in ((box(), (0.7, 0.7, 0.7)), (block(), (0.6, 0.1, 0.1))):
        g.node("", there, mesh=g.mesh("", (part, g.material("", color))))
    g.light("spot", "lamp", 5, position=(0, 1.9, 0), direction=(0, -1, 0), cone_degrees=(20, 60), parent=there)
    g.json["cameras"].append({"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.01}})
    camera = g.node("main", None if keys_far else there, camera=0)
    # Sixteenths of a metre are exact in single precision even at 1e6 m.
    keys = [(-0.25, 1, 0.9375), (0.25, 1.25, 0.75)]
    moved = place(distance if keys_far else 0)
    g.animate(camera, "translation", (0, 1), [[a + b for a, b in zip(key, moved)] for key in keys])
    path.write_bytes(g.to_bytes(True))


def write_obj(path, distance):
    lines, first = [], 1
    for part in (box(), block()):
        lines += ["v %.3f %.3f %.3f" % tuple(a + b for a, b in zip(p, place(distance))) for p in part.positions]
        lines += ["f %d %d %d" % tuple(first + i for i in part.indices[t:t + 3]) for t in range(0, len(part.indices), 3)]
        first += len(part.positions)
    path.write_text("\n".join(lines) + "\n")


def write_ply(path, distance):
    positions, faces = [], []
    for part in (box(), block()):
        faces += ["3 %d %d %d" % tuple(len(positions) + i for i in part.indices[t:t + 3]) for t in range(0, len(part.indices), 3)]
        positions += ["%.3f %.3f %.3f" % tuple(a + b for a, b in zip(p, place(distance))) for p in part.positions]
    header = ["ply", "format ascii 1.0", "element vertex %d" % len(positions), *("property double " + c for c in "xyz"),
              "element face %d" % len(faces), "property list uchar int vertex_indices", "end_header"]
    path.write_text("\n".join(header + positions + faces) + "\n")


class Far(CommandLine):
    def draw(self, scene, output, technique, *more):
        options = {"path-tracer": ["--samples", 64], "light-volume": ["--frames", 12]}[technique]
        self.succeed("render", scene, "--technique", technique, "--size", "48x48", "-q", "-o", output, *options, *more)
        return output

    def expect_alike(self, test, reference, energy=ROUNDING["energy"], ssim=ROUNDING["ssim"]):
        alike = self.compare(test, reference)
        self.assertAlmostEqual(alike["energy"], 1, delta=energy, msg=(test, alike))
        self.assertGreater(alike["ssim"], ssim, (test, alike))

    def test_moving_cameras_in_path_tracing(self):
        write_gltf(self.folder / "near.glb", 0)
        self.draw("near.glb", "near-%d.exr", "path-tracer", "--time", 0.3, "--fps", 10, "--frames", 2)
        for distance in DISTANCES:
            for keys_far in (False, True):
                write_gltf(self.folder / "far.glb", distance, keys_far)
                self.draw("far.glb", "far-%d.exr", "path-tracer", "--time", 0.3, "--fps", 10, "--frames", 2)
                for frame in (0, 1):
                    self.expect_alike("far-%d.exr" % frame, "near-%d.exr" % frame)

    def test_moving_cameras_in_light_volume(self):
        """Light settles before an animation starts: that of a coarse grid, which is enough here, soonest."""
        moments = ["--time", 0.3, "--fps", 10, "--frames", 2, "--resolution", 16]
        pictures = []
        for distance in (0, DISTANCES[-1]):
            write_gltf(self.folder / "scene.glb", distance, True)
            name = "%g-%%d.exr" % distance
            self.succeed("render", "scene.glb", "--technique", "light-volume", "--size", "48x48", "-q", "-o", name, *moments)
            pictures.append(name)
        for frame in (0, 1):
            self.expect_alike(pictures[1] % frame, pictures[0] % frame, 0.02, 0.99)

    def test_text_formats(self):
        for ending, write in ((".obj", write_obj), (".ply", write_ply)):
            pictures = []
            for distance in (0, DISTANCES[-1]):
                scene = "%g%s" % (distance, ending)
                write(self.folder / scene, distance)
                eye, target, lamp = (",".join("%.3f" % (a + b) for a, b in zip(p, place(distance)))
                                     for p in (EYE, TARGET, (0.4, 1.7, 0.3)))
                view = ["--eye", eye, "--target", target, "--light", "point pos=%s intensity=3" % lamp]
                pictures.append([self.draw(scene, "%s-%g.exr" % (technique, distance), technique, *view)
                                 for technique in ("path-tracer", "light-volume")])
            self.expect_alike(pictures[1][0], pictures[0][0])
            self.expect_alike(pictures[1][1], pictures[0][1], 0.02, 0.98)

    def test_positions_are_those_of_the_file(self):
        write_gltf(self.folder / "far.glb", DISTANCES[-1])
        self.succeed("render", "far.glb", "--technique", "none", "--size", "16x16", "-q", "--aov", "position", "-o", "x.exr")
        for row in pixels.load_exr(self.folder / "x.position.exr"):
            for position in row:
                for at, here in zip(position, place(DISTANCES[-1])):
                    self.assertLess(math.fabs(at - here), 2.1)
        self.assertIn("1e+06", self.succeed("info", "far.glb"))


if __name__ == "__main__":
    main()

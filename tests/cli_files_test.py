#!/usr/bin/env python3
"""Files that the command line reads and writes: strange, hostile and large ones, and being interrupted.

cli_files_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json
import os
import pathlib
import pty
import resource
import signal
import stat
import subprocess
import time

from command_line import CommandLine, gray_png, main, png, tiny_scene

CASES = pathlib.Path(__file__).resolve().parents[2] / "shared" / "cases-crash"
PATH_TRACER = ["--technique", "path-tracer", "--samples", 1, "--size", "8x8", "--env", "1"]


def textured_scene(images):
    """The tiny scene, with a material for each of the image URIs; each image has a sampler of its own."""
    scene = tiny_scene()
    scene["images"] = [{"uri": uri} for uri in images]
    scene["samplers"] = [{"wrapS": wrap_s, "wrapT": wrap_t} for wrap_s in (10497, 33071, 33648)
                         for wrap_t in (10497, 33071, 33648)][:len(images)]
    scene["textures"] = [{"source": i, "sampler": i % 9} for i in range(len(images))]
    scene["materials"] = [{"emissiveTexture": {"index": i}} for i in range(len(images))]
    return scene


def limit(kind, amount):
    """For subprocess's preexec_fn: a limit of the system on the program."""
    return lambda: resource.setrlimit(kind, (amount, resource.getrlimit(kind)[1]))


class Reading(CommandLine):
    def write_scene(self, name, scene):
        (self.folder / name).write_text(json.dumps(scene))

    def peak_bytes(self, *arguments):
        """Of memory, of a run that may fail."""
        with open(os.devnull, "w") as nothing:
            process = subprocess.Popen([self.program, *arguments], cwd=self.folder, stdout=nothing, stderr=nothing)
            _, _, usage = os.wait4(process.pid, 0)
            process.returncode = 0  # waited for already
        return usage.ru_maxrss * 1024

    def test_damaged_textures_are_warnings(self):
        whole = gray_png([[1, 2, 3]] * 3)
        (self.folder / "cut.png").write_bytes(whole[:-20])
        (self.folder / "cut.tga").write_bytes(bytes([0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 9, 0, 24, 0]) + bytes(100))
        (self.folder / "cut.jpg").write_bytes(b"\xff\xd8\xff\xe0")
        for name in ("cut.png", "cut.tga", "cut.jpg"):
            self.write_scene("a.gltf", textured_scene([name]))
            result = json.loads(self.succeed("info", "a.gltf", "--json"))
            self.assertEqual(len([w for w in result["warnings"] if w.startswith(name + ": damaged")]), 1, result)
            self.assertEqual(result["counts"]["textures"], 0)

    def test_names_with_control_characters(self):
        self.write_scene("a.gltf", textured_scene(["%1b[31m%0aerror.png"]))
        result = self.run_program("render", "a.gltf", "-o", "x.exr", *PATH_TRACER)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (0, 1), result.stderr)
        self.assertIn("\\x1b[31m\\nerror.png: texture not found", result.stderr)
        self.assertNotIn("\x1b", self.succeed("info", "a.gltf"))
        self.fail_with("a\\x1b[0m\\n", "info", "a\x1b[0m\n.gltf")

    def test_root(self):
        os.mkdir(self.folder / "in")
        (self.folder / "secret.png").write_bytes(gray_png([[1]]))
        self.write_scene("in/a.gltf", textured_scene(["../secret.png"]))
        self.assertEqual(json.loads(self.succeed("info", "in/a.gltf", "--json"))["counts"]["textures"], 1)
        self.succeed("info", "in/a.gltf", "--root", ".")
        self.fail_with("secret.png: lies outside of", "info", "in/a.gltf", "--root", "in")
        self.fail_with("secret.png: lies outside of", "render", "in/a.gltf", "--root", "in", "-o", "x.exr", *PATH_TRACER)
        self.fail_with("--root: 'none' is no folder", "info", "in/a.gltf", "--root", "none")

    def test_what_is_no_regular_file(self):
        os.mkfifo(self.folder / "fifo")
        for name in ("fifo", "/dev/zero"):
            self.write_scene("a.gltf", textured_scene([name]))
            self.fail_with("not a regular file", "info", "a.gltf", timeout=20)

    def test_small_pictures_that_unfold_into_much(self):
        (self.folder / "white.png").write_bytes(png(16384, 16384, 1, [b"\xff" * 2048] * 16384))
        self.write_scene("a.gltf", textured_scene(["white.png"] * 5))
        self.fail_with("MiB of textures", "info", "a.gltf")
        self.assertLess(self.peak_bytes("info", "a.gltf"), 500e6)

    def test_memory_and_time_of_json_follow_its_size(self):
        scene = tiny_scene()
        light = {"extensions": {"KHR_lights_punctual": {"light": 0}}}
        scene["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
        scene["nodes"] += [light] * 200000
        scene["scenes"][0]["nodes"] = list(range(len(scene["nodes"])))
        self.write_scene("many.gltf", scene)
        size = os.path.getsize(self.folder / "many.gltf")
        more = self.peak_bytes("info", "many.gltf", "--json") - self.peak_bytes("info", "tiny.gltf")
        self.assertLess(more, 12 * size)
        result = json.loads(self.succeed("info", "many.gltf", "--json"))
        self.assertEqual(result["counts"]["lights"], 200000)
        self.assertEqual(len(result["lights"]), 200000)

    def test_known_cases(self):
        if not CASES.is_dir():
            self.skipTest("no " + str(CASES))
        for case in ("jpeg-null-reason/tex.gltf", "jpeg-null-reason/a.obj", "jpeg-huffman-overrun/tex.gltf",
                     "truncated-bitmap/x.gltf", "truncated-bitmap/xb.gltf"):
            result = json.loads(self.succeed("info", CASES / case, "--json"))
            self.assertEqual(len([w for w in result["warnings"] if "damaged" in w]), 1, case)
        folder = CASES / "path-traversal"
        self.fail_with("lies outside of", "info", folder / "leak.gltf", "--root", folder)


class Writing(CommandLine):
    def test_a_link_is_followed_and_the_mode_is_kept(self):
        os.mkdir(self.folder / "store")
        (self.folder / "store" / "real.exr").write_text("old")
        os.chmod(self.folder / "store" / "real.exr", 0o600)
        os.symlink("store/real.exr", self.folder / "x.exr")
        self.succeed("render", "tiny", "-o", "x.exr", *PATH_TRACER)
        self.assertTrue((self.folder / "x.exr").is_symlink())
        self.assertNotEqual((self.folder / "store" / "real.exr").read_bytes(), b"old")
        self.assertEqual(stat.S_IMODE(os.stat(self.folder / "store" / "real.exr").st_mode), 0o600)

    def test_long_names(self):
        name = "x" * 251 + ".exr"
        self.succeed("render", "tiny", "-o", name, *PATH_TRACER)
        self.assertTrue((self.folder / name).exists())

    def test_a_limit_on_file_size_is_an_error(self):
        self.fail_with("x.exr: could not be written", "render", "tiny", "-o", "x.exr", *PATH_TRACER,
                       preexec_fn=limit(resource.RLIMIT_FSIZE, 100))

    def interrupt(self, what, ready):
        """Runs on a terminal of its own, sends the signal once the output holds `ready`; returns output and status."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([self.program, "render", "tiny", "-o", "x.exr", "--technique", "path-tracer", "--size",
                                    "512x512", "--samples", "100000", "--env", "1"], cwd=self.folder, stdin=theirs,
                                   stdout=theirs, stderr=theirs,
                                   env=dict(os.environ, LIGHTWELL_SCENES=str(self.folder)))
        os.close(theirs)
        output = b""
        deadline = time.monotonic() + 60
        while ready not in output and time.monotonic() < deadline:
            output += os.read(ours, 4096)
        process.send_signal(what)
        status = process.wait(timeout=60)
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            output += part
        os.close(ours)
        return output, status

    def test_interruption_removes_the_progress_bar(self):
        for what in (signal.SIGINT, signal.SIGTERM):
            output, status = self.interrupt(what, b"%, ")
            self.assertEqual(status, -what)
            self.assertTrue(output.endswith(b"\r\x1b[K"), output[-200:])
            self.assertEqual(os.listdir(self.folder), ["tiny.gltf"])


class Memory(CommandLine):
    def test_a_picture_larger_than_memory(self):
        limited = {"preexec_fn": limit(resource.RLIMIT_AS, 4 << 30)}
        self.fail_with("GB of memory", "render", "tiny", "-o", "x.exr", "--size", "8192x8192", "--technique", "path-tracer",
                       **limited)

    def test_frames_take_more_than_the_picture(self):
        software = [str(i) for i, device in enumerate(json.loads(self.succeed("info", "--json")))
                    if device["type"] == "software" and not device["missing"]]
        if not software:
            self.skipTest("no software device")
        more = ["--device", software[0], "--technique", "none", "--size", "4096x4096"]
        limited = {"preexec_fn": limit(resource.RLIMIT_AS, 6 << 30), "timeout": 30}
        self.fail_with("GB of memory", "render", "tiny", "-o", "x.exr", *more, **limited)
        self.fail_with("GB of memory", "bench", "tiny", *more, **limited)


class Drivers(CommandLine):
    def test_a_malformed_manifest(self):
        (self.folder / "driver.json").write_text('{"file_format_version": "1.0.0", "ICD": {')
        manifest = str(self.folder / "driver.json")
        self.fail_with("a driver's manifest is malformed", "render", "tiny", "-o", "x.exr", "--technique", "none",
                       environment={"VK_ICD_FILENAMES": manifest, "VK_DRIVER_FILES": manifest})


if __name__ == "__main__":
    main()

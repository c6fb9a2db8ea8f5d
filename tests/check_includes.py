#!/usr/bin/env python3
"""Checks that includes point one way: every file sees only the layers before its own.

usage: tests/check_includes.py [ROOT]      exit code 1 and one line for each bad include

Looks at src/ and include/lightwell/, C++ and GLSL alike. A technique never includes another technique.
"""

import os
import re
import sys

# Layer -> layers that it may include besides itself.
MAY_INCLUDE = {
    "core": [],
    "scene": ["core"],
    "reference": ["core", "scene"],
    "gpu": ["core", "scene"],
    # GLSL that passes share: scene access there reads what passes/gpu_scene lays out, so these two see each other.
    "shaders": ["core", "scene", "gpu", "passes"],
    "graph": ["core", "scene", "shaders", "gpu"],
    "passes": ["core", "scene", "shaders", "gpu", "graph"],
    "techniques": ["core", "scene", "shaders", "gpu", "graph", "passes"],
    "renderer": ["core", "scene", "shaders", "gpu", "graph", "passes", "techniques"],
    "apps": ["core", "scene", "shaders", "gpu", "graph", "passes", "techniques", "renderer", "reference"],
}

# A public header belongs to the layer that implements it.
PUBLIC = {
    "error.h": "core", "image.h": "core", "log.h": "core", "metrics.h": "core", "options.h": "core", "picture.h": "core",
    "scene.h": "scene",
    "path_tracer.h": "reference", "photon_mapper.h": "reference",
    "vulkan.h": "gpu", "device.h": "gpu",
    "renderer.h": "renderer",
}

SOURCES = (".h", ".cpp", ".comp", ".vert", ".frag", ".glsl", ".rgen", ".rchit", ".rmiss")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def place(path):
    """(layer, technique or None) of a path relative to the root; layer None: none of ours."""
    parts = path.split("/")
    if parts[:2] == ["include", "lightwell"]:
        return PUBLIC.get("/".join(parts[2:])), None
    if parts[0] != "src" or len(parts) < 3:
        return None, None
    layer = parts[1] if parts[1] in MAY_INCLUDE else None
    return layer, parts[2] if layer == "techniques" and len(parts) > 3 else None


def target(root, including, name):
    """Path relative to the root of what `#include "name"` in `including` means; None: not ours."""
    if name.startswith("lightwell/"):
        return "include/" + name
    # Generated from src/FOLDER: kernels/FOLDER/shader.comp.h
    if name.startswith("kernels/"):
        return "src/" + name[len("kernels/"):]
    beside = os.path.normpath(os.path.join(os.path.dirname(including), name)).replace(os.sep, "/")
    if os.path.exists(os.path.join(root, beside)):
        return beside
    if name.split("/")[0] in MAY_INCLUDE and "/" in name:
        return os.path.normpath("src/" + name).replace(os.sep, "/")
    return None


def without_comments(text):
    """Line breaks stay, so that line numbers do."""
    return COMMENT.sub(lambda m: "\n" * m.group().count("\n"), text)


def check_file(root, path):
    layer, technique = place(path)
    if layer is None:
        yield "%s: belongs to no layer; name it in tests/check_includes.py" % path
        return
    with open(os.path.join(root, path), encoding="utf-8") as f:
        text = without_comments(f.read())
    for match in INCLUDE.finditer(text):
        included = target(root, path, match.group(1))
        if included is None:
            continue
        where = "%s:%d" % (path, text.count("\n", 0, match.start(1)) + 1)
        its_layer, its_technique = place(included)
        if its_layer is None:
            yield "%s: %s belongs to no layer; name it in tests/check_includes.py" % (where, included)
        elif its_layer != layer and its_layer not in MAY_INCLUDE[layer]:
            yield "%s: %s must not include %s (%s)" % (where, layer, its_layer, match.group(1))
        elif layer == "techniques" and its_technique not in (None, technique):
            yield "%s: a technique's folder is its own (%s)" % (where, match.group(1))


def check(root):
    """All complaints about the tree at `root`, and how many files were read."""
    complaints, files = [], 0
    for top in ("include/lightwell", "src"):
        for folder, _, names in sorted(os.walk(os.path.join(root, top))):
            for name in sorted(names):
                if name.endswith(SOURCES):
                    path = os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")
                    complaints += check_file(root, path)
                    files += 1
    return complaints, files


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    complaints, files = check(root)
    for line in complaints:
        print(line)
    if files == 0:
        print("%s: no source files found" % root)
    else:
        print("include direction: %d files, %d bad includes" % (files, len(complaints)))
    sys.exit(1 if complaints or files == 0 else 0)


if __name__ == "__main__":
    main()

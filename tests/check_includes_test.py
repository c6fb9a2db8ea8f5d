#!/usr/bin/env python3
"""check_includes.py must find what it is there for: made-up good and bad trees."""

import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_includes  # noqa: E402

GOOD = {
    "include/lightwell/image.h": "#include <vector>\n",
    "include/lightwell/scene.h": '#include "lightwell/image.h"\n',
    "src/core/log.h": "",
    "src/core/log.cpp": '#include "core/log.h"\n#include "stb_image.h"\n',
    "src/reference/path.cpp": '#include "lightwell/scene.h"\n#include <embree3/rtcore.h>\n',
    "src/shaders/sh.glsl": "",
    "src/passes/trace/trace.h": "",
    "src/techniques/technique.h": '#include "passes/trace/trace.h"\n',
    "src/techniques/alpha/alpha.cpp": '#include "alpha.h"\n#include "techniques/technique.h"\n'
                                      '#include "kernels/techniques/alpha/gather.comp.h"\n',
    "src/techniques/alpha/alpha.h": "",
    "src/techniques/alpha/gather.comp": '#version 450\n#include "shaders/sh.glsl"\n#include "alpha.h"\n',
    "src/apps/cli/main.cpp": '#include "reference/path.h"\n#include "renderer/frame.h"\n',
    "src/graph/graph.cpp": '// #include "techniques/technique.h"\n/*\n#include "passes/trace/trace.h"\n*/\n',
}

# One bad file added to the good tree, and a word of the complaint.
BAD = [
    ("src/core/a.cpp", '#include "scene/b.h"\n', "core must not include scene"),
    ("src/core/a.cpp", '#include "lightwell/scene.h"\n', "core must not include scene"),
    ("src/core/a.cpp", "  #  include <lightwell/scene.h>\n", "core must not include scene"),
    ("src/core/a.cpp", '#include "../passes/trace/trace.h"\n', "core must not include passes"),
    ("include/lightwell/error.h", '#include "lightwell/scene.h"\n', "core must not include scene"),
    ("src/reference/a.cpp", '#include "gpu/device.h"\n', "reference must not include gpu"),
    ("src/gpu/a.cpp", '#include "reference/embree.h"\n', "gpu must not include reference"),
    ("src/passes/trace/a.comp", '#include "techniques/alpha/alpha.h"\n', "passes must not include techniques"),
    ("src/passes/a.cpp", '#include "kernels/techniques/alpha/gather.comp.h"\n', "passes must not include techniques"),
    ("src/techniques/beta/b.cpp", '#include "techniques/alpha/alpha.h"\n', "folder is its own"),
    ("src/techniques/beta/b.comp", '#include "../alpha/alpha.h"\n', "folder is its own"),
    ("src/techniques/table.cpp", '#include "techniques/alpha/alpha.h"\n', "folder is its own"),
    ("src/techniques/beta/b.cpp", '#include "renderer/frame.h"\n', "techniques must not include renderer"),
    ("include/lightwell/surprise.h", "", "belongs to no layer"),
    ("src/core/a.cpp", '#include "lightwell/surprise.h"\n', "belongs to no layer"),
    ("src/attic/a.cpp", "", "belongs to no layer"),
]


def write(root, path, text):
    full = os.path.join(root, path)
    os.makedirs(os.path.dirname(full), exist_ok=True)
    with open(full, "w", encoding="utf-8") as f:
        f.write(text)


class CheckIncludesTest(unittest.TestCase):
    def complaints(self, *more):
        with tempfile.TemporaryDirectory() as root:
            for path, text in [*GOOD.items(), *more]:
                write(root, path, text)
            return check_includes.check(root)[0]

    def test_good_tree_passes(self):
        self.assertEqual(self.complaints(), [])

    def test_each_bad_include_is_found_once(self):
        for path, text, expected in BAD:
            with self.subTest(path=path, text=text):
                found = self.complaints((path, text))
                self.assertEqual(len(found), 1, found)
                self.assertIn(expected, found[0])
                self.assertTrue(found[0].startswith(path))

    def test_line_numbers_count_comments(self):
        found = self.complaints(("src/core/a.cpp", '/* two\nlines */\n#include "gpu/device.h"\n'))
        self.assertIn("src/core/a.cpp:3:", found[0])

    def test_an_empty_tree_is_no_success(self):
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(check_includes.check(root), ([], 0))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Does what docs/adding_a_technique.md says, word for word, in a copy of the tree: runs its shell blocks, writes its files.

usage: tests/adding_a_technique_test.py [unittest arguments]     (Python 3 standard library only)
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COPIED = ("CMakeLists.txt", "CMakePresets.json", "cmake", "include", "scenes", "src", "tests")
# A block of the page: shell commands, or a file with its path above.
BLOCK = re.compile(r"(?:`(?P<path>src/[^`]+)`:\n\n)?```(?P<language>\w+)\n(?P<text>.*?)```", re.DOTALL)


def blocks():
    with open(os.path.join(ROOT, "docs", "adding_a_technique.md"), encoding="utf-8") as page:
        return [match.groupdict() for match in BLOCK.finditer(page.read())]


class AddingATechnique(unittest.TestCase):
    def run_shell(self, text):
        done = subprocess.run(["bash", "-euc", text], cwd=self.tree, env=self.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, text + done.stdout[-4000:] + done.stderr[-4000:])
        return done.stdout

    def test_the_page_word_for_word(self):
        with tempfile.TemporaryDirectory() as folder:
            self.tree = os.path.join(folder, "lightwell")
            os.mkdir(self.tree)
            for name in COPIED:
                source = os.path.join(ROOT, name)
                copy = shutil.copytree if os.path.isdir(source) else shutil.copy2
                copy(source, os.path.join(self.tree, name))
            # What the page's build shares with the one under test comes out of the compiler cache, where there is one.
            self.environment = dict(os.environ)
            for block in blocks():
                if block["language"] == "sh":
                    self.run_shell(block["text"])
                elif block["path"]:
                    with open(os.path.join(self.tree, block["path"]), "w", encoding="utf-8") as f:
                        f.write(block["text"])
            self.assertIn("--strength", self.run_shell("build/lightwell render --technique glow --help"))
            difference = os.path.join(self.tree, "difference.png")
            self.assertGreater(os.path.getsize(difference), 0)
            # Indirect light there is, and by the option in proportion.
            means = []
            for strength in ("0", "0.4", "0.8"):
                self.run_shell("build/lightwell render cornell-spot --technique glow --strength %s --size 32x32 "
                               "--aov indirect -o %s.exr" % (strength, strength))
                means.append(self.run_shell("build/lightwell compare %s.indirect.exr 0.indirect.exr --json" % strength))
            self.assertEqual(len(set(means)), 3)


if __name__ == "__main__":
    unittest.main()

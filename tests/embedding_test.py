#!/usr/bin/env python3
"""A host's project that adds Lightwell and compiles the code of docs/embedding.md, block after block, in one function.

usage: tests/embedding_test.py CMAKE CXX [unittest arguments]     (Python 3 standard library only)
"""

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CMAKE, CXX = None, None

# The host needs none of these: they are of the tests, the path tracer and the command line.
NOT_NEEDED = ("GTest", "embree", "CLI11", "Python3")

PROJECT = """
cmake_minimum_required(VERSION 3.22)
project(host CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_subdirectory("%s" lightwell)
add_executable(host host.cpp)
target_link_libraries(host PRIVATE lightwell_renderer)
"""

# What the page takes for granted: the host's own Vulkan and its frame loop.
PROGRAM = """
#include <vulkan/vulkan.h>

#include <cmath>
#include <iostream>

%s

void frame(VkInstance instance, VkPhysicalDevice physical_device, VkDevice vk_device, std::uint32_t queue_family,
           VkQueue queue, VkImage image, VkCommandBuffer command_buffer, const lightwell::WorldCamera& camera,
           std::uint64_t completed_frame, float time) {
%s
}

int main() {}
"""


def code_blocks():
    with open(os.path.join(ROOT, "docs", "embedding.md"), encoding="utf-8") as page:
        return re.findall(r"```cpp\n(.*?)```", page.read(), re.DOTALL)


class Host(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        blocks = code_blocks()
        includes = "\n".join(line for block in blocks for line in block.splitlines() if line.startswith("#include"))
        body = "\n".join(line for block in blocks for line in block.splitlines() if not line.startswith("#include"))
        for name, text in (("CMakeLists.txt", PROJECT % ROOT), ("host.cpp", PROGRAM % (includes, body))):
            with open(os.path.join(cls.folder.name, name), "w", encoding="utf-8") as file:
                file.write(text)
        cls.configured = cls.run_command(
            CMAKE, "-S", cls.folder.name, "-B", os.path.join(cls.folder.name, "build"), "-G", "Ninja",
            "-DCMAKE_CXX_COMPILER=" + CXX, *("-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON" % name for name in NOT_NEEDED))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_command(*command, cwd=None):
        return subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def compile_commands(self):
        self.assertEqual(self.configured.returncode, 0, self.configured.stdout)
        with open(os.path.join(self.folder.name, "build", "compile_commands.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_gets_the_library_alone(self):
        commands = self.compile_commands()
        files = [os.path.relpath(c["file"], ROOT) for c in commands]
        self.assertIn("src/renderer/renderer.cpp", files)
        unwanted = [f for f in files if f.endswith("_test.cpp") or f.startswith(("src/apps", "src/reference", "tests"))]
        self.assertEqual(unwanted, [])

    def test_keeps_its_own_rules_for_warnings(self):
        self.assertFalse([c["file"] for c in self.compile_commands() if "-Werror" in shlex.split(c["command"])])

    def test_code_of_the_page_compiles(self):
        self.assertGreaterEqual(len(code_blocks()), 4)
        host = next(c for c in self.compile_commands() if c["file"].endswith("host.cpp"))
        compiled = self.run_command(*shlex.split(host["command"]), "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
                                    "-Wno-unused", "-Wno-missing-field-initializers", cwd=host["directory"])
        self.assertEqual(compiled.returncode, 0, compiled.stdout)


if __name__ == "__main__":
    CMAKE, CXX = sys.argv[1:3]
    del sys.argv[1:3]
    unittest.main()

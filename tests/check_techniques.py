#!/usr/bin/env python3
"""Adding a technique is one folder: no file outside src/techniques/NAME may mention it in code.

Usage: check_techniques.py ROOT. Prints each offending line; exit code 1 if there is one."""
import pathlib
import re
import sys


def offences(root):
    root = pathlib.Path(root)
    folders = [p for p in sorted((root / "src/techniques").iterdir()) if p.is_dir()]
    found = []
    sources = [p for pattern in ("*.cpp", "*.h", "*.comp", "*.glsl", "*.vert", "*.frag", "CMakeLists.txt", "*.cmake")
               for folder in ("src", "include", "cmake") for p in (root / folder).rglob(pattern)]
    for folder in folders:
        mention = re.compile(r"kTechnique_%s\b|techniques/%s/|kernels::%s_" % ((folder.name,) * 3))
        for source in sources:
            if folder in source.parents or source.name.endswith("_test.cpp"):
                continue
            for number, line in enumerate(source.read_text().splitlines(), 1):
                if mention.search(line):
                    found.append("%s:%d: mentions technique %s: %s" % (source.relative_to(root), number, folder.name, line.strip()))
    return folders, found


def main():
    folders, found = offences(sys.argv[1])
    print("\n".join(found))
    if not folders:
        print("no techniques found")
    return 1 if found or not folders else 0


if __name__ == "__main__":
    sys.exit(main())

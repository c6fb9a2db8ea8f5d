#!/usr/bin/env python3
"""Sums up CTest's JUnit files: names every skipped and failed test, then one line of counts.

usage: scripts/test_summary.py FOLDER
"""

import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree


def reason(case):
    """Why a GoogleTest or script was skipped, from its output; empty if it does not say."""
    output = case.findtext("system-out") or ""
    found = re.search(r": Skipped\n(.*)", output) or re.search(r"^SKIPPED:? *(.*)", output, re.MULTILINE)
    return ": " + found.group(1).strip() if found and found.group(1).strip() else ""


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: scripts/test_summary.py FOLDER")
    passed, failed, skipped = 0, [], []
    for path in sorted(glob.glob(os.path.join(sys.argv[1], "*.xml"))):
        run = os.path.splitext(os.path.basename(path))[0]
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            name = case.get("name") + ("" if run == "tests" else " [%s]" % run)
            status = case.get("status")
            if status == "run":
                passed += 1
            elif status in ("notrun", "disabled"):
                skipped.append(name + reason(case))
            else:
                failed.append(name)
    for name in skipped:
        print("SKIPPED " + name)
    try:
        with open(os.path.join(sys.argv[1], "skipped.txt"), encoding="utf-8") as f:
            others = f.read().splitlines()
    except FileNotFoundError:
        others = []
    for line in others:
        print(line)
    for name in failed:
        print("FAILED " + name)
    print("%d passed, %d failed, %d skipped" % (passed, len(failed), len(skipped) + len(others)))


if __name__ == "__main__":
    main()

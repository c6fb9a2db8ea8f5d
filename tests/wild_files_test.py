#!/usr/bin/env python3
"""What files as people have them lose is said, each loss by one warning, and nothing else is.

wild_files_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json

from command_line import CommandLine, main
from wild_files import wild_files


class WildFiles(CommandLine):
    def lay_out(self, wild):
        """Returns the arguments of the scene."""
        folder = self.folder / wild.name
        folder.mkdir()
        for name, content in wild.files.items():
            (folder / name).write_bytes(content)
        options = [f"{wild.name}/{option}" if option in wild.files else option for option in wild.options]
        return [f"{wild.name}/{next(iter(wild.files))}", *options]

    def test_there_are_many(self):
        files = wild_files()
        self.assertGreaterEqual(len(files), 40)
        self.assertEqual(len({wild.name for wild in files}), len(files))

    def test_each_loss_is_one_warning(self):
        for wild in wild_files():
            with self.subTest(wild.name):
                arguments = self.lay_out(wild)
                if wild.refused:
                    self.fail_with(wild.refused, "info", *arguments)
                    continue
                result = json.loads(self.succeed("info", *arguments, "--json"))
                warnings = result["warnings"]
                for part in wild.said:
                    self.assertEqual(sum(part in warning for warning in warnings), 1, warnings)
                self.assertEqual(len(warnings), len(wild.said), warnings)
                self.assertGreater(result["counts"]["triangles"], 0)

    def test_text_and_strict_say_the_same(self):
        for wild in wild_files()[::6]:
            with self.subTest(wild.name):
                arguments = self.lay_out(wild)
                if wild.refused:
                    continue
                lines = [line for line in self.succeed("info", *arguments).splitlines() if line.startswith("warning ")]
                self.assertEqual(len(lines), len(wild.said), lines)
                self.assertEqual(self.run_program("info", *arguments, "--strict").returncode, 2 if wild.said else 0)


if __name__ == "__main__":
    main()

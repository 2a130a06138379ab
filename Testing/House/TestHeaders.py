# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether headers of VTK classes keep the rules that VTK's HeaderTesting has for its own."""

import re
import unittest

import house

CLASS = re.compile(r"^class (\w+_EXPORT )?(vtk\w+)\s*:\s*public (vtk\w+)", re.MULTILINE)


def headers():
    """Path, text, class, its parent."""
    for path in house.files("vtk*.h", "vtk*.h.in", under=["Filters", "Representations"]):
        text = house.text(path)
        if "TypeMacro(" in text:
            yield path, text, CLASS.findall(text)


class TestHeaders(unittest.TestCase):
    def check(self, is_right):
        """`is_right`: of text, name and parent."""
        found = list(headers())
        self.assertGreater(len(found), 5)
        for path, text, classes in found:
            with self.subTest(header=str(path)):
                self.assertEqual(len(classes), 1, "There is to be one class.")
                _, name, parent = classes[0]
                self.assertTrue(is_right(text, name, parent))

    def test_guards_are_named_after_the_file(self):
        self.check(lambda text, name, _: f"#ifndef {name}_h\n#define {name}_h\n" in text)

    def test_classes_are_named_after_the_file(self):
        for path, _, classes in headers():
            self.assertEqual([name for _, name, _ in classes], [path.name.split(".")[0]])

    def test_classes_are_exported(self):
        for path, _, classes in headers():
            self.assertTrue(all(export for export, _, _ in classes), path)

    def test_parents_are_included(self):
        self.check(lambda text, _, parent: f'#include "{parent}.h"' in text)

    def test_other_headers_are_included_for_a_reason(self):
        def is_right(text, name, parent):
            lines = re.findall(r"^\s*#\s*include.*", text, re.MULTILINE)
            return all(f'"{parent}.h"' in line or " // " in line for line in lines)
        self.check(is_right)

    def test_types_are_named(self):
        self.check(lambda text, name, parent: re.search(
            rf"vtk(Abstract)?TypeMacro\({name}, {parent}\)", text))

    def test_all_can_print_themselves(self):
        self.check(lambda text, *_: re.search(
            r"void PrintSelf\(ostream& os, vtkIndent indent\) override", text))

    def test_none_can_be_copied(self):
        self.check(lambda text, name, _: all(re.search(pattern, text) for pattern in (
            rf"{name}\(const {name}&\) = delete;",
            rf"void operator=\(const {name}&\) = delete;")))


if __name__ == "__main__":
    unittest.main()

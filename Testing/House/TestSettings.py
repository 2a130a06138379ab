# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the table of settings, cuda/optimize/Settings.xml, is whole, and what is made from it."""

import re
import sys
import unittest

import house

sys.path.insert(0, str(house.ROOT / "Plugin/cmake"))
import settings  # pylint: disable=wrong-import-position

#: Members of limpid::Settings that no user sets, which Settings.cxx compares by hand.
NOT_IN_TABLE = {"scoreIterations", "otherCameras"}


def members(path, struct):
    """The names of the members of a struct."""
    text = house.text(path)
    body = re.search(rf"^struct {struct}\n{{\n(.*?)^}};", text, re.S | re.M).group(1)
    return set(re.findall(r"^  [\w:<>, ]+ (\w+)(?:;| = | ?\{)", body, re.M))


class TestSettings(unittest.TestCase):
    def setUp(self):
        self.table = settings.read_table()

    def test_every_member_of_the_core_is_in_the_table(self):
        expected = members("cuda/optimize/Settings.h", "Settings") - {"weights", "ament"}
        expected |= {f"weights.{name}" for name in members("cuda/optimize/Settings.h", "Weights")}
        expected |= {f"ament.{name}" for name in members("cuda/methods/Method.h", "AmentWeights")}
        found = {entry.of("Core").get("member") for entry in self.table} - {None}

        self.assertEqual(expected - found, NOT_IN_TABLE)
        self.assertEqual(found - expected, set())

    def test_nothing_is_there_twice(self):
        names = [entry.name for entry in self.table]
        self.assertEqual(len(set(names)), len(names))

    def test_intervals_say_which_ends_belong(self):
        for text, advice in {
                "[0, inf)": "Set it to zero or more.", "(0, inf)": "Set it above zero.",
                "[0.1, 16]": "Set it between 0.1 and 16.",
                "(0, 1]": "Set it above 0 and at most 1.",
                "[0, 180)": "Set it from 0 to below 180."}.items():
            self.assertEqual(settings.Interval(text).advice(), advice)
        with self.assertRaisesRegex(ValueError, "not an interval"):
            settings.Interval("0..1")

    def test_an_unknown_setting_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "no entry for .*Nothing"):
            settings.filled('<Setting name="Nothing"/>', self.table)

    def test_an_unknown_attribute_is_an_error(self):
        entry = '<Settings><X name="Speed"><Core membr="speed"/></X></Settings>'
        with self.assertRaisesRegex(ValueError, "Speed: Core has membr .it may have error, member"):
            settings.read_table(entry)

    def test_every_choice_has_a_constant(self):
        entry = ('<Settings><X name="Speed"><EnumerationDomain><Entry value="0" text="Low"/>'
                 '</EnumerationDomain><Class constants="LOW HIGH"/></X></Settings>')
        with self.assertRaisesRegex(ValueError, "Speed has 2 constants for 1 entries"):
            self.assertTrue(settings.read_table(entry)[0].constants)

    def test_numbers_of_the_python_package_have_a_unit(self):
        for entry in settings.of_python(self.table):
            is_number = not entry.constants and entry.type != "vtkTypeBool"
            self.assertEqual(bool(entry.of("Python").get("unit")), is_number, entry.name)
            self.assertTrue(entry.text("Python").endswith("."), entry.name)

    def test_the_server_manager_gets_what_it_knows_alone(self):
        for entry in self.table:
            for own in settings.OWN:
                self.assertNotRegex("".join(entry.property()), rf"<{own}\b")

    def test_every_template_can_be_filled(self):
        templates = [path for path in house.files("*.in", under=["Filters", "Plugin", "cuda"])
                     if "@limpid_" in house.text(path)]
        self.assertGreater(len(templates), 3)
        for path in templates:
            self.assertNotIn("@limpid_", settings.filled(house.text(path), self.table), path)

    def test_the_page_of_parameters_is_up_to_date(self):
        page = house.text("Documentation/Parameters.md")
        self.assertIn("| `ViewWeight` |", page)
        self.assertEqual(page, settings.filled(page, self.table), "Run: python3 "
                         "Plugin/cmake/settings.py " + 2 * "Documentation/Parameters.md ")

    def test_every_property_has_values_default_and_meaning_and_every_number_a_unit(self):
        page = house.text("Documentation/Parameters.md").split("## All settings")[1]
        tables = [table.splitlines() for table in re.findall(r"(?:^\|.*\n)+", page, re.M)]
        rows = [dict(zip(self.cells(table[0]), self.cells(row)))
                for table in tables for row in table[2:]]
        self.assertGreater(len(rows), len(self.table))
        for row in rows:
            for column in ("values", "default", "meaning"):
                self.assertTrue(row[column], f"{row['property']} has no {column}")
            if re.search(r"\[|\(.*inf|number|any", row["values"]):
                self.assertTrue(row["unit"], f"{row['property']} has no unit")

    @staticmethod
    def cells(row):
        return [cell.strip() for cell in row.strip("|").split("|")]


if __name__ == "__main__":
    unittest.main()

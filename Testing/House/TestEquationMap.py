# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the map of equations in cuda/README.md leads where it says."""

import re
import unittest

import house

README = "cuda/README.md"
HEADING = "## Where the equations are"
PAPER = house.ROOT.parent / "shared" / "paper"


def numbers_of(mention):
    """The numbers of one mention: (2), (15) and (16); (21)-(24); (17) to (20)."""
    numbers = set()
    for first, last in re.findall(r"\((\d+)\)(?:\s*(?:-|–|to)\s*\((\d+)\))?", mention):
        numbers |= set(range(int(first), int(last or first) + 1))
    return numbers


def equations_in(text):
    """The numbers of the equations that a text names as Eq. (n) or Eqs. (a)-(b)."""
    number = r"\(\d+\)"
    mention = rf"Eqs?\.\s+{number}(?:(?:\s*[-–]\s*|,\s+|,?\s+and\s+|,?\s+or\s+|\s+to\s+){number})*"
    # A mention may go on behind a comment sign at the start of the next line.
    flat = re.sub(r"\s*\n\s*(?:///?|\*|#)?\s*", " ", text)
    return set().union(*map(numbers_of, re.findall(mention, flat)))


class TestEquationMap(unittest.TestCase):
    def setUp(self):
        self.rows = [(numbers_of(row[0]), house.quoted(row[2]), house.quoted(row[3]))
                     for row in house.rows(README, HEADING)]

    def in_core(self, name):
        return name if name.startswith("Testing/") else f"cuda/{name}"

    def test_every_row_names_an_equation_a_file_and_a_test(self):
        for row in self.rows:
            self.assertTrue(all(row), f"{README}: a row lacks something: {row}")

    def test_every_file_and_every_test_exists(self):
        for numbers, places, tests in self.rows:
            for name in [self.in_core(place) for place in places] + [f"Testing/{t}" for t in tests]:
                self.assertTrue((house.ROOT / name).is_file(), f"Eqs. {numbers}: no file {name}")

    def test_every_equation_is_named_where_the_map_says(self):
        for numbers, places, _ in self.rows:
            named = {place: equations_in(house.text(self.in_core(place))) for place in places}
            missing = numbers - set().union(*named.values())
            self.assertFalse(missing, f"none of {places} names Eq. {sorted(missing)}")
            for place, there in named.items():
                self.assertTrue(there & numbers, f"{place} names none of {sorted(numbers)}")

    def test_the_map_and_the_paper_have_the_same_equations(self):
        papers = sorted(PAPER.glob("*.txt"))
        if not papers:
            self.skipTest(f"the paper is not in {PAPER}")
        text = papers[0].read_text(encoding="utf-8")
        # A number stands at the end of a formula, or on the line below it.
        paper = {int(number) for numbers in re.findall(
            r"(?:\\tag\{|\()(\d+)[)}]\s*\$\$|\$\$\n\((\d+)\)\n", text) for number in numbers if number}
        self.assertEqual(paper, set(range(1, 33)), "the paper's numbers were not read as they are")

        below = house.text(README).split(HEADING, 1)[1]
        said = set().union(*(numbers for numbers, _, _ in self.rows)) | equations_in(below)
        self.assertEqual(paper - said, set(), f"{README} says nothing of these equations")
        self.assertEqual(said - paper, set(), f"{README} names equations that the paper lacks")

    def test_no_source_names_an_equation_that_the_paper_lacks(self):
        for path in house.files("*.h", "*.cxx", "*.py", "*.xml", "*.md"):
            beyond = equations_in(house.text(path)) - set(range(1, 33))
            self.assertFalse(beyond, f"{path} names Eq. {sorted(beyond)}")

    def test_equations_are_named_in_one_way(self):
        for path in house.files("*.h", "*.cxx", "*.py", "*.md"):
            if "Benchmarks" not in path.parts:  # pages of measurements say what they said then
                bare = re.findall(r"\bEqs?\.\s+\d+", house.text(path))
                self.assertFalse(bare, f"{path}: write Eq. (n), as the paper does")


if __name__ == "__main__":
    unittest.main()

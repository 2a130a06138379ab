# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

import math
import os
import re
import unittest

from fronts import equal_errors, front_of, place_of_first
from make import PAGES, read, text_of
from markdown import RESULTS_CHANGED, head
from peers import until
from scaling import fit_exponents

DOCUMENTATION = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..",
                             "Documentation", "Benchmarks")
ROUNDOFF = 2.0**-53


class Pages(unittest.TestCase):
    def test_are_what_their_numbers_make(self):
        for page in PAGES:
            measured = read(DOCUMENTATION, page)
            if measured is not None:
                path = os.path.join(DOCUMENTATION, page.capitalize() + ".md")
                with open(path, encoding="utf-8") as file, self.subTest(page):
                    self.assertEqual(file.read(), text_of(page, measured))

    def test_say_when_they_are_older_than_the_code(self):
        def is_old(date):
            machine = {"command": "", "processor": "", "cores": 2, "date": date, "load_before": 0}
            return f"Not measured since {date}" in head("Kernels", {"machine": machine})

        self.assertTrue(is_old("2026-11-22"))
        self.assertFalse(is_old(RESULTS_CHANGED))

    def test_say_when_the_machine_was_not_idle(self):
        def is_preliminary(load, cores):
            machine = {"command": "", "processor": "", "cores": cores, "date": RESULTS_CHANGED,
                       "load_before": load}
            return "preliminary" in head("Kernels", {"machine": machine})

        self.assertTrue(is_preliminary(load=0.6, cores=2))
        self.assertFalse(is_preliminary(load=0.4, cores=2))
        self.assertFalse(is_preliminary(load=3, cores=16))

    def test_written_by_programs_say_so_too(self):
        for name in sorted(os.listdir(DOCUMENTATION)):
            if not name.endswith(".md") or name == "README.md":
                continue
            with open(os.path.join(DOCUMENTATION, name), encoding="utf-8") as file:
                text = file.read()
            date = re.search(r"^\* date: (\S+)$", text, re.MULTILINE)
            with self.subTest(name):
                self.assertIsNotNone(date, "the page has no date")
                self.assertEqual(f"Not measured since {date[1]}" in text,
                                 date[1] < RESULTS_CHANGED)


class Exponents(unittest.TestCase):
    def test_are_those_of_a_power(self):
        sizes = [{"scene": "power", "side": side, "seconds": {
            "policy iteration": 1.0 if side < 64 else 3e-9 * side ** (3 * 1.25)}}
                 for side in (32, 64, 128, 512)]

        fit = fit_exponents(sizes, "power")

        self.assertEqual((fit["smallest"], fit["largest"]), (64, 512))
        # The logarithms of a power lie on a straight line, which least squares finds but for
        # rounding: of the exponent, and of the logarithms, whose range of 6.2 it is divided by.
        bound = ROUNDOFF * (4 * 1.25 + 12 * 20 / 6.2)
        self.assertLessEqual(abs(fit["exponents"]["policy iteration"] - 1.25), bound)
        self.assertEqual(fit["exponents"]["Adam iteration"], 0)


class Fronts(unittest.TestCase):
    def test_hold_what_nothing_is_faster_and_better_than(self):
        settings = [("slow", 8, 1), ("fast", 1, 8), ("middle", 4, 4), ("beaten", 5, 4),
                    ("worst", 9, 9)]

        self.assertEqual(front_of(settings), ["fast", "middle", "slow"])

    def test_have_the_first_setting_if_nothing_is_better_in_both(self):
        place = place_of_first([("first", 4, 4), ("fast", 1, 5), ("good", 5, 1)])

        self.assertEqual(place["factor"], 1)
        self.assertEqual(place["rival"], "")

    def test_are_as_far_away_as_the_rival_is_better_in_both(self):
        place = place_of_first([("first", 4, 4), ("a little", 3.5, 1), ("more", 2, 1)])

        self.assertEqual(place["factor"], 2)  # twice as fast, and four times as good
        self.assertEqual(place["rival"], "more")


def grids_and_sweeps():
    """Grids of two resolutions with an error of S that is the time's inverse, and sweeps of two."""
    return {
        "paper_grids": [{"samples_per_voxel": seconds, "seconds": seconds,
                         "error_S_base": 1 / seconds, "error_S_optimized": 0}
                        for seconds in (4.0, 16.0)],
        "sweeps": [{"ray_density": density, "error_S_base": error, "error_S_optimized": 0}
                   for density, error in ((1.0, 0.15), (2.0, 0.01))],
        "iterations": [{"solver": "Adam", "ray_density": density, "skip": True, "threads": 2,
                        "seconds": 0.1 * density} for density in (1.0, 2.0)]}


class EqualErrors(unittest.TestCase):
    def test_take_the_cheapest_iteration_that_is_at_least_as_exact(self):
        equal = equal_errors(grids_and_sweeps())

        self.assertEqual(equal[0]["error"], 0.25)
        self.assertEqual(equal[0]["Adam"][1], 1)
        self.assertEqual(equal[1]["error"], 1.0 / 16)
        self.assertEqual(equal[1]["Adam"][1], 2)
        self.assertIsNone(equal[1]["policy"])  # not measured

    def test_are_straight_in_the_logarithms_between_two_grids(self):
        equal = equal_errors(grids_and_sweeps())

        self.assertEqual(len(equal), 4)  # two grids, and 20 % and 10 % between them
        self.assertEqual(equal[2]["error"], 0.2)
        for found, seconds in zip(equal[2:], (5, 10)):
            # Two quotients, two logarithms and a power.
            self.assertTrue(math.isclose(found["grid_seconds"], seconds, rel_tol=10 * ROUNDOFF))


class TimesToAnError(unittest.TestCase):
    def test_grow_with_the_square_of_what_the_error_falls_by(self):
        row = {"value_cpu": 3.0, "S_error": 0.5}

        self.assertEqual(until(row, {"S_error": 0.125}, "value_cpu", "S_error"), 48)


if __name__ == "__main__":
    unittest.main()

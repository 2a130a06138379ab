# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The states of Documentation/Examples/states show what they are meant to show.

import os

from paraview import simple

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=vars(simple))
STATES = os.path.join(os.path.dirname(__file__), "..", "..", "Documentation", "Examples", "states")


def load(name):
    """As File > Load State does."""
    displays.clear()
    path = os.path.join(STATES, name)
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {})


def volumes():
    return [display for view in simple.GetRenderViews() for display in view.Representations
            if display.GetProperty("VisibleFraction")]


class TestExampleStates(displays.DisplayTest):
    def test_all_are_tested(self):
        self.assertEqual(sorted(os.listdir(STATES)), ["head.py", "viewpoints.py"])

    def test_head_shows_more_than_without_limpid(self):
        load("head.py")
        optimized, ordinary = volumes()
        self.assertEqual(optimized.Messages + ordinary.Messages, "")
        self.assertGreater(optimized.VisibleFraction, 2 * ordinary.VisibleFraction)
        self.assertEqual(ordinary.VisibleFraction, optimized.BaseVisibleFraction)

    def test_viewpoints_have_a_sphere_round_what_is_shown(self):
        load("viewpoints.py")
        [flame] = volumes()
        self.assertEqual(flame.Messages, "")
        self.assertGreater(flame.VisibleFraction, flame.BaseVisibleFraction)
        search = simple.FindSource("Viewpoints")
        self.assertEqual(search.PointData["NormalizedScore"].GetRange(), (0, 1))


if __name__ == "__main__":
    runner.run()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What a display says about structures: the property StructureShares, and the text in the view.

import os

import numpy as np
from paraview import simple

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())


class TestOptimizedVolumeStructures(displays.DisplayTest):
    STRUCTURES = ["1", "rim", "0.25", "", "2", "shell", "0.5", "", "3", "core", "1", "",
                  "4", "seed", "0", ""]

    def setUp(self):
        super().setUp()
        self.source = simple.Calculator(
            Input=OcclusionPhantom(Resolution=24), ResultArrayName="Labels",
            Function="ceil(3*Importance)")
        self.display = displays.show(self.source, self.view)
        self.display.StructureArray = ["POINTS", "Labels"]
        self.display.Structures = self.STRUCTURES

    def targets(self, *targets):
        rows = list(self.STRUCTURES)
        rows[3::4] = targets
        self.display.Structures = rows

    def lines(self):
        """Those of the text about structures, after a picture."""
        simple.Render(self.view)
        props = self.view.GetRenderer().GetViewProps()
        text = next(str(prop) for prop in props if prop.IsA("vtkScoreAnnotation"))
        return text.split("Text: ")[1].split("\n  Legend")[0].splitlines()[2:]

    def shares(self):
        self.display.UpdatePropertyInformation()
        return np.reshape(list(self.display.StructureShares), (-1, 4))

    def test_are_measured_when_asked_for(self):
        simple.Render(self.view)
        self.assertEqual(len(self.shares()), 0)
        self.display.MeasureStructures()
        found = self.shares()

        self.assertEqual(found.shape, (4, 4))
        visible, before, removed, attainable = found.T
        self.assertTrue((visible <= attainable + 1e-5).all())
        self.assertTrue((visible + removed <= 1 + 1e-5).all())
        self.assertGreater(visible[2], before[2])
        fraction = self.display.VisibleFraction
        self.assertTrue(visible[:3].min() <= fraction <= visible[:3].max())

    def test_are_those_of_the_picture(self):
        simple.Render(self.view)
        self.display.MeasureStructures()
        first = self.shares()
        displays.look(self.view, displays.POSITIONS[2])
        simple.Render(self.view)
        self.assertEqual(len(self.shares()), 0)
        self.display.MeasureStructures()
        self.assertGreater(np.abs(self.shares() - first).max(), 1e-3)

    def test_the_text_names_the_most_important(self):
        self.display.ShowScore = 1
        lines = self.lines()
        self.assertEqual([line.split()[0] for line in lines], ["core", "shell", "rim"])
        for line, row in zip(lines, self.shares()[[2, 1, 0]]):
            self.assertEqual(line[line.index(" ") + 1:],
                             f"{100 * row[0]:.1f} % of at most {100 * row[3]:.1f} %")

    def test_the_text_names_those_with_a_target(self):
        self.display.ShowScore = 1
        self.targets("", "0.955", "", "0.2")
        lines = self.lines()
        self.assertEqual([line.split()[0] for line in lines], ["shell", "seed"])
        self.assertTrue(lines[0].endswith(" % (target 95.5 %)"), lines)
        self.assertTrue(lines[1].endswith(" % (target 20 %)"), lines)

    def test_the_text_does_not_repeat_the_score(self):
        self.display.ShowScore = 1
        self.display.Structures = self.STRUCTURES[:4]
        self.assertEqual(self.lines(), [])
        self.assertEqual(len(self.shares()), 0)  # nobody has asked
        self.display.StructureArray = ["POINTS", "(None)"]
        self.assertEqual(self.lines(), [])

    def test_the_text_waits_for_the_end(self):
        self.display.ShowScore = 1
        self.assertEqual(len(self.lines()), 3)
        self.view.CameraPosition = displays.POSITIONS[1]
        self.view.SMProxy.InteractiveRender()
        self.assertEqual(len(self.shares()), 0)
        self.assertEqual(len(self.lines()), 3)


if __name__ == "__main__":
    runner.run()

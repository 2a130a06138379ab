# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What a display says about structures: the property StructureShares, the text in the view, and the
# legend below it.

import os
import tempfile

import numpy as np
from paraview import simple

import displays
import pictures
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

    def annotation(self):
        props = self.view.GetRenderer().GetViewProps()
        return next(str(prop) for prop in props if prop.IsA("vtkScoreAnnotation"))

    def lines(self):
        """Those of the text about structures, after a picture."""
        simple.Render(self.view)
        return self.annotation().split("Text: ")[1].split("\n  Legend")[0].splitlines()[2:]

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
        self.assertRegex(lines[0], r" \d+\.\d % of at most \d+\.\d % \(target 95\.5 %\)$")
        self.assertRegex(lines[1], r" \d+\.\d % (of at most \d+\.\d % \(target|\(>=) 20\.0 %\)$")

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

    def listed(self):
        """Those of the legend, after a picture."""
        simple.Render(self.view)
        return self.annotation().split("Structures: ")[1].strip().splitlines()

    def rows_that_differ(self, one, other):
        return np.flatnonzero(np.abs(one - other).max(axis=(1, 2)))

    def test_a_legend_lists_the_important_ones_in_their_colors(self):
        self.display.StructureColors = 0.5
        self.display.LabelColors = [2, 1, 0.4, 0]
        self.assertEqual(self.listed(), ["core", "shell", "rim"])
        with_legend = pictures.take(self.view)
        pictures.write(os.path.join(os.environ.get("LIMPID_TEST_OUTPUT", tempfile.gettempdir()),
                                    "structure-legend.png"), with_legend)
        corner = with_legend[150:, :15]  # rows from the bottom; the volume is lower
        ends = []
        for color in ((30, 75, 255), (255, 102, 0), (225, 45, 45)):
            here = (corner == color).all(axis=2)
            self.assertGreater(here.sum(), 20)
            ends += [np.flatnonzero(here.any(axis=1)).max(), np.flatnonzero(here.any(axis=1)).min()]
        self.assertEqual(ends, sorted(ends, reverse=True))  # below each other
        self.display.StructureLegend = 0
        without = pictures.take(self.view)
        self.assertEqual(self.listed(), [])
        self.display.ShowScore = self.display.ScoreInScreenshots = 1
        with_score = pictures.take(self.view)
        self.display.StructureLegend = 1
        with_both = pictures.take(self.view)
        score = self.rows_that_differ(with_score, without)
        legend = self.rows_that_differ(with_both, with_score)
        self.assertLess(legend.max(), score.min())

    def test_there_is_no_legend_without_colors_or_names(self):
        self.display.StructureColors = 0.5
        self.display.Structures = ["1", "", "1", "", "2", "", "0.5", ""]
        self.assertEqual(self.listed(), [])
        self.display.Structures = self.STRUCTURES
        self.display.StructureColors = 0
        self.assertEqual(self.listed(), [])
        without = pictures.take(self.view)
        self.display.StructureLegend = 0
        np.testing.assert_array_equal(pictures.take(self.view), without)

    def test_a_legend_has_as_many_lines_as_have_room(self):
        labels = range(1, 31)
        self.display.Structures = [text for label in labels
                                   for text in (str(label), f"structure {label}", "1", "")]
        self.display.StructureColors = 0.5
        self.display.LabelColors = [number for label in labels
                                    for number in (label, 1, 0, 8 * label / 255)]
        self.assertEqual(self.listed(), [f"structure {label}" for label in labels])
        colors = {(255, 0, 8 * label) for label in labels}
        for height, fewest, most in ((300, 11, 11), (60, 1, 4)):  # and a line for the others
            self.view.ViewSize = [200, height]
            left = pictures.take(self.view)[:, :15]
            swatches = {tuple(pixel) for pixel in left.reshape(-1, 3)} & colors
            self.assertIn(len(swatches), range(fewest, most + 1))


if __name__ == "__main__":
    runner.run()

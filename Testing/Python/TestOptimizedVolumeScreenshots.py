# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Saved pictures of the representation type "Optimized Volume" that are larger than the view:
# ParaView draws them in tiles, and transparent ones over a white and over a black background.

import os

import numpy as np
from paraview import simple

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)

TILED = [400, 400]  # of a view of 200 x 200 pixels
SLOW = {"Method": "Ordinary", "SampleDistance": 0.05}  # takes longer than the time between events


class TestOptimizedVolumeScreenshots(displays.DisplayTest):
    def renderer(self):
        return self.view.GetClientSideObject().GetRenderer()

    def representation(self, display):
        return display.GetClientSideObject().GetActiveRepresentation()

    def transparent(self):
        """A tiled picture; its four channels."""
        return pictures.take(self.view, TILED, TransparentBackground=1)

    def test_paraview_is_told_the_progress(self):
        displays.show_head(self.view, **SLOW)
        handler = simple.servermanager.ActiveConnection.Session.GetProgressHandler()
        told = []
        tag = handler.AddObserver("ProgressEvent", lambda *_: told.append(
            (handler.GetLastProgressText(), handler.GetLastProgress())))
        pictures.take(self.view, TILED)
        handler.RemoveObserver(tag)

        drawing = [share for text, share in told if text == "Drawing Optimized Volume"]
        self.assertTrue(any(0 < share <= 100 for share in drawing), told)

    def test_the_second_background_casts_no_rays(self):
        display = displays.show_head(self.view)
        backgrounds = set()
        representation = self.representation(display)
        tag = representation.AddObserver(
            "ProgressEvent", lambda *_: backgrounds.add(self.renderer().GetBackground()))
        picture = self.transparent()
        representation.RemoveObserver(tag)

        self.assertEqual(len(backgrounds), 1, backgrounds)
        alpha = picture[:, :, 3]
        self.assertEqual(alpha.min(), 0)
        self.assertGreater(alpha.max(), 100)
        display.SampleDistance = 0.9  # draws something else in between
        self.transparent()
        display.SampleDistance = 1
        np.testing.assert_array_equal(self.transparent(), picture)

    def test_an_abort_is_said_and_the_next_picture_is_whole(self):
        display = displays.show_head(self.view, **SLOW)
        expected = pictures.take(self.view, TILED)
        displays.look(self.view, displays.POSITIONS[1])
        representation = self.representation(display)
        warnings = []

        def abort(*_):
            representation.RemoveObserver(tag)
            representation.SetAbortExecute(1)  # as ParaView's button does
        tag = representation.AddObserver("ProgressEvent", abort)
        warned = representation.AddObserver(
            "WarningEvent", lambda *_: warnings.append("aborted"))
        pictures.take(self.view, TILED)
        self.assertEqual(warnings, ["aborted"])
        displays.look(self.view, displays.POSITIONS[0])

        np.testing.assert_array_equal(pictures.take(self.view, TILED), expected)
        self.assertEqual(warnings, ["aborted"])
        representation.RemoveObserver(warned)


if __name__ == "__main__":
    runner.run()

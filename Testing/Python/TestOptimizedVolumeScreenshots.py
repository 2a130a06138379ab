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


class TestOptimizedVolumeScreenshots(displays.DisplayTest):
    def renderer(self):
        return self.view.GetClientSideObject().GetRenderer()

    def transparent(self):
        """A tiled picture; its four channels."""
        return pictures.take(self.view, TILED, TransparentBackground=1)

    def test_the_second_background_casts_no_rays(self):
        display = displays.show_head(self.view)
        backgrounds = set()
        window = self.view.GetRenderWindow()
        tag = window.AddObserver(  # asked while rays are cast
            "AbortCheckEvent", lambda *_: backgrounds.add(self.renderer().GetBackground()))
        picture = self.transparent()
        window.RemoveObserver(tag)

        self.assertEqual(len(backgrounds), 1, backgrounds)
        alpha = picture[:, :, 3]
        self.assertEqual(alpha.min(), 0)
        self.assertGreater(alpha.max(), 100)
        display.SampleDistance = 0.9  # draws something else in between
        self.transparent()
        display.SampleDistance = 1
        np.testing.assert_array_equal(self.transparent(), picture)


if __name__ == "__main__":
    runner.run()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# An unstructured grid as an optimised volume: chosen as for an image, with the same panel, and seen
# from its best view. TestMeshes.xml has the events between the stages.

import numpy as np
import story
from paraview import simple
from story import expect


def tell():
    story.load_plugins()
    view = simple.GetActiveViewOrCreate("RenderView")
    meshes = simple.Tetrahedralize(Input=simple.OcclusionPhantom(Resolution=32))
    display = simple.Show(meshes, view)
    simple.SetActiveSource(meshes)
    display.SetRepresentationType("Optimized Volume")
    simple.ColorBy(display, ("POINTS", "Scalars"))
    simple.ResetCamera(view)
    frames = story.Frames(view)
    simple.Render(view)
    frames.expect_end(display, "at first")
    expect(display.SampledAt == "sampled at 32 x 32 x 32 points", f"it is {display.SampledAt}")
    before = list(view.CameraPosition), display.VisibilityScore
    story.screenshot("meshes.png")
    yield
    frames.expect_end(display, "from the best view")
    expect(not np.allclose(view.CameraPosition, before[0]) and display.VisibilityScore > before[1],
           f"more is visible from the best view: {display.VisibilityScore}, {before[1]} at first")
    story.screenshot("best.png")


story.begin(tell())

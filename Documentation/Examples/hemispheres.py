# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The scores of a viewpoint search as a picture, as in Fig. 9 of the paper."""

import os

import numpy as np
from paraview import servermanager, simple

PRESET = "Limpid Viewpoint Score"
PRESETS = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                       "..", "..", "Plugin", "Presets", "LimpidViewpointScore.json")


# What has the first and the last color, the others at equal factors between; the same for all data, so
# that pictures can be compared.
VISIBLE = 0.1, 0.6


def score_colors():
    """The color map of VisibleFraction: blue is much, red is little."""
    if not servermanager.vtkSMTransferFunctionPresets.GetInstance().HasPreset(PRESET):
        simple.ImportPresets(PRESETS)
    colors = simple.GetColorTransferFunction("VisibleFraction")
    colors.ApplyPreset(PRESET, True)
    colors.RescaleTransferFunction(*VISIBLE)
    colors.MapControlPointsToLogSpace()
    return colors


class Hemispheres:
    """Both halves of an S-sphere as maps that keep areas: left seen from +y, right from -y, with z
    upwards in both; lines of equal shares, two per cent apart."""

    CENTRE = 1.5  # of the right map, whose radius is the square root of 2

    def __init__(self, search):
        self.search = search
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [1200, 660]
        self.view.OrientationAxesVisibility = 0
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]

    def mapped(self, source, side, height):
        """A source with ViewDirection as a map; side is 1 for the half round +y, -1 for -y."""
        spread = "sqrt(2/(1+{}*ViewDirection_Y))".format(side)
        return simple.Calculator(
            Input=source, AttributeType="Point Data", CoordinateResults=1,
            Function="(-{0}*ViewDirection_X*{1}-{0}*{2})*iHat+ViewDirection_Z*{1}*jHat"
                     "+{3}*kHat".format(side, spread, self.CENTRE, height))

    def half(self, side):
        centre = list(servermanager.Fetch(self.search).GetFieldData()
                      .GetArray("CameraFocalPoint").GetTuple3(0))
        half = simple.Clip(Input=self.search, ClipType="Plane", Invert=0)
        half.ClipType.Origin = centre
        half.ClipType.Normal = [0, side, 0]
        return half

    def draw(self, source, color=None):
        display = simple.Show(source, self.view)
        display.Ambient = 1.0
        display.Diffuse = 0.0
        if color is None:
            simple.ColorBy(display, ("POINTS", "VisibleFraction"))
            display.LookupTable = score_colors()
            display.SetScalarBarVisibility(self.view, False)
        else:
            display.ColorArrayName = ["POINTS", ""]
            display.AmbientColor = color
            display.DiffuseColor = color

    def mark(self, viewpoint, color, size):
        back = np.subtract(viewpoint["CameraPosition"], viewpoint["CameraFocalPoint"])
        x, y, z = back / np.linalg.norm(back)
        side = 1 if y >= 0 else -1
        spread = np.sqrt(2 / (1 + side * y))
        place = [-side * (x * spread + self.CENTRE), z * spread]
        for height, radius, fill in ((0.2, 1.3 * size, [1 - part for part in color]),
                                     (0.4, size, color)):
            self.draw(simple.Sphere(Center=place + [height], Radius=radius, ThetaResolution=32,
                                    PhiResolution=32), fill)

    def write(self, ranked, worst, path):
        for side in (1, -1):
            half = self.half(side)
            self.draw(self.mapped(half, side, 0))
            lines = simple.Contour(Input=half, ContourBy=["POINTS", "VisibleFraction"],
                                   Isosurfaces=[step / 50 for step in range(1, 50)])
            self.draw(self.mapped(lines, side, 0.01), [0.3, 0.3, 0.3])
        for rank, viewpoint in reversed(list(enumerate(ranked))):
            self.mark(viewpoint, [1.0, 1.0, 1.0], 0.025 if rank else 0.045)
        self.mark(worst, [0.0, 0.0, 0.0], 0.045)
        for text, place in (("from +y", [0.01, 0.02]), ("from -y", [0.88, 0.02])):
            display = simple.Show(simple.Text(Text=text), self.view)
            display.WindowLocation = "Any Location"
            display.Position = place
            display.Color = [0, 0, 0]
            display.FontSize = 28
        self.view.CameraPosition = [0, 0, 10]
        self.view.CameraFocalPoint = [0, 0, 0]
        self.view.CameraViewUp = [0, 1, 0]
        self.view.CameraParallelProjection = 1
        self.view.CameraParallelScale = 1.65
        simple.SaveScreenshot(path, self.view, ImageResolution=self.view.ViewSize)

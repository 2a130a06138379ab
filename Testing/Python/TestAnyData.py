# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# "Optimized Volume" of data that are no image: sampled as fine as their cells, empty outside.

import os

import numpy as np
from paraview import simple

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=vars(simple))

RESOLUTION = 32
RECTILINEAR = """
import vtk
image = inputs[0].VTKObject
output.VTKObject.SetDimensions(image.GetDimensions())
for axis, name in enumerate("XYZ"):
    along = vtk.vtkDoubleArray()
    for i in range(image.GetDimensions()[axis]):
        along.InsertNextValue(image.GetOrigin()[axis] + i * image.GetSpacing()[axis])
    getattr(output.VTKObject, "Set" + name + "Coordinates")(along)
output.VTKObject.GetPointData().ShallowCopy(image.GetPointData())
"""
STRETCHED = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
x, y = np.linspace(-1, 1, 24), np.linspace(-0.8, 0.8, 20)
z = np.expm1(np.linspace(0, np.log(100), 30)) / 99  # thicknesses from 0.0017 to 0.15
output.VTKObject.SetDimensions(24, 20, 30)
for axis, values in zip("XYZ", (x, y, z)):
    getattr(output.VTKObject, "Set" + axis + "Coordinates")(numpy_to_vtk(values, deep=1))
k, j, i = np.meshgrid(z, y, x, indexing="ij")
thin = np.exp(-k / 0.02) * (0.75 + 0.25 * np.sin(5 * i) * np.cos(4 * j))
ball = np.exp(-(i**2 + j**2) / 0.1 - (k - 0.15)**2 / 0.004)
output.PointData.append(np.maximum(0.6 * thin, ball).ravel(), "Scalars")
output.PointData.append(ball.ravel(), "Importance")
"""
EXTENT = "from paraview.util import SetOutputWholeExtent\nSetOutputWholeExtent(self, [0, {0}, 0, {0}, 0, {0}])"


def rectilinear(image):
    return simple.ProgrammableFilter(
        Input=image, OutputDataSetType="vtkRectilinearGrid", Script=RECTILINEAR,
        RequestInformationScript=EXTENT.format(RESOLUTION - 1))


def two_blocks(image):
    return simple.GroupDatasets(Input=[
        simple.ExtractSubset(Input=image, VOI=[*along, 0, 31, 0, 31]) for along in ((0, 16), (16, 31))])


class TestAnyData(displays.SampledDisplayTest):
    def test_of_the_same_field_is_like_the_image(self):
        image = simple.OcclusionPhantom(Resolution=RESOLUTION)
        self.assert_alike({
            "rectilinear grid": rectilinear(image),
            "structured grid": simple.Transform(Input=image),
            "hexahedra": simple.AppendDatasets(Input=[image]),
            "tetrahedra": simple.Tetrahedralize(Input=image),
            "images in blocks": two_blocks(image),
            "meshes in blocks": simple.GroupDatasets(
                Input=[simple.AppendDatasets(Input=[image]), simple.Tetrahedralize(Input=image)])}, image)

    def test_thin_layers_of_a_stretched_grid_are_not_lost(self):
        stretched = simple.ProgrammableSource(
            OutputDataSetType="vtkRectilinearGrid", Script=STRETCHED,
            ScriptRequestInformation=EXTENT.replace("{0}", "{}").format(23, 19, 29))
        fine = simple.ResampleToImage(
            Input=stretched, UseInputBounds=0, SamplingBounds=[-1, 1, -0.8, 0.8, 0, 1],
            SamplingDimensions=[24, 20, 1201])
        expected, _ = self.shown(fine)
        display, _ = self.shown(stretched)
        self.assertEqual(display.Messages, "")
        self.assertIn(" x ", display.SampledAt)
        # As fine as a twentieth of the layers, whose thinnest are a third of those of the image.
        self.assertAlmostEqual(display.VisibilityScore / expected.VisibilityScore, 1, delta=0.003)
        self.assertAlmostEqual(display.VisibleFraction / expected.VisibleFraction, 1, delta=0.003)

    def test_arrays_of_cells(self):
        image = simple.OcclusionPhantom(Resolution=RESOLUTION)
        cells = simple.PointDatatoCellData(Input=image)
        self.assert_alike({"hexahedra": simple.AppendDatasets(Input=[cells])}, cells, ("CELLS", "Scalars"))

    def test_labels_are_not_interpolated(self):
        image = simple.OcclusionPhantom(Resolution=RESOLUTION)
        labels = simple.Calculator(Input=image, ResultArrayName="Labels", Function="4*round(Importance)")
        settings = {"StructureArray": ["POINTS", "Labels"], "Structures": ["4", "core", "1", ""]}
        expected, _ = self.shown(labels, **settings)
        display, _ = self.shown(simple.AppendDatasets(Input=[labels]), **settings)
        self.assertEqual(display.Messages, "")
        np.testing.assert_allclose(display.VisibleFraction, expected.VisibleFraction, rtol=0.01)

    def test_outside_of_all_cells_there_is_nothing(self):
        image = simple.OcclusionPhantom(Resolution=RESOLUTION)
        meshes = simple.AppendDatasets(Input=[image])
        ball = simple.Clip(Input=meshes, ClipType="Sphere")
        ball.ClipType.Center = [0, 0, 0]
        ball.ClipType.Radius = 0.5
        everywhere = simple.GetOpacityTransferFunction("Scalars")
        display = displays.show(ball, self.view)
        everywhere.Points = [0, 0.3, 0.5, 0, 1, 0.3, 0.5, 0]
        display.Optimization = "Off"
        self.view.CameraPosition = [0, 0, -6]
        self.view.CameraViewUp = [0, 1, 0]
        self.view.CameraViewAngle = 30
        picture = pictures.take(self.view)
        seen = abs(picture - picture[2, 2]).max(axis=2) > 8
        across = np.ptp(np.flatnonzero(seen.any(axis=0))) + 1
        # The ball is as wide as 0.5 of 6 in a view of 30 degrees and 200 pixels, and a cell more.
        expected = 200 * 0.5 / np.sqrt(6 ** 2 - 0.5 ** 2) / np.tan(np.radians(15))
        cell = 200 * (2 / (RESOLUTION - 1)) / 6 / (2 * np.tan(np.radians(15)))
        self.assertAlmostEqual(across, expected, delta=2 * cell)

    def test_arrays_that_are_chosen_later_are_sampled_then(self):
        image = simple.OcclusionPhantom(Resolution=RESOLUTION)
        more = simple.Calculator(Input=image, ResultArrayName="Density", Function="1-Scalars")
        more = simple.Calculator(Input=more, ResultArrayName="Mass", Function="Scalars*Importance+0.1*coordsX")
        meshes = simple.AppendDatasets(Input=[more])

        def look(source, array, importance):
            display, picture = self.shown(source, ("POINTS", array), ImportanceArray=["POINTS", importance])
            self.assertEqual(display.Messages, "")
            simple.Show(source, self.view)
            return picture

        for array, importance in (("Scalars", "Importance"), ("Mass", "Importance"), ("Mass", "Density"),
                                  ("Scalars", "Importance")):
            with self.subTest(array=array, importance=importance):
                picture = look(meshes, array, importance)
                simple.Hide(meshes, self.view)
                copy = simple.AppendDatasets(Input=[more])
                np.testing.assert_array_equal(picture, look(copy, array, importance))
                simple.Delete(copy)

    def test_trees_and_levels(self):
        for source in (simple.HyperTreeGridRandom(), simple.AMRGaussianPulseSource(Dimension=3)):
            source.UpdatePipeline()
            array = [name for name in source.CellData.keys() if not name.startswith("vtk")][-1]
            display = simple.Show(source, self.view)
            display.SetRepresentationType("Optimized Volume")
            simple.ColorBy(display, ("CELLS", array))
            simple.ResetCamera(self.view)
            picture = pictures.take(self.view)
            self.assertGreater(picture.std(axis=(0, 1)).max(), 5)
            display.UpdatePropertyInformation()
            self.assertTrue(display.SampledAt.startswith("sampled at "), display.SampledAt)
            self.assertEqual(display.Messages, "")
            simple.Delete(source)

    def test_results_in_cells_are_shown(self):
        result = simple.ExtinctionOptimizer(Input=simple.HyperTreeGridRandom(), ScalarArray=["CELLS", "Depth"])
        result.UpdatePipeline()
        display = simple.Show(result, self.view)
        pictures.take(self.view)
        display.UpdatePropertyInformation()
        self.assertEqual(list(display.ExtinctionArray), ["CELLS", "Extinction"])
        self.assertEqual(display.Messages, "")

    def test_dimensions_that_are_given(self):
        meshes = simple.AppendDatasets(Input=[simple.OcclusionPhantom(Resolution=RESOLUTION)])
        display, fine = self.shown(meshes)
        display, coarse = self.shown(meshes, ImageDimensions=[20, 0, 16])
        self.assertEqual(display.SampledAt, "sampled at 20 x 32 x 16 points; 32 x 32 x 32 would be as fine as the data")
        self.assertGreater(abs(coarse - fine).mean(), 0.1)
        display, again = self.shown(meshes, ImageDimensions=[0, 0, 0])
        self.assertLess(abs(again - fine).mean(), 0.1)

    def test_data_without_a_volume_say_so(self):
        display = displays.show(simple.AppendDatasets(Input=[simple.Sphere()]), self.view, array=("POINTS", "Normals"))
        pictures.take(self.view)
        display.UpdatePropertyInformation()
        self.assertIn("vtkUnstructuredGrid without cells that have a volume", display.Messages)

    def test_changed_data_are_sampled_again(self):
        phantom = simple.OcclusionPhantom(Resolution=RESOLUTION)
        meshes = simple.AppendDatasets(Input=[phantom])
        self.shown(meshes)
        phantom.Resolution = 24
        display, _ = self.shown(meshes)
        self.assertEqual(display.SampledAt, "sampled at 24 x 24 x 24 points")

    def test_survive_a_state(self):
        meshes = simple.AppendDatasets(Input=[simple.OcclusionPhantom(Resolution=RESOLUTION)])
        displays.show(meshes, self.view, array=("POINTS", "Scalars")).ImageDimensions = [25, 25, 25]
        before = pictures.take(self.view)
        view = displays.through_a_state()
        np.testing.assert_allclose(pictures.take(view), before, atol=2)


if __name__ == "__main__":
    runner.run()

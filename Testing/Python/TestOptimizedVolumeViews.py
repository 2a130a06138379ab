# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" with what else there is in ParaView's views: color
# maps, axes, lights, animations, picking, comparative views.

import glob
import os
import tempfile

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview.vtk.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)

ORDINARY = {"Method": "Ordinary", "Shadows": 0, "Shade": 0}
VIRIDIS = "Viridis" if runner.PARAVIEW >= (6, 0) else "Viridis (matplotlib)"


def phantom_in_two_steps(script):
    """A phantom at the times 0 and 1, of which a script makes `output` for its `time`."""
    return simple.ProgrammableFilter(Input=OcclusionPhantom(Resolution=24), Script="""
from paraview import vtk
time = self.GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
output.ShallowCopy(inputs[0].VTKObject)
""" + script, RequestInformationScript="""
from paraview import vtk
keys = vtk.vtkStreamingDemandDrivenPipeline
outInfo = self.GetOutputInformation(0)
outInfo.Set(keys.TIME_STEPS(), [0.0, 1.0], 2)
outInfo.Set(keys.TIME_RANGE(), [0.0, 1.0], 2)
""")


class TestOptimizedVolumeViews(displays.DisplayTest):
    def assert_is_stock(self, display, view=None):
        """The same picture as by ParaView's own volume rendering on the CPU; returns it."""
        view = view or self.view
        picture = pictures.take(view)
        display.SetRepresentationType("Volume")
        display.VolumeRenderingMode = "Ray Cast Only"
        view.DepthPeelingForVolumes = 0  # comes out as garbage with it where there are axes
        mean, _ = pictures.difference(picture, pictures.take(view))
        view.DepthPeelingForVolumes = 1
        display.SetRepresentationType("Optimized Volume")
        self.assertLessEqual(mean, displays.SAME_RENDERING)
        self.assertGreater(picture.std(), 10)
        return picture

    # Color maps

    def test_colors_are_those_of_the_color_map_editor(self):
        display = displays.show_head(self.view, **ORDINARY)
        colors = display.LookupTable
        opacity = display.ScalarOpacityFunction
        seen = [self.assert_is_stock(display)]
        changes = {
            "preset": lambda: colors.ApplyPreset(VIRIDIS, True),
            "rescaled": lambda: colors.RescaleTransferFunction(0.2, 0.6),
            "other opacities": lambda: setattr(opacity, "Points", [0, 0, 0.5, 0, 1, 0.4, 0.5, 0]),
            "logarithmic": lambda: colors.MapControlPointsToLogSpace() or setattr(
                colors, "UseLogScale", 1),
        }
        for name, change in changes.items():
            with self.subTest(name):
                change()
                seen.append(self.assert_is_stock(display))
                self.assertGreater(pictures.difference(*seen[-2:])[0], 0.5)

    def test_a_scalar_bar_is_shown(self):
        display = displays.show_head(self.view, **ORDINARY)
        without = pictures.take(self.view)
        display.SetScalarBarVisibility(self.view, True)

        self.assertGreater(pictures.difference(self.assert_is_stock(display), without)[0], 0.5)

    # Annotations and layouts

    def test_axes_are_seen_through_and_around_the_volume(self):
        display = displays.show_head(self.view, **ORDINARY)
        without = pictures.take(self.view)
        self.view.AxesGrid.Visibility = 1
        self.view.OrientationAxesVisibility = 1
        self.view.CenterAxesVisibility = 1
        display.DataAxesGrid.GridAxesVisibility = 1

        self.assertGreater(pictures.difference(self.assert_is_stock(display), without)[0], 0.5)

    def test_linked_cameras_optimize_both_views(self):
        source = OcclusionPhantom(Resolution=32)
        other = displays.new_view()
        shown = [displays.show(source, view) for view in (self.view, other)]
        simple.AddCameraLink(self.view, other, "Link")
        displays.look(self.view, displays.POSITIONS[1])
        taken = [pictures.take(view) for view in (self.view, other)]
        simple.RemoveCameraLink("Link")

        np.testing.assert_array_equal(*taken)
        self.assertEqual(shown[0].VisibilityScore, shown[1].VisibilityScore)

    def test_is_in_all_parts_of_a_comparative_view(self):
        view = simple.CreateView("ComparativeRenderView")
        view.ViewSize = [400, 200]
        view.Dimensions = [2, 1]
        displays.look(view, displays.POSITIONS[0])
        display = displays.show_head(view, 24)
        picture = pictures.take(view)

        for half in (picture[:, :195], picture[:, -195:]):
            self.assertGreater(half.std(), 10)
        self.assertEqual(display.Messages, "")

    # Lights

    def test_lights_of_the_view_light_the_volume(self):
        display = displays.show_head(self.view, 32)
        with_kit = pictures.take(self.view)
        self.assertIn("camera light", display.LightDescription)
        self.view.UseLight = 0
        light = simple.AddLight(self.view)
        light.Type = "Directional"
        light.Coords = "Scene"
        light.Position = [-10, 0, 1]
        light.FocalPoint = [0, 0, 0]
        from_left = pictures.take(self.view)
        self.assertIn("scene light", display.LightDescription)
        light.Position = [10, 0, 1]
        from_right = pictures.take(self.view)
        light.DiffuseColor = [0.2, 0.2, 1]
        blue = pictures.take(self.view)
        light.Enable = 0
        simple.Render(self.view)

        self.assertGreater(pictures.difference(with_kit, from_left)[0], 1)
        self.assertGreater(pictures.difference(from_left, from_right)[0], 1)
        # Light never shifts a hue: colours are to be read off the color map.
        np.testing.assert_array_equal(blue, from_right)
        self.assertIn("No light", display.Messages)

    # Time

    def animation(self, frames):
        """The frames of an animation, saved as pictures. ParaView 5.13 does not know how many they
        are if it is not told."""
        with tempfile.TemporaryDirectory() as folder:
            simple.SaveAnimation(os.path.join(folder, "frame.png"), self.view,
                                 ImageResolution=self.view.ViewSize, FrameWindow=[0, frames - 1])
            return [pictures.read(path)
                    for path in sorted(glob.glob(os.path.join(folder, "*.png")))]

    def test_saved_animations_have_final_pictures(self):
        source = OcclusionPhantom(Resolution=32)
        displays.show(source, self.view)
        scene = simple.GetAnimationScene()
        scene.PlayMode = "Sequence"
        scene.NumberOfFrames = 3
        scene.StartTime, scene.EndTime = 0, 2
        track = simple.GetAnimationTrack("Resolution", proxy=source)
        keys = [simple.CompositeKeyFrame(KeyTime=time, KeyValues=[value])
                for time, value in ((0, 24), (1, 40))]
        track.KeyFrames = keys
        frames = self.animation(3)
        simple.Delete(track)

        self.assertEqual(len(frames), 3)
        for resolution, frame in zip((24, 32, 40), frames):
            source.Resolution = resolution
            np.testing.assert_array_equal(frame, pictures.take(self.view))

    def test_follows_time(self):
        changing = phantom_in_two_steps("""
importance = inputs[0].PointData['Importance']
output.PointData.append(importance if time < 1 else importance * 0, 'Importance')
""")
        display = displays.show(changing, self.view)
        fractions = []
        for time in (0, 1, 0):
            self.view.ViewTime = time
            simple.Render(self.view)
            fractions.append(display.VisibleFraction)

        self.assertGreater(fractions[0], 0)
        self.assertEqual(fractions[1], 0)
        self.assertEqual(fractions[2], fractions[0])

    def test_follows_values_that_programs_change_in_place(self):
        image = vtkImageData()
        image.DeepCopy(simple.servermanager.Fetch(OcclusionPhantom(Resolution=24)))
        image.AllocatePointGhostArray()
        image.AllocateCellGhostArray()
        producer = simple.TrivialProducer()
        producer.GetClientSideObject().SetOutput(image)

        def shown(view):
            display = displays.show(producer, view)
            display.ImportanceArray = ["POINTS", "Importance"]
            return display

        def results(view, display):
            return pictures.take(view), display.VisibleFraction, display.BaseVisibleFraction
        display = shown(self.view)
        points = image.GetPointData()
        for array, part, value in (
                (points.GetArray("Scalars"), slice(6000, None), 0.4),
                (points.GetArray("Importance"), slice(3000), 1),
                (image.GetPointGhostArray(), slice(8000, None), vtkDataSetAttributes.HIDDENPOINT),
                (image.GetCellGhostArray(), slice(3000), vtkDataSetAttributes.HIDDENCELL)):
            with self.subTest(array=array.GetName(), count=array.GetNumberOfTuples()):
                before = results(self.view, display)
                vtk_to_numpy(array)[part] = value
                image.Modified()
                producer.SMProxy.MarkModified(producer.SMProxy)
                after = results(self.view, display)
                other = displays.new_view()
                expected = results(other, shown(other))
                np.testing.assert_array_equal(after[0], expected[0])
                self.assertEqual(after[1:], expected[1:])
                self.assertGreater(abs(after[0] - before[0]).max(), 10)
                self.assertNotEqual(after[1:], before[1:])
                simple.Delete(other)

    def test_a_time_step_without_the_colored_array_shows_nothing_of_the_last_one(self):
        changing = phantom_in_two_steps("""
if time == 1:
    output.VTKObject.GetPointData().RemoveArray('Scalars')
""")
        display = displays.show(changing, self.view)
        results = []
        for time in (0, 1, 0):
            self.view.ViewTime = time
            simple.Render(self.view)
            results.append((display.VisibleFraction, display.VisibilityScore,
                            display.AttainableFraction))
            self.assertEqual("Scalars" in display.Messages, time == 1)

        self.assertGreater(min(results[0]), 0)
        self.assertEqual(results[1], (0, 0, 0))
        self.assertEqual(results[2], results[0])

    def test_a_time_step_without_the_importance_array_is_an_error_that_names_it(self):
        changing = phantom_in_two_steps("""
if time == 1:
    output.VTKObject.GetPointData().RemoveArray('Importance')
""")
        display = displays.show(changing, self.view)
        display.ImportanceArray = ["POINTS", "Importance"]
        results, messages = [], []
        for time in (0, 1, 0):
            self.view.ViewTime = time
            simple.Render(self.view)
            results.append((display.VisibleFraction, display.VisibilityScore))
            messages.append(display.Messages)

        self.assertEqual([messages[0], messages[2]], ["", ""])
        self.assertEqual(messages[1].count('The importance array "Importance" is not among'), 1,
                         messages[1])
        self.assertEqual(results[1], (0, 0))
        self.assertGreater(min(results[0]), 0)
        self.assertEqual(results[2], results[0])

    # Picking

    def test_is_picked_where_it_is_seen(self):
        display = displays.show_head(self.view, 32)
        simple.Render(self.view)

        self.assertEqual(self.view.SMProxy.Pick(100, 100), display.SMProxy)
        self.assertIsNone(self.view.SMProxy.Pick(5, 5))


if __name__ == "__main__":
    runner.run()

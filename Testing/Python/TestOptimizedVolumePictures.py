# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" in a view: against ParaView's own volume rendering,
# with other things in the view, in several views.

import os
import tempfile

import numpy as np
from paraview import simple

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)

ORDINARY = {"Optimization": "Off", "Shadows": 0, "Shade": 0}


def stock(display, view, resolution=None):
    """The same display, drawn by ParaView's own volume rendering on the CPU."""
    display.SetRepresentationType("Volume")
    display.VolumeRenderingMode = "Ray Cast Only"
    picture = pictures.take(view, resolution)
    display.SetRepresentationType("Optimized Volume")
    return picture


def add_surface(source, view, color, opacity=1.0):
    display = simple.Show(source, view)
    display.SetRepresentationType("Surface")
    display.ColorArrayName = [None, ""]
    display.AmbientColor = display.DiffuseColor = color
    display.Ambient = 1.0  # the same colour everywhere
    display.Diffuse = 0.0
    display.Opacity = opacity
    return display


class TestOptimizedVolumePictures(displays.DisplayTest):
    def assert_same_rendering(self, first, second):
        mean, _ = pictures.difference(first, second)
        self.assertLessEqual(mean, displays.SAME_RENDERING)

    def test_is_paraviews_own_rendering_with_everything_off(self):
        display = displays.show_head(self.view, **ORDINARY)
        for position in displays.POSITIONS:
            with self.subTest(position=position):
                displays.look(self.view, position)
                picture = pictures.take(self.view)

                self.assert_same_rendering(picture, stock(display, self.view))
                self.assertGreater(picture.std(), 10)  # there is something to be seen

    def test_is_paraviews_own_rendering_in_parallel_projection(self):
        display = displays.show_head(self.view, **ORDINARY)
        self.view.CameraParallelProjection = 1
        self.view.CameraParallelScale = 1.5

        self.assert_same_rendering(pictures.take(self.view), stock(display, self.view))

    def test_is_paraviews_own_rendering_where_the_display_is_moved(self):
        display = displays.show_head(self.view, **ORDINARY)
        displays.move(display, [0.3, 0.1, -0.2])
        display.Orientation = [20, 30, 40]
        display.Scale = [1.2, 0.7, 1.0]

        self.assert_same_rendering(pictures.take(self.view), stock(display, self.view))

    def test_is_paraviews_own_rendering_in_a_cropping_box(self):
        display = displays.show_head(self.view, **ORDINARY)
        display.UseCropping = 1
        display.CroppingOrigin = [-0.5, -0.2, -1.0]
        display.CroppingScale = [0.5, 0.6, 1.0]
        cropped = pictures.take(self.view)
        reference = stock(display, self.view)
        display.UseCropping = 0
        whole = pictures.take(self.view)

        # Cut surfaces are sharp: VTK cuts between voxels, a point of the grid is in or out here.
        mean, _ = pictures.difference(cropped, reference)
        apart, _ = pictures.difference(cropped, whole)
        self.assertLess(mean, apart / 3)

    def test_draws_an_array_of_the_cells(self):
        cells = simple.PointDatatoCellData(Input=OcclusionPhantom(Resolution=48),
                                           ProcessAllArrays=1)
        display = displays.show(cells, self.view, array=("CELLS", "Scalars"))
        for name, value in ORDINARY.items():
            setattr(display, name, value)
        of_cells = pictures.take(self.view)
        simple.Hide(cells, self.view)
        displays.show_head(self.view, **ORDINARY)
        of_points = pictures.take(self.view)

        # Averaging to cells and back blurs by about a voxel.
        mean, _ = pictures.difference(of_cells, of_points)
        self.assertLess(mean, 5)
        self.assertGreater(of_cells.std(), 10)

    def test_makes_the_same_picture_again(self):
        displays.show_head(self.view)
        first = pictures.take(self.view)
        for position in displays.POSITIONS[1:]:
            displays.look(self.view, position)
            simple.Render(self.view)
        displays.look(self.view, displays.POSITIONS[0])

        np.testing.assert_array_equal(pictures.take(self.view), first)

    def test_makes_the_same_picture_after_moving(self):
        displays.show_head(self.view)
        first = pictures.take(self.view)
        for position in displays.POSITIONS[1:] + displays.POSITIONS[:1]:
            displays.look(self.view, position)
            self.view.SMProxy.UpdateVTKObjects()
            self.view.SMProxy.InteractiveRender()

        np.testing.assert_array_equal(pictures.take(self.view), first)

    def test_differs_from_ordinary_rendering(self):
        display = displays.show_head(self.view)
        optimized = pictures.take(self.view)
        display.Method = "Ordinary"
        mean, _ = pictures.difference(optimized, pictures.take(self.view))

        self.assertGreater(mean, 5)

    def test_opaque_surfaces_hide_and_are_hidden(self):
        display = displays.show_head(self.view, **ORDINARY)
        green = np.array([0, 255, 0])

        def seen(center):
            """How green the middle of the picture is, from 0 to 1, with a ball at `center`."""
            ball = simple.Sphere(Radius=0.2, Center=center)
            add_surface(ball, self.view, [0, 1, 0])
            picture = pictures.take(self.view)
            reference = stock(display, self.view)
            simple.Delete(ball)
            self.assert_same_rendering(picture, reference)
            middle = picture[95:105, 95:105].mean(axis=(0, 1))
            return 1 - np.abs(middle - green).sum() / (3 * 255)

        toward = np.array(displays.POSITIONS[0]) / np.linalg.norm(displays.POSITIONS[0])
        front = seen(list(2.0 * toward))
        inside = seen(list(0.3 * toward))
        behind = seen(list(-2.0 * toward))

        self.assertGreater(front, 0.99)
        self.assertLess(inside, 0.9)
        self.assertLess(behind, inside + 1e-6)

    def test_translucent_surfaces_behind_the_volume_show_through(self):
        display = displays.show_head(self.view, **ORDINARY)
        wall = simple.Plane(Origin=[-3, 3, -3], Point1=[3, 3, -3], Point2=[-3, 3, 3])
        add_surface(wall, self.view, [1, 1, 0], opacity=0.5)
        picture = pictures.take(self.view)

        # With this on, which it is by default, VTK's CPU rendering comes out as garbage.
        self.view.DepthPeelingForVolumes = 0
        self.assert_same_rendering(picture, stock(display, self.view))
        self.assertEqual(display.Messages, "")

    def test_translucent_surfaces_in_front_and_inside_are_peeled(self):
        display = displays.show_head(self.view, **ORDINARY)
        for y in (-2, 0.1):
            wall = simple.Plane(Origin=[-3, y, -3], Point1=[3, y, -3], Point2=[-3, y, 3])
            add_surface(wall, self.view, [1, 1, 0], opacity=0.5)
        picture = pictures.take(self.view)
        self.assertEqual(display.Messages, "")

        display.SetRepresentationType("Volume")
        display.VolumeRenderingMode = "GPU Based"
        reference = pictures.take(self.view)
        self.assertLessEqual(pictures.difference(picture, reference)[0], displays.SAME_RENDERING)

    def test_volumes_are_peeled_where_one_of_them_needs_it(self):
        displayed = [displays.show_head(self.view, 24), displays.show_head(self.view, 24)]
        ball = simple.Sphere(Center=[-1.5, -2, 0], Radius=0.4)
        add_surface(ball, self.view, [1, 1, 0], opacity=0.5)
        displays.look(self.view, [0, -12, 0])
        for behind, before in (displayed, displayed[::-1]):  # the ball: the first or the last shown
            displays.move(behind, [-1.5, 0, 0])
            displays.move(before, [1.5, -4, 0])
            simple.Render(self.view)
            self.assertEqual(behind.Messages + before.Messages, "")

    def test_says_that_translucent_surfaces_come_out_behind_without_peeling(self):
        display = displays.show_head(self.view, **ORDINARY)
        wall = simple.Plane(Origin=[-3, -2, -3], Point1=[3, -2, -3], Point2=[-3, -2, 3])
        add_surface(wall, self.view, [1, 1, 0], opacity=0.5)
        self.view.DepthPeelingForVolumes = 0
        picture = pictures.take(self.view)

        self.assertIn("UseDepthPeelingForVolumesOn", display.Messages)
        self.assertGreater(picture.std(), 10)

    def assert_same(self, picture, expected):
        """To the bit; OpenGL may round otherwise in another order of draw calls."""
        levels = 1 if os.environ.get("LIMPID_DRAW_ON") == "OpenGL" else 0
        np.testing.assert_allclose(picture, expected, rtol=0, atol=levels)

    def test_volumes_are_drawn_from_back_to_front(self):
        first = displays.show_head(self.view, 32)
        second = displays.show_head(self.view, 32)
        for display in (first, second):
            for name, value in ORDINARY.items():
                setattr(display, name, value)
        displays.move(first, [0, -1.5, 0])
        displays.move(second, [0, 1.5, 0])
        displays.look(self.view, [2, -8, 1])
        from_first = pictures.take(self.view)
        displays.look(self.view, [2, 8, 1])
        from_second = pictures.take(self.view)

        # Exchanged, which must not matter: the order in which they were added is another one.
        displays.move(first, [0, 1.5, 0])
        displays.move(second, [0, -1.5, 0])
        self.assert_same(pictures.take(self.view), from_second)
        displays.look(self.view, [2, -8, 1])
        self.assert_same(pictures.take(self.view), from_first)
        self.assertEqual(first.Messages, "")

    def test_says_that_overlapping_volumes_have_no_right_order(self):
        first = displays.show_head(self.view, 24)
        second = displays.show_head(self.view, 24)
        simple.Render(self.view)

        self.assertIn("overlap", first.Messages + second.Messages)

    def test_two_views_do_not_disturb_each_other(self):
        source = OcclusionPhantom(Resolution=40)
        displays.show(source, self.view)
        alone = pictures.take(self.view)
        other = displays.new_view()
        displays.look(other, displays.POSITIONS[1])
        displays.show(source, other)
        second = pictures.take(other)
        both = [pictures.take(view) for view in (self.view, other)]

        np.testing.assert_array_equal(both[0], alone)
        np.testing.assert_array_equal(both[1], second)

    def test_a_layout_shows_the_same_as_its_views(self):
        source = OcclusionPhantom(Resolution=40)
        other = displays.new_view()
        displays.look(other, displays.POSITIONS[1])
        for view in (self.view, other):
            displays.show(source, view)
        alone = [pictures.take(view, [200, 200]) for view in (self.view, other)]
        layout = simple.CreateLayout("Two")
        simple.AssignViewToLayout(self.view, layout, 0)
        layout.SplitHorizontal(0, 0.5)
        simple.AssignViewToLayout(other, layout, 2)
        layout.SetSize(400, 200)
        together = pictures.take(layout, [400, 200])

        # The border between the views takes some pixels from them.
        self.assertLess(pictures.difference(together[:, :195], alone[0][:, :195])[0], 5)
        self.assertLess(pictures.difference(together[:, -195:], alone[1][:, -195:])[0], 5)

    def test_a_screenshot_larger_than_the_view_is_made_of_right_tiles(self):
        displays.show_head(self.view, **ORDINARY)
        large = pictures.take(self.view, [600, 600])
        small = pictures.take(self.view)
        shrunk = large.reshape(200, 3, 200, 3, 3).mean(axis=(1, 3))

        self.assert_same_rendering(shrunk, small)

    def test_what_is_missed_is_painted_in_the_chosen_colour_and_goes_without_a_trace(self):
        display = displays.show_head(self.view, Method="Ordinary")
        without = pictures.take(self.view)
        for color, channel in (([1, 0, 1], 1), ([0, 1, 0], 2)):
            display.ShowMissed = 1
            display.MissedColor = color
            change = pictures.take(self.view) - without
            # Towards the colour, in every pixel that changes much.
            self.assertGreater((change[..., channel] < -10).sum(), 100)
            self.assertLess(change[..., channel].max(), 2)
            self.assertEqual(display.Messages, "")
            display.ShowMissed = 0
            np.testing.assert_array_equal(pictures.take(self.view), without)

    def test_structures_have_their_colors_also_through_a_state(self):
        labels = simple.Calculator(Input=simple.OcclusionPhantom(Resolution=48, Scene="Head"),
                                   ResultArrayName="Label", Function="if(coordsX > 0, 2, 1)")
        display = displays.show(labels, self.view)
        for name, value in ORDINARY.items():
            setattr(display, name, value)
        display.StructureArray = ["POINTS", "Label"]
        display.Structures = ["1", "left", "1", "", "2", "right", "1", ""]
        without = pictures.take(self.view)
        display.StructureColors = 1
        display.StructureLegend = 0
        display.LabelColors = [1, 0, 0, 1, 2, 0, 1, 0]
        tinted = pictures.take(self.view)
        pictures.write(os.path.join(os.environ.get("LIMPID_TEST_OUTPUT", tempfile.gettempdir()),
                                    "structure-colors.png"), tinted)
        background = 255 * np.array(displays.BACKGROUND)
        seen = (np.abs(tinted - background).max(axis=2) > 60)
        green = seen & (tinted[..., 1] > tinted[..., 2] + 60)
        blue = seen & (tinted[..., 2] > tinted[..., 1] + 60)
        self.assertGreater(green.sum(), 500)
        self.assertGreater(blue.sum(), 500)
        # No red, but for the background behind.
        self.assertLessEqual(tinted[seen][:, 0].max(), background[0] + 1)
        self.assertEqual(display.Messages, "")
        display.StructureColors = 0
        np.testing.assert_array_equal(pictures.take(self.view), without)
        display.StructureColors = 1
        self.assertEqual(pictures.difference(pictures.take(displays.through_a_state()), tinted)[0], 0)

    def test_the_score_is_drawn_in_the_upper_left_corner(self):
        display = displays.show_head(self.view, ScoreInScreenshots=1)
        without = pictures.take(self.view)
        display.ShowScore = 1
        changed = np.abs(pictures.take(self.view) - without).max(axis=2) > 0
        display.ShowScore = 0

        rows, columns = np.nonzero(changed)
        self.assertGreater(rows.min(), 150)
        self.assertLess(columns.min(), 10)
        self.assertGreater(changed.sum(), 500)
        np.testing.assert_array_equal(pictures.take(self.view), without)

    def test_what_is_missed_has_a_legend_in_its_color(self):
        display = displays.show_head(self.view, Method="Ordinary")
        without = pictures.take(self.view)
        display.ShowMissed = 1
        display.MissedColor = [0.2, 1.0, 0.3]
        picture = pictures.take(self.view)
        pictures.write(os.path.join(os.environ.get("LIMPID_TEST_OUTPUT", tempfile.gettempdir()),
                                    "missed-legend.png"), picture)
        corner = picture[170:]  # rows from the bottom; the head is lower
        green = np.abs(corner - 255 * np.array([0.2, 1.0, 0.3])).max(axis=2) < 40
        self.assertGreater(green.sum(), 20)
        props = self.view.GetRenderer().GetViewProps()
        legends = [str(prop) for prop in props if prop.IsA("vtkScoreAnnotation")]
        self.assertIn("Legend: This color: removed or hidden", legends[0])
        display.ShowMissed = 0
        np.testing.assert_array_equal(pictures.take(self.view), without)

    def test_saved_pictures_have_the_score_if_that_is_asked_for(self):
        display = displays.show_head(self.view)
        without = pictures.take(self.view)
        display.ShowScore = 1
        np.testing.assert_array_equal(pictures.take(self.view), without)
        self.assertRegex(self.score_texts()[0], "^Visible ")
        display.ScoreInScreenshots = 1
        self.assertGreater(np.abs(pictures.take(self.view) - without).max(), 50)

    def test_says_that_nothing_important_is_in_view(self):
        display = displays.show_head(self.view, ShowScore=1)
        nothing = "Nothing important is in view"
        self.view.CameraPosition, self.view.CameraFocalPoint = [0, -50, 0], [0, -100, 0]
        simple.Render(self.view)
        self.assertEqual(self.score_texts(), [nothing])  # nor anything else
        displays.look(self.view, displays.POSITIONS[0])
        simple.Render(self.view)
        self.assertRegex(self.score_texts()[0], "^Visible ")
        for method in ("Optimized", "Ordinary"):
            display.Method = method
            display.UseImportanceFunction = 1
            display.ImportanceFunction.Points = [-1e3, 0, 0.5, 0, 1e3, 0, 0.5, 0]
            simple.Render(self.view)
            self.assertEqual(self.score_texts(), [nothing])

    def score_texts(self):
        props = self.view.GetRenderer().GetViewProps()
        texts = [str(prop) for prop in props if prop.IsA("vtkScoreAnnotation")]
        return [text.split("Text: ")[1].splitlines()[0] for text in texts]

    def test_scores_have_names_where_there_are_several(self):
        for name, x in (("one", -1.2), ("another", 1.2)):
            source = OcclusionPhantom(Resolution=24, registrationName=name)
            display = displays.show(source, self.view)
            displays.move(display, [x, 0, 0])
            display.ShowScore = 1
            simple.ResetCamera(self.view)
            simple.Render(self.view)
            if name == "one":
                texts = self.score_texts()
                self.assertEqual(len(texts), 1)
                self.assertRegex(texts[0], "^Visible [0-9.]+ % of at most [0-9.]+ % from here \\(was ")
        texts = self.score_texts()
        self.assertEqual(len(texts), 2)
        self.assertRegex(texts[0], "^one: [0-9.]+ % visible of at most [0-9.]+ % from here")
        self.assertRegex(texts[1], "^another: [0-9.]+ % visible of at most [0-9.]+ % ")

        simple.RenameSource("a new name", source)
        simple.Render(self.view)
        self.assertTrue(self.score_texts()[1].startswith("a new name: "))

        simple.Hide(source, self.view)
        simple.Render(self.view)
        self.assertTrue(self.score_texts()[0].startswith("Visible "))

    def test_the_score_can_be_read_on_any_background(self):
        display = displays.show_head(self.view, ScoreInScreenshots=1)
        display.ShowScore = 1
        for background in ([0, 0, 0], [1, 1, 1], [0.5, 0.5, 0.5]):
            with self.subTest(background=background):
                self.view.Background = background
                corner = pictures.take(self.view)[170:, :150]

                # Contrast of letters and plate.
                self.assertGreater(corner.max() - np.percentile(corner, 20), 100)

    def test_the_score_goes_with_its_display(self):
        empty = pictures.take(self.view)
        source = OcclusionPhantom(Resolution=24)
        display = displays.show(source, self.view)
        display.ShowScore = display.ScoreInScreenshots = 1
        simple.Render(self.view)
        simple.Hide(source, self.view)
        np.testing.assert_array_equal(pictures.take(self.view), empty)
        simple.Show(source, self.view)
        display.SetRepresentationType("Outline")
        display.Visibility = 0
        np.testing.assert_array_equal(pictures.take(self.view), empty)
        simple.Delete(source)
        np.testing.assert_array_equal(pictures.take(self.view), empty)

    def test_other_types_of_representation_come_back_as_they_were(self):
        display = displays.show_head(self.view)
        optimized = pictures.take(self.view)
        reference = stock(display, self.view)
        for representation in ("Surface", "Slice", "Outline"):
            display.SetRepresentationType(representation)
            simple.Render(self.view)
        display.SetRepresentationType("Optimized Volume")

        np.testing.assert_array_equal(pictures.take(self.view), optimized)
        np.testing.assert_array_equal(stock(display, self.view), reference)


if __name__ == "__main__":
    runner.run()

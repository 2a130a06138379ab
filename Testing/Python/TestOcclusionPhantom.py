# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

import unittest

import numpy as np

from limpid.vtkLimpidFilters import vtkOcclusionPhantom

import images
from images import abort_at_every_event, caught, memory_limited_to, values

SCENES = {"Head": 0, "Flame": 1, "Shells": 2, "Homogeneous": 3, "Vessels": 4}


def phantom(scene, resolution=32):
    return images.phantom(resolution, SCENES[scene])


class TestOcclusionPhantom(unittest.TestCase):
    def test_spans_the_cube_from_minus_one_to_one(self):
        image = phantom("Head", 17)

        self.assertEqual(image.GetDimensions(), (17, 17, 17))
        self.assertEqual(image.GetBounds(), (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0))

    def test_every_scene_has_finite_fields_in_their_ranges(self):
        for scene in SCENES:
            with self.subTest(scene=scene):
                image = phantom(scene)

                for name in ("Scalars", "Importance"):
                    self.assertGreaterEqual(values(image, name).min(), 0.0)
                    self.assertLessEqual(values(image, name).max(), 1.0)
                self.assertGreaterEqual(values(image, "BaseExtinction").min(), 0.0)
                self.assertTrue(np.isfinite(values(image, "BaseExtinction")).all())
                self.assertEqual(image.GetPointData().GetScalars().GetName(), "Scalars")

    def test_the_head_hides_several_structures_of_different_importance(self):
        importance = values(phantom("Head", 64), "Importance")

        for level in (0.35, 0.8, 1.0):  # skull, vessels, tumour
            self.assertGreater(np.count_nonzero(np.abs(importance - level) < 1e-6), 30)

    def test_structures_are_the_shapes(self):
        for scene, shapes in {"Head": 6, "Flame": 4, "Shells": 4, "Homogeneous": 1,
                              "Vessels": 3}.items():
            with self.subTest(scene):
                image = phantom(scene)
                labels = values(image, "Structure")
                expected = range(1, shapes + 1) if scene == "Homogeneous" else range(shapes + 1)
                self.assertEqual(np.unique(labels).tolist(), list(expected))
                extinction = values(image, "BaseExtinction")
                self.assertGreater(extinction[labels > 0].min(), 0)
        image = phantom("Head")
        importance, labels = values(image, "Importance"), values(image, "Structure")
        self.assertGreaterEqual(importance[labels == 6].min(), 0.5)  # the tumour has most of the point
        self.assertLess(importance[labels == 1].max(), 0.5)

    def test_the_homogeneous_scene_is_constant(self):
        image = phantom("Homogeneous", 8)

        for name, value in (("Scalars", 0.5), ("Importance", 1.0), ("BaseExtinction", 1.0)):
            self.assertTrue((values(image, name) == value).all())

    def test_a_finer_grid_samples_the_same_shapes(self):
        # Edges are smooth and at least 1.5 voxels wide, so the mean extinction of the volume is a
        # quadrature of a smooth function: two grids differ by less than a percent.
        for scene in SCENES:
            with self.subTest(scene=scene):
                coarse = values(phantom(scene, 64), "BaseExtinction").mean()
                fine = values(phantom(scene, 96), "BaseExtinction").mean()

                # Border points have half the weight that a mean gives them: a relative error of
                # 1/n on a scene that reaches the border.
                self.assertLess(abs(coarse - fine), fine * 3 * (1 / 64 - 1 / 96) + 0.01 * fine)

    def test_pieces_agree_with_the_whole(self):
        whole = values(phantom("Head", 16), "Scalars").reshape(16, 16, 16)
        source = vtkOcclusionPhantom()
        source.SetResolution(16)
        source.UpdateExtent((4, 9, 0, 15, 3, 3))

        piece = values(source.GetOutput(), "Scalars").reshape(1, 16, 6)

        np.testing.assert_array_equal(piece, whole[3:4, :, 4:10])

    def test_an_abort_at_any_event_leaves_all_or_nothing(self):
        expected = values(phantom("Head", 64), "Scalars")
        source = vtkOcclusionPhantom()
        source.SetResolution(64)

        def look():
            output = source.GetOutput()
            if output.GetNumberOfPoints() > 0:
                np.testing.assert_array_equal(values(output, "Scalars"), expected)
            else:
                self.assertEqual(output.GetPointData().GetNumberOfArrays(), 0)
        errors = caught(source)
        abort_at_every_event(source, look)

        self.assertEqual(source.GetOutput().GetNumberOfPoints(), 64 ** 3)
        self.assertEqual(errors, [])

    def test_says_how_much_memory_is_missing_and_goes_on(self):
        source = vtkOcclusionPhantom()
        source.SetResolution(8)
        source.Update()  # its threads are there
        errors = caught(source, "ErrorEvent")
        source.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        source.SetResolution(2000)
        with memory_limited_to(2 ** 30):
            source.Update()

        self.assertEqual(len(errors), 1)
        self.assertIn("2000 x 2000 x 2000 points (about 96.9 GiB", errors[0])
        self.assertIn("Resolution", errors[0])
        self.assertEqual(source.GetOutput().GetNumberOfPoints(), 0)
        source.SetResolution(8)
        source.Update()
        self.assertEqual(source.GetOutput().GetNumberOfPoints(), 512)


if __name__ == "__main__":
    unittest.main()

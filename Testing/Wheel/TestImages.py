# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Images, cameras and lights of PyVista and of VTK, which the package itself does not know.

import subprocess
import sys
import unittest

import numpy as np

import limpid
from limpid.scene import scene_of

import phantom
from phantom import EXTINCTION, IMPORTANCE, ORIGIN, SCENE, SPACING, VIEW

try:
    import pyvista
    import vtk
except ImportError:
    pyvista = vtk = None

FUNCTIONS = {"extinction_function": EXTINCTION, "importance_function": IMPORTANCE}


def plain(image):
    """An image of PyVista's as VTK has it."""
    result = vtk.vtkImageData()
    result.ShallowCopy(image)
    return result


class TestWithoutVtk(unittest.TestCase):
    def test_neither_vtk_nor_pyvista_is_imported(self):
        program = ("import sys, limpid; "
                   "sys.exit(any(name.startswith(('vtk', 'pyvista')) for name in sys.modules))")
        self.assertEqual(subprocess.run([sys.executable, "-c", program], check=False).returncode, 0)


@unittest.skipIf(pyvista is None, "PyVista is not installed")
class TestPyVista(unittest.TestCase):
    def image(self, **arrays):
        image = pyvista.ImageData(dimensions=phantom.SHAPE, spacing=SPACING, origin=ORIGIN)
        for name, array in (arrays or {"values": phantom.scalars()}).items():
            image.point_data[name] = array.ravel(order="F")
        return image

    def test_an_image_gives_what_its_array_gives(self):
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)

        for image in (self.image(), plain(self.image())):
            result = limpid.optimize(image, scalars="values", **FUNCTIONS, **VIEW)
            np.testing.assert_array_equal(result.extinction, expected.extinction)

        image = self.image()
        image.set_active_scalars("values")
        result = limpid.optimize(image, **FUNCTIONS, **VIEW)
        image["Extinction"] = result.extinction.ravel(order="F")
        self.assertTrue(np.shares_memory(result.extinction.ravel(order="F"), result.extinction))

    def test_its_arrays_are_used_where_they_are(self):
        mu, g = phantom.fields()
        image = self.image(BaseExtinction=mu, Importance=g)
        scene = scene_of(image, extinction="BaseExtinction")

        self.assertTrue(np.shares_memory(scene.base_extinction,
                                         np.asarray(image.point_data["BaseExtinction"])))
        self.assertTrue(np.shares_memory(scene.importance,
                                         np.asarray(image.point_data["Importance"])))

    def test_extent_and_direction_count(self):
        image = self.image()
        image.offset = (2, 3, 4)
        image.origin = np.array(ORIGIN) - np.multiply(SPACING, (2, 3, 4))
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        self.assertEqual(limpid.optimize(image, **FUNCTIONS, **VIEW).visibility_score,
                         expected.visibility_score)

        turn = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        image = self.image()
        image.direction_matrix = turn
        expected = limpid.optimize(phantom.scalars(), direction=turn, **SCENE, **VIEW)
        for turned in (image, plain(image)):
            self.assertEqual(limpid.optimize(turned, scalars="values", **FUNCTIONS,
                                             **VIEW).visibility_score, expected.visibility_score)

    def test_a_negative_spacing_turns_an_axis_round(self):
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        backwards = {**SCENE, "spacing": np.multiply(SPACING, (-1, 1, 1)),
                     "origin": np.add(ORIGIN, ((phantom.SHAPE[0] - 1) * SPACING[0], 0, 0))}
        found = limpid.optimize(phantom.scalars()[::-1], **backwards, **VIEW)
        self.assertLess(abs(found.visibility_score / expected.visibility_score - 1), 1e-6)

    def test_direction_matrices_of_few_digits_are_made_orthonormal(self):
        turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
        exact = limpid.optimize(phantom.scalars(), direction=turn, **SCENE, **VIEW)
        rounded = limpid.optimize(phantom.scalars(), direction=turn + 4e-5, **SCENE, **VIEW)
        self.assertLess(abs(rounded.visibility_score / exact.visibility_score - 1), 1e-3)

    def test_what_it_lacks_is_told(self):
        for arguments, words in (({"scalars": "density"}, "'density' is not among"),
                                 ({"importance_function": None}, "'Importance' is not among"),
                                 ({"spacing": (1, 1, 1)}, "spacing and an image")):
            with self.assertRaises(ValueError) as caught:
                limpid.optimize(self.image(), **{**FUNCTIONS, **arguments})
            self.assertIn(words, str(caught.exception))

        blanked = self.image()
        blanked.point_data["vtkGhostType"] = np.full(blanked.n_points, 2, dtype=np.uint8)
        with self.assertRaisesRegex(ValueError, "vtkGhostType in its point_data"):
            limpid.optimize(blanked, scalars="values", **FUNCTIONS)

    def test_cameras_and_lights_of_pyvista_are_taken(self):
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        camera = pyvista.Camera()
        camera.position, camera.focal_point, camera.up = VIEW["camera"].values()
        light = pyvista.Light(position=VIEW["light"], positional=True)
        for given in (camera, tuple(VIEW["camera"].values()), limpid.Camera(**VIEW["camera"])):
            result = limpid.optimize(phantom.scalars(), camera=given, light=light, **SCENE)
            self.assertEqual(result.visibility_score, expected.visibility_score)

        lamp = pyvista.Light(position=VIEW["light"], focal_point=VIEW["camera"]["focal_point"],
                             positional=False)
        for given in (lamp, limpid.Light(VIEW["light"], directional=True)):
            one = limpid.optimize(phantom.scalars(), camera=camera, light=given, **SCENE)
            self.assertNotEqual(one.energy, expected.energy)
        self.assertEqual(one.energy, limpid.optimize(phantom.scalars(), camera=camera, light=lamp,
                                                     **SCENE).energy)

    def test_the_sphere_is_a_surface(self):
        found = limpid.viewpoints(self.image(), number_of_directions=42, refine=False, **FUNCTIONS)
        surface = pyvista.PolyData.from_regular_faces(found.directions, found.triangles)

        self.assertTrue(surface.is_manifold)
        self.assertEqual(surface.n_points, len(found.visibility_scores))


if __name__ == "__main__":
    unittest.main()

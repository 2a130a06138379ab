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
            np.testing.assert_array_equal(result.extinction,
                                          expected.extinction.ravel(order="F"))

    def test_its_arrays_are_arrays(self):
        scalars = self.image()["values"].reshape(phantom.SHAPE, order="F")
        self.assertIsInstance(scalars, pyvista.pyvista_ndarray)

        result = limpid.optimize(scalars, **SCENE, **VIEW)

        np.testing.assert_array_equal(
            result.extinction, limpid.optimize(phantom.scalars(), **SCENE, **VIEW).extinction)

    def test_what_is_found_goes_into_the_image(self):
        image = self.image()
        image.set_active_scalars("values")
        for settings in ({}, {"mode": "separate"}, {"importance": phantom.scalars("C")}):
            result = limpid.optimize(image, **FUNCTIONS, **VIEW, **settings)
            image["Extinction"] = result.extinction
            image["Opacity"] = result.opacity()
            expected = limpid.optimize(phantom.scalars(), **{**SCENE, **VIEW, **settings})

            found = np.asarray(image["Extinction"]).reshape(result.dimensions, order="F")
            np.testing.assert_array_equal(found, expected.extinction)
            if result.light_extinction is not None:
                image["Light"] = result.light_extinction
        self.assertIn("24 x 20 x 16 points", repr(result))

    def test_what_is_found_is_drawn(self):
        image = self.image()
        found = limpid.optimize(image, scalars="values", **FUNCTIONS, **VIEW)
        draw = {"color_function": phantom.COLORS, "extinction_function": EXTINCTION, "width": 30,
                "height": 30, "camera": found.camera}
        expected = limpid.render(phantom.scalars(), spacing=SPACING, origin=ORIGIN,
                                 extinction=found.extinction.reshape(found.dimensions, order="F"),
                                 **draw)

        np.testing.assert_array_equal(limpid.render(image, scalars="values",
                                                    extinction=found.extinction, **draw), expected)

    def test_its_arrays_are_used_where_they_are(self):
        mu, g = phantom.fields()
        image = self.image(BaseExtinction=mu, Importance=g)
        scene = scene_of(image, extinction="BaseExtinction")

        self.assertTrue(np.shares_memory(scene.base_extinction,
                                         np.asarray(image.point_data["BaseExtinction"])))
        self.assertTrue(np.shares_memory(scene.importance,
                                         np.asarray(image.point_data["Importance"])))

    def test_a_component_of_an_array_is_the_importance(self):
        image = self.image()
        g = phantom.scalars().ravel(order="F")
        image["vectors"] = np.column_stack([np.zeros_like(g), g, np.zeros_like(g)])
        expected = limpid.optimize(image, scalars="values", **FUNCTIONS, **VIEW)
        for component in (1, -1):
            found = limpid.optimize(image, scalars="values", importance="vectors",
                                    importance_component=component, **FUNCTIONS, **VIEW)
            # A length is rounded to double precision.
            self.assertAlmostEqual(found.visibility_score, expected.visibility_score)

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
                                 ({"spacing": (1, 1, 1)}, "spacing and an image")):
            with self.assertRaises(ValueError) as caught:
                limpid.optimize(self.image(), **{**FUNCTIONS, **arguments})
            self.assertIn(words, str(caught.exception))

        blanked = self.image()
        blanked.point_data["vtkGhostType"] = np.full(blanked.n_points, 2, dtype=np.uint8)
        with self.assertRaisesRegex(ValueError, "vtkGhostType in its point_data"):
            limpid.optimize(blanked, scalars="values", **FUNCTIONS)

    def test_other_data_are_refused_with_a_way_out(self):
        ticks = [np.arange(count, dtype=float) for count in phantom.SHAPE]
        for data, words in (
                (pyvista.RectilinearGrid(*ticks), ("a RectilinearGrid", "pyvista.create_grid")),
                (pyvista.StructuredGrid(*np.meshgrid(*ticks)), ("a StructuredGrid", "sample")),
                (pyvista.Sphere(), ("a PolyData", "without an inside")),
                (pyvista.MultiBlock([self.image()]), ("a MultiBlock", "one of its blocks"))):
            for function, more in ((limpid.optimize, FUNCTIONS), (limpid.viewpoints, FUNCTIONS),
                                   (limpid.render, {"color_function": phantom.COLORS})):
                with self.assertRaises(ValueError) as caught:
                    function(data, **more)
                for word in (*words, "uniform spacing"):
                    self.assertIn(word, str(caught.exception))

        grid = pyvista.RectilinearGrid(*ticks)
        grid["values"] = phantom.scalars().ravel(order="F")
        advised = pyvista.create_grid(grid, dimensions=(10, 10, 10)).sample(grid)
        limpid.optimize(advised, scalars="values", **FUNCTIONS)

    def test_values_of_cells_are_refused_with_a_way_out(self):
        image = pyvista.ImageData(dimensions=phantom.SHAPE)
        image.cell_data["density"] = np.linspace(0, 1, image.n_cells)
        for arguments in ({"scalars": "density"}, {}, {"scalars": image.cell_data["density"]}):
            with self.assertRaises(ValueError) as caught:
                limpid.optimize(image, **FUNCTIONS, **arguments)
            self.assertIn("values must be given at points", str(caught.exception))
            self.assertIn("cell_data_to_point_data()", str(caught.exception))

        limpid.optimize(image.cell_data_to_point_data(), **FUNCTIONS)

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

    def test_cameras_are_given_to_pyvista(self):
        plotter = pyvista.Plotter(off_screen=True)
        plotter.add_mesh(pyvista.Sphere(radius=9, center=(8, 3, 7)))
        found = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        view = limpid.viewpoints(phantom.scalars(), number_of_directions=12, refine=False,
                                 camera_view_angle=20, **SCENE)[0]
        for camera in (found.camera, view):
            plotter.camera_position = camera
            for given, expected in zip(plotter.camera_position, camera):
                np.testing.assert_allclose(given, expected)

        view.give_to(plotter.camera)
        self.assertEqual(plotter.camera.view_angle, 20)
        same = limpid.optimize(phantom.scalars(), camera=plotter.camera, **SCENE).camera
        np.testing.assert_allclose(same, view)
        plotter.close()

    def test_the_sphere_is_a_surface(self):
        found = limpid.viewpoints(self.image(), number_of_directions=42, refine=False, **FUNCTIONS)
        surface = pyvista.PolyData.from_regular_faces(found.directions, found.triangles)

        self.assertTrue(surface.is_manifold)
        self.assertEqual(surface.n_points, len(found.visibility_scores))


if __name__ == "__main__":
    unittest.main()

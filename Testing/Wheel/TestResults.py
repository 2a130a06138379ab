# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What results can do: show themselves in notebooks, go to PyVista, into files and back.

import dataclasses
import pathlib
import re
import struct
import tempfile
import unittest
import zlib

import numpy as np

import limpid

import phantom
from phantom import ORIGIN, SCENE, SPACING, VIEW

try:
    import pyvista
except ImportError:
    pyvista = None


def optimized(values=None, **arguments):
    return limpid.optimize(phantom.scalars() if values is None else values,
                           **{**SCENE, **VIEW, **arguments})


def searched():
    return limpid.viewpoints(phantom.scalars(), number_of_directions=42, **SCENE)


def decoded(file):
    """The picture in a PNG file whose rows have no filter."""
    chunks, position = {}, 8
    while position < len(file):
        length, kind = struct.unpack(">I4s", file[position:position + 8])
        data = file[position + 8:position + 8 + length]
        checksum, = struct.unpack(">I", file[position + 8 + length:position + 12 + length])
        assert checksum == zlib.crc32(kind + data)
        chunks[kind] = data
        position += 12 + length
    width, height, _, color_type = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    channels = {2: 3, 6: 4}[color_type]
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8)
    return rows.reshape(height, 1 + width * channels)[:, 1:].reshape(height, width, channels)


class InTemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class TestPng(unittest.TestCase):
    def test_has_the_bytes_of_the_picture(self):
        random = np.random.default_rng(5)
        for channels in (3, 4):
            picture = random.integers(0, 256, (5, 7, channels), dtype=np.uint8)
            file = limpid.png(picture)
            self.assertEqual(file[:8], b"\x89PNG\r\n\x1a\n")
            np.testing.assert_array_equal(decoded(file), picture)

    def test_refuses_what_is_no_picture(self):
        for wrong in (np.zeros((3, 3, 4)), np.zeros((3, 3), np.uint8), np.zeros((3, 0, 4), np.uint8)):
            with self.assertRaisesRegex(ValueError, "8 bits"):
                limpid.png(wrong)


class TestThumbnails(unittest.TestCase):
    def test_show_what_is_important_after_and_not_before(self):
        found = optimized()
        orange = [int(np.clip(picture[..., 0].astype(int) - picture[..., 2], 0, None)
                      [picture[..., 3] > 0].sum())
                  for picture in (found.thumbnail(before=True), found.thumbnail())]

        self.assertGreater(orange[1], 2 * orange[0])
        self.assertEqual(found.thumbnail(50).shape, (50, 50, 4))

    def test_draw_the_extinction_that_they_are_of(self):
        """Alpha is Beer's law of the extinction, whatever the importance is that colors it."""
        mu = np.full(phantom.SHAPE, 0.1, dtype=np.float32, order="F")
        g = np.zeros_like(mu)
        g[:, :10] = 1
        x, y, z = ORIGIN + np.multiply(SPACING, np.subtract(phantom.SHAPE, 1)) / 2
        found = limpid.optimize(extinction=mu, importance=g, spacing=SPACING, origin=ORIGIN,
                                camera=((x, y, z + 40), (x, y, z), (0, 1, 0)))
        alpha = found.thumbnail(41, before=True)[20, 20, 3]

        expected = 255 * -np.expm1(-0.1 * SPACING[2] * (phantom.SHAPE[2] - 1))
        self.assertLessEqual(abs(alpha - expected), 1)  # a step of 8 bits

    def test_of_large_volumes_take_every_nth_point(self):
        mu = np.ones((200, 10, 97), dtype=np.float32, order="F")
        found = limpid.optimize(extinction=mu, importance=mu, maximum_iterations=1)

        self.assertEqual(found.preview.base_extinction.shape, (67, 10, 49))
        self.assertEqual(found.preview.grid.spacing, (3, 1, 2))
        self.assertGreater(found.thumbnail()[..., 3].max(), 0)

    def test_are_the_same_in_every_order_of_axes(self):
        fortran = optimized().thumbnail().astype(int)
        c = optimized(phantom.scalars("C")).thumbnail().astype(int)
        self.assertLessEqual(np.abs(fortran - c).mean(), 1)

    def test_notebooks_show_them_with_the_shares(self):
        for found, count in ((optimized(), 2), (searched(), 4)):
            html = found._repr_html_()
            self.assertEqual(len(re.findall('<img [^>]*src="data:image/png;base64,', html)), count)
            self.assertIn("limpid." + type(found).__name__, html)
            self.assertNotIn("<1", html)  # what reprs have is escaped


class TestCamera(unittest.TestCase):
    def test_has_the_camera_position_of_pyvista(self):
        camera = limpid.Camera((1, 2, 3), (4, 5, 6), (0, 0, 1))
        self.assertEqual(camera.cpos, [(1, 2, 3), (4, 5, 6), (0, 0, 1)])
        best = searched()[0]
        self.assertEqual(best.cpos, [best.position, best.focal_point, best.view_up])


class TestFiles(InTemporaryFolder):
    def saved_and_loaded(self, found, **options):
        found.save(self.folder / "found.npz", **options)
        return limpid.load(self.folder / "found.npz")

    def assert_same(self, one, other):
        self.assertIs(type(one), type(other))
        for field in dataclasses.fields(one):
            if field.name in ("memory", "preview"):
                continue
            mine, theirs = getattr(one, field.name), getattr(other, field.name)
            if isinstance(mine, np.ndarray):
                np.testing.assert_array_equal(mine, theirs)
                self.assertEqual(mine.dtype, theirs.dtype)
            else:
                self.assertEqual(mine, theirs, field.name)

    def test_an_optimisation_comes_back(self):
        for values, arguments in ((phantom.scalars(), {}), (phantom.scalars("C"), {}),
                                  (phantom.scalars(), {"mode": "separate"})):
            found = optimized(values, **arguments)
            for compress in (True, False):
                again = self.saved_and_loaded(found, compress=compress)

                self.assert_same(found, again)
                np.testing.assert_array_equal(again.thumbnail(), found.thumbnail())
                self.assertEqual(repr(again), repr(found))
                self.assertEqual(np.isfortran(again.extinction), np.isfortran(found.extinction))

    def test_structures_come_back(self):
        labels = np.where(phantom.scalars() > 0.8, 2, (phantom.scalars() > 0.4).astype(int))
        scene = {name: value for name, value in SCENE.items() if name != "importance_function"}
        found = limpid.optimize(phantom.scalars(), structures=labels, importance={2: 1, 1: 0.1},
                                **scene, **VIEW)

        self.assert_same(found, self.saved_and_loaded(found))

    def test_a_search_comes_back(self):
        found = searched()
        again = self.saved_and_loaded(found)

        self.assert_same(found, again)
        np.testing.assert_array_equal(again.thumbnail(1), found.thumbnail(1))

    def test_an_optimisation_goes_on_from_a_file_but_not_coherently(self):
        found = optimized(previous=None, temporal_coherence=0.2)
        again = self.saved_and_loaded(found)

        warm = [optimized(previous=before, warm_start=True, maximum_iterations=1)
                for before in (found, again)]
        np.testing.assert_array_equal(*(each.extinction for each in warm))
        with self.assertRaisesRegex(ValueError, "loaded from a file"):
            optimized(previous=again, temporal_coherence=0.2)

    def test_numpy_reads_them(self):
        found = optimized()
        found.save(self.folder / "found")  # exactly this name

        with np.load(self.folder / "found") as archive:
            np.testing.assert_array_equal(archive["extinction"], found.extinction)
            self.assertIn('"kind": "Optimization"', str(archive["limpid"]))

    def test_other_files_are_refused(self):
        for name, write in (("text", lambda path: path.write_text("no result")),
                            ("empty", lambda path: path.write_bytes(b"")),
                            ("array.npy", lambda path: np.save(path, np.zeros(3))),
                            ("other.npz", lambda path: np.savez(path, a=np.zeros(3)))):
            path = self.folder / name
            write(path)
            with self.assertRaisesRegex(ValueError, f"{name} is not a result of limpid"):
                limpid.load(path)
        with self.assertRaises(FileNotFoundError):
            limpid.load(self.folder / "none.npz")

    def test_later_versions_are_refused(self):
        np.savez(self.folder / "later.npz", limpid=np.array('{"kind": "Movie", "version": 99}'))
        with self.assertRaisesRegex(ValueError, "version 99"):
            limpid.load(self.folder / "later.npz")


@unittest.skipIf(pyvista is None, "PyVista is not installed.")
class TestPyVista(unittest.TestCase):
    def test_results_are_images_with_the_names_of_the_filter(self):
        for values in (phantom.scalars(), phantom.scalars("C")):
            found = optimized(values, mode="separate")
            image = found.to_pyvista(unit_distance=2)

            self.assertEqual(image.dimensions, phantom.SHAPE)
            np.testing.assert_allclose(image.spacing, SPACING)
            np.testing.assert_allclose(image.origin, ORIGIN)
            for name, array in (("Extinction", found.extinction), ("Opacity", found.opacity(2)),
                                ("LightExtinction", found.light_extinction)):
                np.testing.assert_array_equal(image[name], array.ravel(order="F"))
            self.assertEqual(image.active_scalars_name, "Opacity")
            self.assertEqual(image.field_data["VisibilityScore"][0], found.visibility_score)
            self.assertEqual(image.field_data["Backend"][0], found.backend)

    def test_points_are_where_the_volume_has_them(self):
        """Of images, arrays with z first, and axes that run backwards."""
        values = phantom.scalars()
        image = pyvista.ImageData(dimensions=phantom.SHAPE, spacing=SPACING, origin=ORIGIN)
        image["scalars"] = values.ravel(order="F")
        scene = {name: value for name, value in SCENE.items() if name not in ("spacing", "origin")}
        found = limpid.optimize(image, **scene, **VIEW)
        same = found.to_pyvista()
        np.testing.assert_allclose(same.points, image.points, atol=1e-5)
        np.testing.assert_array_equal(same["Extinction"], found.extinction)

        backwards = optimized(spacing=(-SPACING[0], *SPACING[1:]))
        points = backwards.to_pyvista().points
        np.testing.assert_allclose(points[1] - points[0], (-SPACING[0], 0, 0), atol=1e-5)

    def test_a_search_is_a_sphere(self):
        found = searched()
        surface = found.to_pyvista(2, (1, 0, 0))

        self.assertEqual((surface.n_points, surface.n_cells, surface.n_open_edges), (42, 80, 0))
        np.testing.assert_allclose(np.linalg.norm(surface.points - (1, 0, 0), axis=1), 2, rtol=1e-6)
        np.testing.assert_array_equal(surface["VisibilityScore"], found.visibility_scores)


if __name__ == "__main__":
    unittest.main()

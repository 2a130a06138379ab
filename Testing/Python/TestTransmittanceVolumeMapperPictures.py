# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper's pictures without optimization and light, against VTK's own volume mappers: an
# independent check of cameras, transfer functions, opacity correction and compositing.

import unittest

import numpy as np
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource

from images import flipped, rounded_rotation
from volume_views import (DRAW_ON, View, actor_of, colors_of, difference, fixed_point_mapper,
                          gpu_mapper, gray_property, image_of, opacity_of, phantom,
                          phantom_property, plain_mapper, property_of, save, values)

BAR = 1.5  # mean absolute difference of 8-bit values

# With the distance of their samples, in units of the smallest spacing. In the mapper with fixed
# point numbers, the opacity of a shorter step has too few digits; the other one leaves out its
# first step.
REFERENCES = {"fixed point": (fixed_point_mapper, 0.5), "GPU": (gpu_mapper, 0.1)}


def perspective(view, bounds):
    view.look()


def parallel(view, bounds):
    view.look()
    view.camera.ParallelProjectionOn()
    view.camera.SetParallelScale(0.6 * view.camera.GetParallelScale())


def inside(view, bounds):
    view.look()
    middle, size = bounds.mean(1), bounds[:, 1] - bounds[:, 0]
    view.camera.SetPosition(*(middle + 0.3 * size * (0.5, 0.4, 1)))
    view.camera.SetFocalPoint(*middle)
    view.camera.SetViewAngle(60)
    # VTK's mapper on the GPU begins 0.2 % of the box's diagonal behind the near plane, so that
    # pictures differ where the medium that is cut by this plane fills most of them.
    view.camera.SetClippingRange(0.05 * size.max(), 3 * size.max())


class PictureTest(unittest.TestCase):
    def pictures(self, image, volume_property, place, decorate=None, name=None,
                 references=REFERENCES):
        """Ours and the references', with the camera that place(view, bounds) sets."""
        mappers = {"ours": plain_mapper()}
        for key in references:
            make, step = REFERENCES[key]
            mappers[key] = make(step * min(image.GetSpacing()))
        result = {}
        for key, mapper in mappers.items():
            view = View()
            volume = view.add(image, volume_property, mapper)
            if decorate:
                decorate(view, volume)
            place(view, np.array(image.GetBounds()).reshape(3, 2))
            result[key] = view.picture()
            if name:
                save(result[key], name + " " + key)
        return result

    def assert_same(self, pictures, bar=BAR):
        ours = pictures.pop("ours")
        self.assertGreater(ours.std(), 3)  # there is something in it
        for key, picture in pictures.items():
            with self.subTest(reference=key):
                print(f"{self.id().split('.')[-1]}, {key}: {difference(ours, picture):.2f} of 255")
                self.assertLess(difference(ours, picture), bar)


class TestCameras(PictureTest):
    def check(self, place):
        self.assert_same(self.pictures(phantom(64), phantom_property(), place,
                                       name=f"phantom {place.__name__}"))

    def test_perspective(self):
        self.check(perspective)

    def test_parallel_projection(self):
        self.check(parallel)

    def test_from_inside(self):
        self.check(inside)


class TestPlacement(PictureTest):
    def test_a_moved_turned_and_scaled_volume(self):
        def transform(_, volume):
            volume.SetPosition(1, 2, 3)
            volume.RotateX(30)
            volume.RotateZ(50)
            volume.SetScale(1, 2, 0.7)
        self.assert_same(self.pictures(phantom(), phantom_property(), perspective, transform))

    def test_an_extent_that_does_not_start_at_zero(self):
        image = phantom()
        spacing = np.array(image.GetSpacing())
        image.SetExtent(100, 131, -50, -19, 7, 38)
        image.SetOrigin(*(-1 - spacing * (100, -50, 7)))
        self.assert_same(self.pictures(image, phantom_property(), perspective))

    def test_direction_matrices_of_either_handedness(self):
        # VTK's mapper on the CPU does not know them, the one on the GPU in some versions not: the
        # same voxels, reordered, without a matrix.
        image = phantom()
        scalars = values(image, "Scalars").reshape(32, 32, 32)
        spacing = image.GetSpacing()
        for matrix, reordered, origin in (
                (((0, -1, 0), (1, 0, 0), (0, 0, 1)), scalars.transpose(0, 2, 1)[:, :, ::-1],
                 (1, -1, -1)),
                (((1, 0, 0), (0, -1, 0), (0, 0, 1)), scalars[:, ::-1, :], (-1, 1, -1))):
            turned = phantom()
            turned.SetDirectionMatrix(*np.ravel(matrix).astype(float))
            turned.SetOrigin(*origin)
            plain = image_of((32, 32, 32), spacing, (-1, -1, -1), Scalars=reordered.ravel())
            with self.subTest(matrix=matrix):
                views = [View(), View()]
                views[0].add(turned, phantom_property(), plain_mapper())
                views[1].add(plain, phantom_property(), plain_mapper())
                for view in views:
                    view.look()
                self.assertLess(difference(views[0].picture(), views[1].picture()), 0.1)

    def test_direction_matrices_of_few_digits(self):
        pictures = []
        for digits in (16, 5, 4, 3):
            image = phantom()
            image.SetDirectionMatrix(*rounded_rotation(digits).ravel())
            view = View()
            view.add(image, phantom_property(), plain_mapper())
            view.look()
            pictures.append(view.picture())
            self.assertGreater(pictures[-1].std(), 3)
            self.assertLess(difference(pictures[-1], pictures[0]), 0.5)

    def test_a_negative_spacing(self):
        pictures = []
        for axes in ((), (0,), (1, 2)):
            view = View()
            view.add(flipped(phantom(), *axes), phantom_property(), plain_mapper())
            view.look()
            pictures.append(view.picture())
            self.assertLess(difference(pictures[-1], pictures[0]), 0.1)

    def test_far_from_the_origin_and_tiny(self):
        reference = View()
        reference.add(phantom(), phantom_property(), plain_mapper())
        reference.look()
        for unit, place in ((1, 1e5), (1e-9, 0), (1e9, 1e9)):
            with self.subTest(unit=unit, place=place):
                image = phantom()
                image.SetSpacing(*(unit * np.array(image.GetSpacing())))
                image.SetOrigin(*(place + unit * np.array(image.GetOrigin())))
                volume_property = phantom_property()
                volume_property.SetScalarOpacityUnitDistance(0.05 * unit)
                view = View()
                view.add(image, volume_property, plain_mapper())
                view.look()
                self.assertLess(difference(view.picture(), reference.picture()), 0.2)

    def test_a_viewport_that_is_a_part_of_the_window(self):
        def divide(view, _):
            view.renderer.SetViewport(0.3, 0.1, 0.9, 0.7)
        self.assert_same(self.pictures(phantom(), phantom_property(), perspective, divide))

    def test_a_picture_in_tiles(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

        def tiled(mapper):
            view = View((120, 120))
            view.add(phantom(), phantom_property(), mapper)
            view.look()
            capture = vtkWindowToImageFilter()
            capture.SetInput(view.window)
            capture.SetScale(2)
            capture.SetInputBufferTypeToRGB()
            capture.ReadFrontBufferOff()
            capture.Update()
            return vtk_to_numpy(capture.GetOutput().GetPointData().GetScalars()).astype(float)
        view = View((240, 240))
        view.add(phantom(), phantom_property(), plain_mapper())
        view.look()
        # The tiles' cameras differ from the whole picture's by rounding.
        self.assertLess(difference(tiled(plain_mapper()), view.picture().reshape(-1, 3)), 0.2)

    def test_the_picture_of_one_eye(self):
        def right(view, _):
            view.window.StereoRenderOn()
            view.window.SetStereoTypeToRight()
            view.camera.SetEyeAngle(20)

        # VTK's mapper on the GPU sends an eye's rays from the place of the other one or from
        # between: with this angle, it is 14 of 255 from VTK's own mapper on the CPU.
        self.assert_same(self.pictures(phantom(), phantom_property(), perspective, right,
                                       references=["fixed point"]))

        # An opaque box covers the pixels that VTK's polygons of the box cover.
        bounds = (-1, 1, -0.5, 0.5, -0.7, 0.7)
        box = image_of((3, 3, 3), (1, 0.5, 0.7), (-1, -0.5, -0.7), s=np.zeros(27))
        cube = vtkCubeSource()
        cube.SetBounds(bounds)
        pictures = []
        for decorate in (lambda view, _: view.add(box, gray_property(1.0, 1e-6, (1, 0, 0)),
                                                  plain_mapper()),
                         add_surface(cube, (1, 0, 0))):
            view = View()
            decorate(view, None)
            view.look()
            right(view, None)
            pictures.append(view.picture())
        np.testing.assert_array_equal(*pictures)

    def test_over_other_backgrounds(self):
        def white(view, _):
            view.renderer.SetBackground(1, 1, 1)

        def gradient(view, _):
            view.renderer.GradientBackgroundOn()
            view.renderer.SetBackground2(0.9, 0.8, 0.1)
        for decorate in (white, gradient):
            with self.subTest(background=decorate.__name__):
                self.assert_same(self.pictures(phantom(), phantom_property(), perspective,
                                               decorate))

    def test_a_picture_off_the_axis(self):
        def shifted(view, bounds):
            view.look()
            view.camera.SetWindowCenter(0.4, -0.3)
        self.assert_same(self.pictures(phantom(), phantom_property(), shifted))


class TestFunctionsAndArrays(PictureTest):
    def test_scalar_types(self):
        data = values(phantom(), "Scalars")
        reference = None
        for kind in (np.float32, np.float64, np.uint8, np.int16, np.uint16, np.int32, np.int64):
            with self.subTest(type=kind.__name__):
                top = 200 if kind in (np.uint8,) else 20000
                scaled = (data * top).round().astype(kind)
                image = image_of((32, 32, 32), phantom().GetSpacing(), (-1, -1, -1), s=scaled)
                volume_property = property_of(
                    colors_of((0, 0.2, 0.3, 0.9), (0.5 * top, 0.9, 0.8, 0.6),
                              (top, 0.9, 0.2, 0.1)),
                    opacity_of((0, 0), (0.2 * top, 0.02), (top, 0.2)), 0.05)
                view = View()
                view.add(image, volume_property, plain_mapper())
                view.look()
                picture = view.picture()
                reference = picture if reference is None else reference
                # Values are rounded to 1/200 of their range.
                self.assertLess(difference(picture, reference), 0.5)

    def test_numbers_that_single_precision_cannot_tell_apart(self):
        data = values(phantom(), "Scalars").astype(float)
        pictures = []
        for offset in (0.0, 1e9):
            image = image_of((32, 32, 32), phantom().GetSpacing(), (-1, -1, -1), s=offset + data)
            volume_property = property_of(
                colors_of((offset, 0.2, 0.3, 0.9), (offset + 0.5, 0.9, 0.8, 0.6),
                          (offset + 1, 0.9, 0.2, 0.1)),
                opacity_of((offset, 0), (offset + 0.2, 0.02), (offset + 1, 0.2)), 0.05)
            view = View()
            view.add(image, volume_property, plain_mapper())
            view.look()
            pictures.append(view.picture())
        self.assertLess(difference(*pictures), 0.1)

    def test_a_constant_field(self):
        image = image_of((8, 8, 8), s=np.full(512, 0.3))
        volume_property = property_of(colors_of((0, 1, 0, 0), (1, 0, 0, 1)),
                                      opacity_of((0, 0), (1, 1)), 3.0)
        self.assert_same(self.pictures(image, volume_property, perspective))

    def test_unit_distances(self):
        for unit_distance in (0.002, 0.5):
            with self.subTest(unit_distance=unit_distance):
                volume_property = phantom_property()
                volume_property.SetScalarOpacityUnitDistance(unit_distance)
                self.assert_same(self.pictures(phantom(), volume_property, perspective))

    def test_voxels_of_unequal_edges(self):
        image = phantom()
        image.SetSpacing(*(np.array(image.GetSpacing()) * (1, 0.4, 2.5)))
        self.assert_same(self.pictures(image, phantom_property(), perspective))

    def test_functions_that_reach_less_far_than_the_data(self):
        volume_property = property_of(colors_of((0.4, 0.1, 0.8, 0.2), (0.6, 0.9, 0.1, 0.5)),
                                      opacity_of((0.35, 0), (0.55, 0.15)), 0.05)
        self.assert_same(self.pictures(phantom(), volume_property, perspective))

    def test_gray_transfer_functions(self):
        volume_property = phantom_property()
        volume_property.SetColor(opacity_of((0, 0.2), (0.4, 0.9), (1, 0.5)))
        # VTK's mapper on the GPU knows no gray functions.
        self.assert_same(self.pictures(phantom(), volume_property, perspective,
                                       references=["fixed point"]))

    def test_functions_without_clamping_are_nothing_outside(self):
        volume_property = phantom_property()
        function = opacity_of((0.3, 0.1), (0.6, 0.1))
        function.ClampingOff()
        volume_property.SetScalarOpacity(function)
        self.assert_same(self.pictures(phantom(), volume_property, perspective))

    def test_functions_that_are_constant_where_the_data_are(self):
        for nodes in (((-9, 0.05), (-8, 0.02)), ((8, 0.02), (9, 0.05))):
            with self.subTest(nodes=nodes):
                volume_property = phantom_property()
                volume_property.SetScalarOpacity(opacity_of(*nodes))
                self.assert_same(self.pictures(phantom(), volume_property, perspective))

    def test_steps_and_sharp_peaks(self):
        # They pass between two samples, so that pictures with samples this far apart are not
        # right, VTK's less so because they only know the samples themselves: with steps of a
        # tenth of a voxel all have to agree.
        image, volume_property = phantom(), phantom_property()
        volume_property.SetScalarOpacity(
            opacity_of((0.30, 0), (0.301, 0.1), (0.35, 0.1), (0.351, 0)))
        pictures = {}
        for step in (0.1, 1.0):
            for name, mapper in (("ours", plain_mapper(step)),
                                 ("fixed point", fixed_point_mapper(step * image.GetSpacing()[0])),
                                 ("GPU", gpu_mapper(step * image.GetSpacing()[0]))):
                view = View()
                view.add(image, volume_property, mapper)
                view.look()
                pictures[name, step] = view.picture()
        self.assert_same({name: pictures[name, 0.1] for name in ("ours", "fixed point", "GPU")})
        error = {name: difference(pictures[name, 1.0], pictures[name, 0.1])
                 for name in ("ours", "fixed point", "GPU")}
        print(f"errors of steps of a voxel: {error}")
        self.assertLess(error["ours"], error["fixed point"])
        self.assertLess(error["ours"], error["GPU"])

    def test_colours_on_a_logarithmic_scale_are_those_of_the_legend(self):
        # A slab of one value has the colour that GetColor gives it, as in a scalar bar.
        function = colors_of((0.01, 0, 0, 1), (1, 1, 0, 0))
        function.SetScaleToLog10()
        data = np.full(512, 0.1)
        data[0] = 0.01
        data[-1] = 1.0
        image = image_of((8, 8, 8), s=data)
        volume_property = property_of(function, opacity_of((0, 1), (1, 1)), 0.1)
        view = View()
        view.add(image, volume_property, plain_mapper())
        view.look(0, 0)
        expected = 255 * np.array(function.GetColor(0.1))
        np.testing.assert_allclose(view.picture()[100, 100], expected, atol=1)

    def test_the_choice_of_component_and_magnitude(self):
        data = values(phantom(), "Scalars")
        vectors = np.stack([0 * data, -data, 0.5 * data], axis=1)
        image = image_of((32, 32, 32), phantom().GetSpacing(), (-1, -1, -1), s=data,
                         v=vectors, m=np.linalg.norm(vectors, axis=1), half=vectors[:, 2])
        for component, same in ((-1, "m"), (2, "half")):
            views = [View(), View()]
            for view, array, chosen in zip(views, ("v", same), (component, 0)):
                mapper = plain_mapper()
                mapper.SelectScalarArray(array)
                mapper.SetScalarModeToUsePointFieldData()
                mapper.SetScalarComponent(chosen)
                view.add(image, phantom_property(), mapper)
                view.look()
            # OpenGL passes on that norms are rounded differently.
            np.testing.assert_allclose(views[0].picture(), views[1].picture(), rtol=0,
                                       atol=1 if DRAW_ON else 0)

    def test_cell_arrays_are_averaged_to_the_points(self):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        cells = np.random.default_rng(1).random((7, 7, 7))
        padded = np.pad(cells, 1, constant_values=np.nan)
        around = [padded[i:i + 8, j:j + 8, k:k + 8]
                  for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        points = np.nanmean(around, axis=0)
        onCells = image_of((8, 8, 8))
        array = numpy_to_vtk(cells.ravel(), deep=1)
        array.SetName("c")
        onCells.GetCellData().SetScalars(array)
        views = [View(), View()]
        for view, image in zip(views, (onCells, image_of((8, 8, 8), c=points.ravel()))):
            view.add(image, phantom_property(), plain_mapper())
            view.look()
        self.assertLess(difference(views[0].picture(), views[1].picture()), 0.01)

    def test_jitter_and_sample_distance_change_little(self):
        view = View()
        mapper = plain_mapper()
        view.add(phantom(64), phantom_property(), mapper)
        view.look()
        reference = view.picture()
        for name, value in (("Jitter", 1), ("SampleDistance", 0.5), ("SampleDistance", 2)):
            getattr(mapper, "Set" + name)(value)
            self.assertLess(difference(view.picture(), reference), 1)


def add_surface(source, color=(0.2, 0.8, 0.2), opacity=1):
    def decorate(view, _):
        view.renderer.AddActor(actor_of(source, color, opacity))
    return decorate


class TestOpaqueGeometry(PictureTest):
    def sphere(self, x, y, z, radius=0.4):
        source = vtkSphereSource()
        source.SetCenter(x, y, z)
        source.SetRadius(radius)
        source.SetThetaResolution(60)
        source.SetPhiResolution(60)
        return add_surface(source)

    def check(self, name, place, camera):
        self.assert_same(self.pictures(phantom(), phantom_property(), camera, place, name=name))

    def test_in_front(self):
        self.check("sphere in front", self.sphere(1.5, 0.9, 1.8), perspective)

    def test_inside(self):
        self.check("sphere inside", self.sphere(0.1, 0.1, 0.2), perspective)
        self.check("sphere inside parallel", self.sphere(0.1, 0.1, 0.2), parallel)

    def test_behind(self):
        self.check("sphere behind", self.sphere(-1.5, -0.9, -1.8), perspective)

    def test_around(self):
        box = vtkCubeSource()
        box.SetBounds(-3, 3, -3, -1.2, -3, 3)
        self.check("floor", add_surface(box), perspective)

    def test_with_multisampling(self):
        view = View()
        view.window.SetMultiSamples(4)
        view.add(phantom(), phantom_property(), plain_mapper())
        self.sphere(0.1, 0.1, 0.2)(view, None)
        view.look()
        smooth = view.picture()
        view = View()
        view.add(phantom(), phantom_property(), plain_mapper())
        self.sphere(0.1, 0.1, 0.2)(view, None)
        view.look()
        self.assertLess(difference(smooth, view.picture()), 1)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Pictures that OpenGL draws against those of the processor, and what happens where OpenGL cannot
# draw. TestEveryScene takes minutes in software; ctest has it among the long tests
# (bash Testing/run.sh --long).

import ctypes
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkRenderingCore import vtkLight

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (LOOKS, View, actor_of, difference, image_of, opacity_of, phantom, phantom_property,
                          save, scene, sphere)

# Both round colours to 8 bits. Missed structures are painted over rounded colours on the processor.
MOST = 1
MOST_PAINTED = 2

BASE, SHADED, OPTIMIZED, SHADOWS, MISSED = LOOKS.values()


class DrawingTest(MapperTest):
    def pictures(self, image=None, volume_property=None, prepare=None, **properties):
        """Of the processor and of OpenGL."""
        pictures = []
        for device in (Mapper.PROCESSOR, Mapper.OPENGL):
            view, mapper = show(image, volume_property, **properties)
            mapper.SetDrawOn(device)
            if prepare:
                prepare(view, mapper)
            pictures.append(view.picture())
            self.assertNotIn("DrawOn", "".join(view.messages))
            self.assertIn("OpenGL" if device == Mapper.OPENGL else "CPU",
                          mapper.GetDrawnBy())
        self.assertGreater(pictures[0].std(), 3)  # there is something in it
        return pictures

    def check(self, *arguments, most=MOST, name=None, **properties):
        processor, graphics = self.pictures(*arguments, **properties)
        if name:
            save(np.concatenate((processor, graphics), axis=1), name)
        self.assertLessEqual(np.abs(processor - graphics).max(), most)


class TestPictures(DrawingTest):
    def test_looks(self):
        for name, properties in LOOKS.items():
            with self.subTest(look=name):
                self.check(most=MOST_PAINTED if "ShowMissed" in properties else MOST, name=name,
                           **properties)

    def test_cameras(self):
        def parallel(view, _):
            view.camera.ParallelProjectionOn()
            view.camera.SetParallelScale(0.4)

        def inside(view, _):
            view.camera.SetPosition(0.1, 0.2, 0.3)
            view.camera.SetFocalPoint(0, 0, 0)
            view.renderer.ResetCameraClippingRange()

        def far_range(view, _):
            view.camera.SetClippingRange(1e-3, 1e6)

        def cut_range(view, _):
            near, far = view.camera.GetClippingRange()
            view.camera.SetClippingRange(near + 0.4 * (far - near), near + 0.7 * (far - near))

        def off_axis(view, _):
            view.camera.SetWindowCenter(0.3, -0.2)

        for prepare in (parallel, inside, far_range, cut_range, off_axis):
            with self.subTest(camera=prepare.__name__):
                self.check(prepare=prepare, **SHADOWS)

    def test_lights(self):
        def near(view, _):
            light = vtkLight()
            light.SetPositional(True)
            light.SetPosition(0.4, 0.5, 0.6)
            view.renderer.AddLight(light)

        for prepare in (None, near):
            for name, value in (("Anisotropy", -0.5), ("Specular", 0), ("SpecularPower", 3),
                                ("Ambient", 0), ("LightIntensity", 1.5), ("ShadowStrength", 1)):
                with self.subTest(light=prepare and prepare.__name__, property=name):
                    self.check(prepare=prepare, **{name: value}, **SHADED)

    def test_samples(self):
        for name, value in (("SampleDistance", 0.3), ("SampleDistance", 2.5), ("Jitter", 1)):
            with self.subTest(property=name, value=value):
                self.check(**{name: value}, **SHADOWS)

    def test_cropping_and_clipping(self):
        def cropped(_, mapper):
            mapper.CroppingOn()
            mapper.SetCroppingRegionPlanes(-0.3, 0.4, -0.2, 0.5, -0.5, 0.1)

        def clipped(_, mapper):
            plane = vtkPlane()
            plane.SetNormal(1, 0.5, -0.3)
            plane.SetOrigin(0.1, 0, 0)
            mapper.AddClippingPlane(plane)

        for prepare in (cropped, clipped):
            with self.subTest(by=prepare.__name__):
                self.check(prepare=prepare, **SHADOWS)

    def test_turned_and_stretched_images(self):
        image = phantom()
        image.SetSpacing(*(np.array(image.GetSpacing()) * (1, 2, 0.5)))
        turn = np.radians(30)
        image.SetDirectionMatrix(np.cos(turn), -np.sin(turn), 0, np.sin(turn), np.cos(turn), 0,
                                 0, 0, 1)
        self.check(image, **MISSED, most=MOST_PAINTED)

    def test_empty_points(self):
        image = phantom()
        values = np.array(image.GetPointData().GetScalars())
        values[::7] = np.nan
        image.GetPointData().SetScalars(numpy_to_vtk(values, deep=1))
        self.check(image, **SHADOWS)

    def test_opaque_and_translucent_geometry(self):
        for opacity in (1, 0.4):
            def put_a_ball(view, _, opacity=opacity):
                view.renderer.AddActor(actor_of(sphere((0.1, 0, 0.2), 0.3), opacity=opacity))
                view.renderer.UseDepthPeelingOn()
                view.renderer.UseDepthPeelingForVolumesOn()

            with self.subTest(opacity=opacity):
                # Two parts of rays, each rounded and painted.
                self.check(prepare=put_a_ball, **MISSED, most=2 * MOST_PAINTED)

    def test_narrow_functions(self):
        peak = phantom_property()
        peak.SetScalarOpacity(opacity_of((0.4, 0), (0.4001, 0.9), (0.4002, 0)))
        self.check(None, peak, **SHADED)

    def test_integers_of_many_values(self):
        random = np.random.default_rng(1)
        values = random.integers(0, 65536, 24 ** 3).astype(np.uint16)
        wide = phantom_property()
        wide.SetScalarOpacity(opacity_of((0, 0), (65535, 0.5)))
        image = image_of((24, 24, 24), (0.04, 0.04, 0.04), (-0.5, -0.5, -0.5), s=values)
        self.check(image, wide, **SHADED)


class TestChoice(DrawingTest):
    def test_auto_leaves_software_alone_and_says_so(self):
        view, mapper = show()
        view.picture()
        self.assertIn("OpenGL is software", mapper.GetDrawnBy())
        self.assertEqual(mapper.GetUploadedBytes(), 0)
        self.assert_fine(view)

    def test_cuda_is_said_to_be_missing(self):
        view, mapper = show(DrawOn=Mapper.CUDA)
        view.picture()
        self.assert_says(view, "DrawOn is CUDA", "CPU")

    def test_methods_that_need_the_processor(self):
        view, mapper = show(DrawOn=Mapper.OPENGL, Method=Mapper.VIOLA_2004)
        picture = view.picture()
        self.assert_says(view, "DrawOn is OpenGL", "importance", "CPU draws")
        mapper.SetDrawOn(Mapper.PROCESSOR)
        self.assertEqual(difference(picture, view.picture()), 0)

    def test_volumes_longer_than_textures(self):
        length = 20000
        image = image_of((length, 2, 2), (1 / length, 0.1, 0.1), (-0.5, 0, 0),
                         s=np.linspace(0, 1, 4 * length).astype(np.float32))
        view, mapper = show(image, DrawOn=Mapper.OPENGL, **BASE)
        picture = view.picture()
        self.assert_says(view, "DrawOn is OpenGL", "20000 x 2 x 2", "at most", "CPU draws")
        self.assertGreater(picture.std(), 1)

    def test_follows_the_renderer_into_another_window(self):
        view, mapper = show(DrawOn=Mapper.OPENGL)
        picture = view.picture()
        view.window.RemoveRenderer(view.renderer)
        other = View(view.window.GetSize())
        view.window = other.window
        view.window.RemoveRenderer(other.renderer)
        view.window.AddRenderer(view.renderer)
        self.assertEqual(difference(picture, view.picture()), 0)
        self.assertIn("OpenGL", mapper.GetDrawnBy())
        self.assert_fine(view)

    def test_pictures_can_be_made_again(self):
        view, mapper = show(DrawOn=Mapper.OPENGL)
        self.assert_made_again(view, mapper)
        self.assertIn("OpenGL", mapper.GetDrawnBy())


class TestUploads(DrawingTest):
    def uploaded(self, view, mapper):
        view.window.Render()
        return mapper.GetUploadedBytes()

    def test_only_what_has_changed(self):
        view, mapper = show(phantom(64), DrawOn=Mapper.OPENGL, **SHADOWS)
        nodes = 64 ** 3
        self.assertGreater(self.uploaded(view, mapper), 16 * nodes)  # the first
        self.assertEqual(self.uploaded(view, mapper), 0)  # at rest
        mapper.PauseOptimizationOn()
        mapper.SetLightSource(Mapper.OWN)
        mapper.SetLightType(1)
        mapper.SetLightPosition(2, 3, 4)
        view.window.Render()
        view.camera.Azimuth(20)
        self.assertEqual(self.uploaded(view, mapper), 0)  # a turn
        mapper.PauseOptimizationOff()
        step = self.uploaded(view, mapper)  # extinction and shadows
        self.assertGreater(step, 0)
        self.assertLessEqual(step, 4 * nodes + (64 // 4) ** 3)

    def test_added_extinction_is_drawn(self):
        self.check(Emphasis=1, **SHADOWS)


class TestPretended(DrawingTest):
    """Graphics cards and failures. Run with LD_PRELOAD naming the library of PretendedGl.cxx."""

    def setUp(self):
        self.gl = ctypes.CDLL(None)
        if not hasattr(self.gl, "limpid_fail_gl"):
            self.skipTest("OpenGL is what it is here: see PretendedGl.cxx")
        self.gl.limpid_pretend_card(1)
        view, mapper = show(size=(8, 8), **BASE)
        view.picture()
        self.gl.limpid_pretend_card(0)
        if "A card" not in mapper.GetDrawnBy():
            self.skipTest("VTK finds OpenGL past what is preloaded (from 9.4 on)")

    def tearDown(self):
        self.gl.limpid_fail_gl(0)
        self.gl.limpid_pretend_card(0)

    def test_auto_takes_a_card(self):
        self.gl.limpid_pretend_card(1)
        view, mapper = show(**MISSED)
        picture = view.picture()
        self.assertEqual(mapper.GetDrawnBy(), "OpenGL, A card")
        mapper.SetMethod(Mapper.VIOLA_2004)
        view.window.Render()
        self.assertIn("importance", mapper.GetDrawnBy())
        self.assert_fine(view)
        mapper.SetMethod(Mapper.OPTIMIZED)
        self.gl.limpid_pretend_card(0)
        mapper.ReleaseMemory()
        view.camera.Azimuth(1e-3)  # else the finished picture would be shown again
        processor = view.picture()
        self.assertIn("CPU", mapper.GetDrawnBy())
        self.assertLessEqual(np.abs(picture - processor).max(), MOST_PAINTED)

    def test_a_card_draws_all_pixels_of_moving_frames(self):
        self.gl.limpid_pretend_card(1)
        view, mapper = show(size=(60, 60), InteractiveFrameTime=1)
        still = view.picture()
        mapper.PauseOptimizationOn()
        view.interact(True)
        self.assertLess(difference(still, view.picture()), 1)

    def test_wherever_opengl_fails_the_processor_draws(self):
        processor, _ = self.pictures(**MISSED)
        left = 0
        for question in range(1, 1000):
            view, mapper = show(DrawOn=Mapper.OPENGL, **MISSED)
            self.gl.limpid_fail_gl(question)
            picture = view.picture()
            if not self.gl.limpid_gl_has_failed():
                break
            self.assertLessEqual(np.abs(picture - processor).max(), MOST_PAINTED)
            if mapper.GetDrawnBy().startswith("CPU"):
                left += 1
                self.assert_says(view, "OpenGL could not store", "out of memory", "CPU draws")
        self.assertGreater(left, 15)  # every other question forgets errors of others

    def test_it_is_tried_again_when_asked_for(self):
        view, mapper = show(DrawOn=Mapper.OPENGL)
        for question in range(1, 1000):
            mapper.ReleaseMemory()
            view.camera.Azimuth(1e-3)  # else the finished picture would be shown again
            self.gl.limpid_fail_gl(question)
            view.window.Render()
            if mapper.GetDrawnBy().startswith("CPU"):
                break
        mapper.SetDrawOn(Mapper.PROCESSOR)
        view.window.Render()
        mapper.SetDrawOn(Mapper.OPENGL)
        view.window.Render()
        self.assertIn("OpenGL", mapper.GetDrawnBy())


class TestEveryScene(DrawingTest):
    """The bars: a mean difference of 0.6 of 255, and 99.9 % of the pixels within 4."""

    def check_scene(self, name):
        found = scene(name)
        if not found:
            self.skipTest(f"the scene {name} is not here: set LIMPID_TEST_DATA")
        image, volume_property, importance = found
        for look, properties in LOOKS.items():
            processor, graphics = self.pictures(
                image, volume_property, size=(300, 300), UseImportanceFunction=1,
                ImportanceFunction=importance, **properties)
            apart = np.abs(processor - graphics)
            print(f"{name}, {look}: mean {apart.mean():.4f}, "
                  f"{(apart.max(axis=2) > 4).mean():.5f} above 4, largest {apart.max():.0f}")
            with self.subTest(look=look):
                self.assertLessEqual(apart.mean(), 0.6)
                self.assertLessEqual((apart.max(axis=2) > 4).mean(), 1e-3)


def check_of(name):
    return lambda self: self.check_scene(name)


for _name in ("carotid_mra", "engine", "isabel_wind", "skull_phantom", "thorax_ct", "visible_male",
              "vortex_rings"):
    setattr(TestEveryScene, "test_" + _name, check_of(_name))


if __name__ == "__main__":
    unittest.main()

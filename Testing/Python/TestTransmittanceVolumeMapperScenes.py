# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper's pictures of the test scenes: without optimization and light against VTK's own volume
# mappers, and how bright shadows leave them. TestEveryScene takes two minutes; ctest has it among
# the long tests (bash Testing/run.sh --long).

import unittest

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLightKit

from limpid.vtkLimpidFilters import vtkOcclusionPhantom
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from volume_views import (View, difference, fixed_point_mapper, gpu_mapper, phantom_property,
                          plain_mapper, save, scene)

BAR = 1.5  # mean absolute difference of 8-bit values

SCENES = ("carotid_mra", "isabel_wind", "engine", "visible_male")
MORE_SCENES = ("skull_phantom", "thorax_ct", "vortex_rings")


def look(view, bounds, direction, distance, angle=30.0):
    """At the middle of a box, from so many radii away."""
    middle = bounds.mean(1)
    radius = np.linalg.norm(bounds[:, 1] - bounds[:, 0]) / 2
    place = middle + distance * radius * np.array(direction) / np.linalg.norm(direction)
    view.camera.SetFocalPoint(*middle)
    view.camera.SetPosition(*place)
    view.camera.SetViewUp(0, 1, 0)
    view.camera.SetViewAngle(angle)
    view.camera.SetParallelScale(0.7 * radius)
    view.renderer.ResetCameraClippingRange()


def far(view, bounds):
    look(view, bounds, (0.5, 0.4, 1), 4)


def near(view, bounds):
    look(view, bounds, (-1, 0.3, 0.6), 1.3, 50)


def parallel(view, bounds):
    view.camera.ParallelProjectionOn()
    look(view, bounds, (0.7, -0.5, -0.6), 4)


class SceneTest(unittest.TestCase):
    def scene(self, name):
        found = scene(name)
        if not found:
            self.skipTest(f"the scene {name} is not here: set LIMPID_TEST_DATA")
        return found


class TestAgainstVtk(SceneTest):
    """All with samples as far apart as the voxels along the axis where they are closest."""

    def check(self, name):
        image, volume_property, _ = self.scene(name)
        bounds = np.array(image.GetBounds()).reshape(3, 2)
        step = min(image.GetSpacing())
        for place in (far, near, parallel):
            pictures = []
            for mapper in (plain_mapper(), fixed_point_mapper(step), gpu_mapper(step)):
                view = View((300, 300))
                view.add(image, volume_property, mapper)
                place(view, bounds)
                pictures.append(view.picture())
            save(np.concatenate(pictures, axis=1), f"{name} {place.__name__}")
            self.assertGreater(pictures[0].std(), 3)  # there is something in it
            apart = [difference(pictures[0], picture) for picture in pictures[1:]]
            print(f"{name}, {place.__name__}: fixed point {apart[0]:.2f}, GPU {apart[1]:.2f}, "
                  f"from each other {difference(*pictures[1:]):.2f} of 255")
            with self.subTest(camera=place.__name__):
                self.assertLess(max(apart), BAR)

    def test_carotid_mra(self):
        self.check("carotid_mra")

    def test_isabel_wind(self):
        self.check("isabel_wind")

    def test_engine(self):
        self.check("engine")

    def test_visible_male(self):
        self.check("visible_male")


class TestEveryScene(SceneTest):
    # Where the transfer function changes much from voxel to voxel, samples as far apart as voxels
    # leave VTK's pictures with rings, and the two up to 3 of 255 from each other. What a picture
    # should be is what it is with ten samples per voxel.
    def test_is_nearer_to_what_it_should_be_than_vtks_pictures_and_within_the_bar(self):
        for name in SCENES + MORE_SCENES:
            image, volume_property, _ = self.scene(name)
            bounds = np.array(image.GetBounds()).reshape(3, 2)
            step = min(image.GetSpacing())
            for place in (far, near, parallel):
                pictures = {}
                for key, mapper in (("reference", gpu_mapper(0.1 * step)),
                                    ("ours", plain_mapper(0.5)),
                                    ("fixed point", fixed_point_mapper(0.5 * step)),
                                    ("GPU", gpu_mapper(0.5 * step))):
                    view = View((300, 300))
                    view.add(image, volume_property, mapper)
                    place(view, bounds)
                    pictures[key] = view.picture()
                error = {key: difference(picture, pictures["reference"])
                         for key, picture in pictures.items()}
                print(f"{name}, {place.__name__}: errors of ours {error['ours']:.2f}, of fixed "
                      f"point {error['fixed point']:.2f}, of GPU {error['GPU']:.2f} of 255")
                with self.subTest(scene=name, camera=place.__name__):
                    self.assertLess(error["ours"], BAR)
                    self.assertLess(error["ours"], error["fixed point"])


class TestBrightness(SceneTest):
    """Shadows leave three quarters of the light of pixels that show the volume, at least."""

    def brightness(self, image, volume_property, importance, light_kit):
        mapper = Mapper()
        if importance:
            mapper.UseImportanceFunctionOn()
            mapper.SetImportanceFunction(importance)
        view = View((160, 160))
        view.renderer.SetBackground(0, 0, 0)
        if light_kit:
            view.renderer.AutomaticLightCreationOff()
            vtkLightKit().AddLightsToRenderer(view.renderer)
        view.add(image, volume_property, mapper)
        view.look()
        pictures = {}
        for name, shadows, shade in (("unlit", 0, 0), ("shaded", 0, 1), ("shadows", 1, 1)):
            mapper.SetShadows(shadows)
            volume_property.SetShade(shade)
            pictures[name] = view.picture()
        volume_property.ShadeOff()
        covered = pictures["unlit"].max(axis=2) > 1
        return {name: picture[covered].mean() for name, picture in pictures.items()}

    def check(self, name, *scene):
        for light_kit in (False, True):
            light = self.brightness(*scene, light_kit)
            print(f"{name}, {'light kit' if light_kit else 'headlight'}: shadows "
                  f"{light['shadows'] / light['unlit']:.2f} of unlit, "
                  f"{light['shadows'] / light['shaded']:.2f} of shaded")
            with self.subTest(scene=name, light_kit=light_kit):
                self.assertGreater(light["shadows"], 0.75 * light["unlit"])
                self.assertGreater(light["shadows"], 0.75 * light["shaded"])

    def test_of_the_phantoms(self):
        source = vtkOcclusionPhantom()
        source.SetResolution(48)
        for number in range(4):
            source.SetScene(number)
            source.Update()
            source.GetOutput().GetPointData().SetActiveScalars("Scalars")
            self.check(f"phantom {number}", source.GetOutput(), phantom_property(), None)

    def test_of_the_scenes(self):
        for name in SCENES:
            self.check(name, *self.scene(name))


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The head that all renderers draw: the phantom, its functions, camera and light of
Documentation/Examples/scenes.py, in a window of its own."""

import math
import os
import sys
import time

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLight

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..", "..")
sys.path += [os.path.join(ROOT, "Testing", "Python"),
             os.path.join(ROOT, "Documentation", "Examples")]
import images  # noqa: E402 pylint: disable=wrong-import-position
import scenes  # noqa: E402 pylint: disable=wrong-import-position
import volume_views  # noqa: E402 pylint: disable=wrong-import-position

STEP = 1.0  # of all rays [voxels]


class NoSource:
    """What makes ParaView's sources; the example's has another resolution."""

    @staticmethod
    def OcclusionPhantom(**_):  # pylint: disable=invalid-name; ParaView's
        return None


class Head:
    """Drawn by one mapper of VTK at a time."""

    def __init__(self, nodes, size):
        self.scene = scenes.phantom_scene(NoSource)
        self.nodes, self.size = nodes, size
        self.image = images.phantom(nodes)
        self.image.GetPointData().SetActiveScalars("Scalars")
        self.spacing = self.image.GetSpacing()[0]
        self.view = volume_views.View((size, size))
        self.view.renderer.SetBackground(0, 0, 0)
        self.view.renderer.AutomaticLightCreationOff()
        self.opacity = volume_views.opacity_of(*self.scene.opacity())
        self.volume = self.view.add(self.image, self.colored(*self.scene.colors),
                                    volume_views.plain_mapper())
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPositional(True)
        self.light.SetConeAngle(180)
        self.light.SetFocalPoint(self.scene.focal_point)
        self.view.renderer.AddLight(self.light)
        self.look()

    def colored(self, *colors):
        return volume_views.property_of(volume_views.colors_of(*colors), self.opacity,
                                        self.scene.unit_distance())

    def extinction(self):
        """Of the transfer function at the nodes [1/length], indices (x, y, z)."""
        scalars = images.values(self.image, "Scalars").astype(float)
        field = np.interp(scalars, *np.transpose(self.scene.extinction))
        return field.reshape((self.nodes,) * 3).transpose(2, 1, 0).astype(np.float32)

    def look(self, degrees=0.0, light_degrees=None):
        """Turns the camera about the vertical, and with it the light unless that has an angle."""
        camera = self.view.camera
        camera.SetPosition(turned(self.scene.position, degrees))
        camera.SetFocalPoint(self.scene.focal_point)
        camera.SetViewUp(self.scene.view_up)
        camera.SetViewAngle(self.scene.view_angle)
        self.light.SetPosition(turned(self.scene.light,
                                      degrees if light_degrees is None else light_degrees))
        self.view.renderer.ResetCameraClippingRange()

    def draw(self, mapper, shade=False, moving=False):
        """Draws a frame; returns the seconds that it took, and those of all cores together."""
        self.volume.SetVisibility(mapper is not None)
        if mapper is not None:
            mapper.SetInputData(self.image)
            self.volume.SetMapper(mapper)
        self.volume.GetProperty().SetShade(shade)
        self.view.interact(moving)
        start, cores = time.perf_counter(), time.process_time()
        self.view.window.Render()
        self.view.window.WaitForCompletion()
        return time.perf_counter() - start, time.process_time() - cores

    def picture(self):
        """Of the last frame: rows from the top, colours from 0 to 255."""
        return self.view.pixels()[::-1]


def turned(point, degrees):
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1], point[2]]

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The head that all renderers draw: the phantom, its functions, camera and light of
Documentation/Examples/scenes.py, in a window of its own."""

import math
import os
import sys
import time

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight

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
        self.plain = self.image.NewInstance()  # without importance nothing is scored
        self.plain.ShallowCopy(self.image)
        self.plain.GetPointData().RemoveArray("Importance")
        self.spacing = self.image.GetSpacing()[0]
        self.opacity = volume_views.opacity_of(*self.scene.opacity())
        self.colors = self.scene.colors
        self.camera = vtkCamera()
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPositional(True)
        self.light.SetConeAngle(180)
        self.light.SetFocalPoint(self.scene.focal_point)
        self.views = {}  # by how the head is drawn
        self.drawn = None  # the view that was drawn last
        self.look()

    def view_of(self, mapper, shade, density):
        """One for every way to draw it: what stays from picture to picture is not made again."""
        key = (mapper, shade, density)
        if key not in self.views:
            view = volume_views.View((self.size, self.size))
            view.renderer.SetBackground(0, 0, 0)
            view.renderer.AutomaticLightCreationOff()
            view.renderer.SetActiveCamera(self.camera)
            view.renderer.AddLight(self.light)
            if mapper is not None:
                colored = volume_views.property_of(
                    volume_views.colors_of(*self.colors), self.opacity,
                    self.scene.unit_distance() / density)
                colored.SetShade(shade)
                view.add(self.image if optimizes(mapper) else self.plain, colored, mapper)
            self.views[key] = view
        return self.views[key]

    def extinction(self):
        """Of the transfer function at the nodes [1/length], indices (x, y, z)."""
        scalars = images.values(self.image, "Scalars").astype(float)
        field = np.interp(scalars, *np.transpose(self.scene.extinction))
        return field.reshape((self.nodes,) * 3).transpose(2, 1, 0).astype(np.float32)

    def look(self, degrees=0.0, light_degrees=None):
        """Turns the camera about the vertical, and with it the light unless that has an angle."""
        camera = self.camera
        camera.SetPosition(turned(self.scene.position, degrees))
        camera.SetFocalPoint(self.scene.focal_point)
        camera.SetViewUp(self.scene.view_up)
        camera.SetViewAngle(self.scene.view_angle)
        self.light.SetPosition(turned(self.scene.light,
                                      degrees if light_degrees is None else light_degrees))

    def draw(self, mapper, shade=False, moving=False, density=1):
        """Draws a frame, of the volume `density` times as dense; returns the seconds that it took,
        and those of all cores together. Without a mapper: an empty window."""
        self.drawn = self.view_of(mapper, shade, density)
        self.drawn.interact(moving)
        self.drawn.renderer.ResetCameraClippingRange()
        start, cores = time.perf_counter(), time.process_time()
        self.drawn.window.Render()
        self.drawn.window.WaitForCompletion()
        return time.perf_counter() - start, time.process_time() - cores

    def picture(self):
        """Of the last frame: rows from the top, colours from 0 to 255."""
        return self.drawn.pixels()[::-1]


def optimizes(mapper):
    return (isinstance(mapper, volume_views.vtkTransmittanceVolumeMapper) and
            mapper.GetOptimization() != mapper.OFF)


def turned(point, degrees):
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1], point[2]]

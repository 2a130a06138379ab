# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A still picture is the same whatever was shown before: other images, functions, cameras, lights and
# settings, at rest, on the move, step by step, hidden, reset, paused.
#   python3 TestTransmittanceVolumeMapperSequences.py FIRST COUNT    goes through other sequences

import random
import sys
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

import images
from volume_views import View, phantom_property

FUNCTIONS = (((0, 0), (0.2, 0.02), (1, 0.2)), ((0, 0), (0.5, 0.3), (1, 0.02)))


def make_images():
    made = [images.phantom(resolution, scene) for resolution, scene in ((12, 0), (12, 1), (16, 0))]
    made.append(images.phantom(12, 0))
    made[-1].SetSpacing(0.1, 0.2, 0.15)
    for image in made:
        image.GetPointData().SetActiveScalars("Scalars")
    return made


def random_state(choose):
    """Everything that a picture depends on."""
    return {
        "image": choose.choice((0, 0, 1, 2, 3)), "function": choose.choice((0, 0, 1)),
        "azimuth": choose.choice((0, 10, 35, 45, 90, choose.uniform(0, 360))),
        "elevation": choose.choice((0, 20, choose.uniform(-80, 80))),
        "zoom": choose.choice((1, 1.6, 3)), "parallel": choose.random() < 0.2,
        "size": choose.choice(((90, 70), (60, 60))), "shade": choose.random() < 0.6,
        "clip": choose.choice((None, None, 0.1)), "light": choose.choice(("head",) * 3 + ("scene", "camera")),
        "ball": choose.random() < 0.2,
        "Optimization": choose.choice((Mapper.OFF,) + 4 * (Mapper.CONTINUOUS,)),
        "Mode": choose.choice((0, 0, 1)), "Solver": choose.choice((0, 0, 1)),
        "MaximumIterations": choose.choice((0, 2, 8)), "IterationsPerLevel": (3, 2, 2),
        "SkipUnneeded": choose.choice((0, 1)), "RestrictToView": choose.choice((0, 0, 1)),
        "ProtectImportance": choose.choice((0.0, 0.0, 0.6, 1.0)),
        "Emphasis": choose.choice((0.0, 0.0, 0.5, 1.0)),
        "ViewWeight": choose.choice((10.0, 1000.0)), "LightWeight": choose.choice((0.0, 1.0)),
        "LightSource": choose.choice((0, 1)), "LightType": choose.choice((0, 1)),
        "LightPosition": (choose.choice((1.0, 5.0)), 2.0, 3.0), "Shadows": choose.choice((0, 1, 1)),
        "Jitter": choose.choice((0, 1)), "SampleDistance": choose.choice((1.0, 0.5)),
        "ShowMissed": choose.choice((0, 0, 1))}


class Stage:
    """A view that can be brought into any state."""

    def __init__(self, all_images):
        self.images = all_images
        self.view = View()
        self.mapper = Mapper()
        self.mapper.SetTemporalCoherence(0)  # else what was seen from nearby may leave one
        self.property = phantom_property()
        self.volume = self.view.add(all_images[0], self.property, self.mapper)
        self.light = vtkLight()
        ball = vtkSphereSource()
        ball.SetRadius(0.3)
        ball.SetCenter(0.5, 0, 0)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(ball.GetOutputPort())
        self.ball = vtkActor()
        self.ball.SetMapper(mapper)
        self.view.renderer.AddActor(self.ball)

    def set(self, state):
        self.view.window.SetSize(*state["size"])
        self.mapper.SetInputData(self.images[state["image"]])
        opacity = self.property.GetScalarOpacity()
        opacity.RemoveAllPoints()
        for position, value in FUNCTIONS[state["function"]]:
            opacity.AddPoint(position, value)
        self.property.SetShade(state["shade"])
        for name, value in state.items():
            if name[0].isupper():
                getattr(self.mapper, "Set" + name)(value)
        self.mapper.RemoveAllClippingPlanes()
        if state["clip"] is not None:
            plane = vtkPlane()
            plane.SetNormal(1, 0.3, 0.2)
            plane.SetOrigin(state["clip"], 0, 0)
            self.mapper.AddClippingPlane(plane)
        self.ball.SetVisibility(state["ball"])
        self.set_light(state["light"])
        self.set_camera(state)

    def set_light(self, kind):
        renderer = self.view.renderer
        renderer.RemoveAllLights()
        if kind == "head":
            renderer.CreateLight()
            return
        kind == "scene" and self.light.SetLightTypeToSceneLight()
        kind == "camera" and self.light.SetLightTypeToCameraLight()
        self.light.SetPosition(*((3, 4, 5) if kind == "scene" else (1, 1, 1)))
        renderer.AddLight(self.light)

    def set_camera(self, state):
        camera, box = self.view.camera, (-1, 1, -1, 1, -1, 1)
        camera.SetParallelProjection(state["parallel"])
        camera.SetPosition(0, 0, 1)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewUp(0, 1, 0)
        camera.SetViewAngle(30)
        self.view.renderer.ResetCamera(box)
        camera.Azimuth(state["azimuth"])
        camera.Elevation(state["elevation"])
        camera.OrthogonalizeViewUp()
        camera.Zoom(state["zoom"])
        self.view.renderer.ResetCameraClippingRange(box)

    def still(self):
        self.view.interact(False)
        self.mapper.ProgressiveStillOff()
        return self.view.picture()

    def do_anything(self, choose):
        """Something that may happen between two pictures."""
        what = choose.choice(("still", "move", "steps", "release", "reset", "hide", "pause"))
        if what == "move":
            self.view.interact(True)
            self.mapper.SetInteractiveFrameTime(choose.choice((0.01, 0.1)))
            self.mapper.SetEaseTime(choose.choice((0, 0.3)))
            self.view.window.Render()
            self.view.window.Render()
        elif what == "steps":
            self.view.interact(False)
            self.mapper.ProgressiveStillOn()
            self.mapper.SetEaseTime(0.1)
            for _ in range(choose.randint(1, 4)):
                self.view.window.Render()
        else:
            self.still()
        if what == "release":
            self.mapper.ReleaseMemory()
        elif what == "reset":
            self.mapper.Reset()
        elif what == "hide":
            self.volume.VisibilityOff()
            self.view.window.Render()
            self.volume.VisibilityOn()
        elif what == "pause":
            self.mapper.PauseOptimizationOn()
            self.view.camera.Azimuth(20)
            self.still()
            self.mapper.PauseOptimizationOff()


def states_of(choose):
    """Mostly, only some of it changes."""
    states = [random_state(choose)]
    for _ in range(choose.randint(1, 5)):
        other = random_state(choose)
        share = choose.choice((0.2, 0.2, 0.2, 1))
        states.append({name: other[name] if choose.random() < share else value
                       for name, value in states[-1].items()})
    return states


def difference_of(number, all_images):
    """The largest difference of a channel after a sequence and without it."""
    choose = random.Random(number)
    states = states_of(choose)
    stage, fresh = Stage(all_images), Stage(all_images)
    for state in states[:-1]:
        stage.set(state)
        stage.do_anything(choose)
    for either in (stage, fresh):
        either.set(states[-1])
    different = np.abs(stage.still() - fresh.still()).max()
    for either in (stage, fresh):
        either.view.window.Finalize()
    return different


class TestSequences(unittest.TestCase):
    def test_leave_no_trace_in_a_still_picture(self):
        all_images = make_images()
        for number in range(60):
            self.assertEqual(difference_of(number, all_images), 0, number)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        first, count = int(sys.argv[1]), int(sys.argv[2])
        several = make_images()
        found = {number: difference_of(number, several) for number in range(first, first + count)}
        print({number: most for number, most in found.items() if most > 0}, "of", count)
    else:
        unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The way of a camera over the sphere of a search: cameras, evenness, time.

import re
import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import (vtkDataObject, vtkImageData, vtkMultiBlockDataSet,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline, vtkTrivialProducer
from vtkmodules.vtkFiltersSources import vtkSphereSource

from limpid.vtkLimpidFilters import vtkCameraPath, vtkViewpointSearch

from images import FilterTest, caught, filter_on, image_of, phantom, values


def search(image, **properties):
    return filter_on(image, vtkViewpointSearch, NumberOfDirections=162, Refine=0, **properties)


def path_of(searched, **properties):
    path = vtkCameraPath()
    path.messages = {"ErrorEvent": caught(path, "ErrorEvent")}
    path.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    for name, value in properties.items():
        getattr(path, "Set" + name)(value)
    path.SetInputConnection(searched.GetOutputPort())
    return path


def angles(vectors, closed):
    """Between consecutive unit vectors [degrees]."""
    following = np.roll(vectors, -1, axis=0) if closed else vectors[1:]
    vectors = vectors if closed else vectors[:-1]
    return np.degrees(np.arccos(np.clip((vectors * following).sum(axis=1), -1, 1)))


class Moving(VTKPythonAlgorithmBase):
    """An important ball that goes round with time within another one."""

    def __init__(self, steps, without=(), announces=False):
        """`without`: time steps that have no array Importance; `announces`: the whole extent of
        each time step, not that of the first alone."""
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.steps = steps
        self.without = without
        self.announces = announces
        self.points = lambda time: 16  # along an axis
        self.asked = []

    def RequestInformation(self, _, __, output):
        info = output.GetInformationObject(0)
        pipeline = vtkStreamingDemandDrivenPipeline
        info.Set(pipeline.TIME_STEPS(), [float(step) for step in range(self.steps)], self.steps)
        info.Set(pipeline.TIME_RANGE(), [0.0, self.steps - 1.0], 2)
        info.Set(pipeline.WHOLE_EXTENT(), (0, 15, 0, 15, 0, 15), 6)
        return 1

    def RequestData(self, _, __, output):
        info = output.GetInformationObject(0)
        time = info.Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        self.asked.append(time)
        angle = 1.5 * time / self.steps
        points = self.points(time)
        z, y, x = np.meshgrid(*3 * [np.linspace(-1, 1, points)], indexing="ij")
        important = (x - 0.6 * np.cos(angle)) ** 2 + y ** 2 + (z - 0.6 * np.sin(angle)) ** 2 < 0.09
        base = np.where(important, 3, np.where(x ** 2 + y ** 2 + z ** 2 < 1, 1.5, 0))
        image = image_of(3 * (points,), spacing=3 * (2 / (points - 1),), origin=3 * (-1,),
                         BaseExtinction=base.ravel(), Importance=important.astype(float).ravel())
        if time in self.without:
            image.GetPointData().RemoveArray("Importance")
        if self.announces:
            info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), image.GetExtent(), 6)
        info.Get(vtkDataObject.DATA_OBJECT()).ShallowCopy(image)
        return 1


def search_through_time(source):
    searched = vtkViewpointSearch()
    searched.messages = {"ErrorEvent": caught(searched, "ErrorEvent")}
    searched.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    searched.SetInputConnection(source.GetOutputPort())
    searched.SetNumberOfDirections(162)
    searched.RefineOff()
    searched.SetExtinctionSource(vtkViewpointSearch.ARRAY)
    searched.SetField(vtkViewpointSearch.BASE_EXTINCTION)
    return searched


class TestCameraPath(FilterTest):
    def test_a_round_trip_is_even_and_upright_and_shows_much(self):
        searched = search(phantom(20), CameraViewUp=(0, 0, 1))
        path = path_of(searched, NumberOfKeyViews=3, NumberOfFrames=90)
        path.Update()
        self.assert_no_error(path)

        output = path.GetOutput()
        self.assertEqual((output.GetNumberOfPoints(), output.GetNumberOfLines()), (90, 1))
        directions = values(output, "ViewDirection")
        turns = angles(directions, True)
        self.assertLess(turns.max(), 1.2 * turns.min() + 1e-6)
        self.assertTrue((np.abs(directions[:, 2]) <= np.sin(np.radians(75)) + 1e-9).all())
        ups = values(output, "CameraViewUp")
        np.testing.assert_allclose((ups * directions).sum(axis=1), 0, atol=1e-9)
        sideways = np.cross((0, 0, 1), directions)  # no roll: up is above
        np.testing.assert_allclose((ups * sideways).sum(axis=1), 0, atol=1e-9)
        positions = values(output, "CameraPosition")  # at one distance, whatever the direction
        np.testing.assert_allclose(positions, np.linalg.norm(positions[0]) * directions)
        scores = values(searched.GetOutput(), "VisibilityScore")
        found = values(output, "VisibilityScore")
        keys = values(output, "KeyView") == 1
        self.assertEqual(keys.sum(), 3)
        self.assertGreaterEqual(found[keys].max(), 0.89 * scores.max())
        self.assertGreater(found.mean(), scores.mean())
        self.assertEqual(output.GetFieldData().GetArray("CameraViewAngle").GetValue(0), 30)

    def test_through_time_it_follows_what_can_be_seen(self):
        source = Moving(12)
        searched = search_through_time(source)
        path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
        path.Update()
        self.assert_no_error(path)

        output = path.GetOutput()
        np.testing.assert_array_equal(values(output, "Time"), np.arange(12.0))
        self.assertEqual(sorted(set(source.asked)), list(np.arange(12.0)))
        directions = values(output, "ViewDirection")
        self.assertLess(angles(directions, False).max(), 20)
        self.assert_shows_much(output, searched)
        turned = np.degrees(np.arccos(directions[0] @ directions[-1]))
        self.assertGreater(turned, 30)

    def assert_shows_much(self, path, searched):
        """At each time step nearly as much as can be seen from nearby."""
        for time, (direction, score) in enumerate(
                zip(values(path, "ViewDirection"), values(path, "VisibilityScore"))):
            searched.UpdateTimeStep(time)
            scores = values(searched.GetOutput(), "VisibilityScore")
            near = values(searched.GetOutput(), "ViewDirection") @ direction > np.cos(0.35)
            self.assertGreaterEqual(score, 0.899 * scores[near].max())

    def test_through_time_it_ends_at_a_step_that_fails_and_begins_anew(self):
        for failing in (1, 3):
            with self.subTest(failing=failing):
                source = Moving(4, without=(failing,))
                searched = search_through_time(source)
                path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
                self.assert_refuses(f"time step {failing} of 0..3", filter_=path)
                self.assertEqual(len(searched.messages["ErrorEvent"]), 1)
                self.assertIn('"Importance"', searched.messages["ErrorEvent"][0])
                self.assertEqual(source.asked, list(range(failing + 1)))

                source.without = ()
                source.asked.clear()
                source.Modified()
                path.Update()
                self.assertEqual(source.asked, [0, 1, 2, 3])
                self.assertEqual(path.GetOutput().GetNumberOfPoints(), 4)
                self.assertEqual(len(path.messages["ErrorEvent"]), 1)  # that of before

    def test_a_time_step_that_fails_has_one_message_with_the_reason(self):
        searched = vtkViewpointSearch()
        source = Moving(4, without=(2,))
        searched.SetInputConnection(source.GetOutputPort())
        searched.SetNumberOfDirections(42)
        searched.SetExtinctionSource(vtkViewpointSearch.ARRAY)
        path = vtkCameraPath()
        path.SetWay(vtkCameraPath.THROUGH_TIME)
        path.SetInputConnection(searched.GetOutputPort())
        before, window = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(window)
        try:
            path.Update()
        finally:
            vtkOutputWindow.SetInstance(before)
        said = re.findall(r"^(vtk\w+) \(0x\w+\): (.*)", window.GetOutput(), re.MULTILINE)
        said = [(name, text) for name, text in said if not text.startswith("Algorithm ")]
        self.assertEqual([name for name, _ in said], ["vtkCameraPath"], window.GetOutput())
        for part in ("time step 2 of 0..3", '"Importance"'):
            self.assertIn(part, said[0][1])

    def test_every_frame_shows_the_whole_box(self):
        for angle, aspect, parallel in ((30, 1, 0), (20, 1.7, 0), (60, 0.6, 0), (30, 1.7, 1)):
            with self.subTest(angle=angle, aspect=aspect, parallel=parallel):
                path = path_of(search(phantom(12), CameraViewUp=(0, 0, 1), CameraViewAngle=angle,
                                      CameraAspectRatio=aspect,
                                      CameraParallelProjection=parallel), NumberOfFrames=60)
                path.Update()
                output = path.GetOutput()
                corners = np.indices((2, 2, 2)).reshape(3, -1).T * 2 - 1.0
                scale = output.GetFieldData().GetArray("CameraParallelScale").GetValue(0)
                most = []
                for position, up in zip(values(output, "CameraPosition"),
                                        values(output, "CameraViewUp")):
                    ahead = -position / np.linalg.norm(position)
                    offsets = corners - position
                    half = (np.full(8, scale) if parallel
                            else np.tan(np.radians(angle / 2)) * (offsets @ ahead))
                    at = [offsets @ np.cross(ahead, up) / (half * aspect), offsets @ up / half]
                    most.append(np.abs(at).max())
                self.assertLess(max(most), 1)
                self.assertGreater(max(most), 0.9)  # no farther away than it must be

    def test_through_time_it_ends_at_a_first_step_that_fails(self):
        searched = search_through_time(Moving(3, without=(0,)))
        path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
        path.Update()
        self.assertEqual(len(searched.messages["ErrorEvent"]), 1)
        self.assert_no_error(path)  # it is not asked
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 0)

    def test_through_time_of_one_step(self):
        path = path_of(search_through_time(Moving(1)), Way=vtkCameraPath.THROUGH_TIME)
        path.Update()
        self.assert_no_error(path)
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 1)

    def test_through_time_of_images_with_other_extents(self):
        for change in (-1, 1):
            for announces in (False, True):
                with self.subTest(change=change, announces=announces):
                    source = Moving(3, announces=announces)
                    source.points = lambda time: 16 + change * int(time)
                    searched = search_through_time(source)
                    path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
                    if change < 0 and not announces:
                        self.assert_refuses("time step 1 of 0..2", "only the extent 0..14",
                                            filter_=path)
                        self.assertEqual(len(searched.messages["ErrorEvent"]), 1)
                        continue
                    path.Update()
                    self.assert_no_error(path)
                    self.assert_no_error(searched)
                    self.assertEqual(path.GetOutput().GetNumberOfPoints(), 3)
                    self.assert_shows_much(path.GetOutput(), searched)

    def test_through_time_it_can_be_aborted(self):
        source = Moving(5)
        path = path_of(search_through_time(source), Way=vtkCameraPath.THROUGH_TIME)
        tag = path.AddObserver("ProgressEvent", lambda *_: path.SetAbortExecute(
            1 if len(source.asked) == 2 else 0))
        path.Update()
        self.assertEqual(source.asked, [0, 1])
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 0)
        path.RemoveObserver(tag)
        path.SetAbortExecute(0)
        path.Modified()
        path.Update()
        self.assert_no_error(path)
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 5)

    def test_says_what_cannot_be(self):
        searched = search(phantom(12))
        nan = float("nan")  # the setters move other numbers into their ranges
        cases = dict(SeparationAngle=(nan,), LeastShare=(nan,),
                     ElevationRange=((10, 5), (nan, 0)))
        for name, wrong in cases.items():
            for value in wrong:
                with self.subTest(name=name, value=value):
                    self.assert_refuses(name, filter_=path_of(searched, **{name: value}))
        self.assert_refuses("no time steps", filter_=path_of(
            searched, Way=vtkCameraPath.THROUGH_TIME))
        self.assert_refuses("no camera position is allowed", filter_=path_of(
            search(phantom(12), CameraViewUp=(0.3, 1, 0.2)), ElevationRange=(89.9, 90)))
        self.assert_refuses("ViewDirection", "viewpoint search", filter_=path_of(vtkSphereSource()))

    def test_data_of_other_kinds_are_refused_with_what_has_a_sphere(self):
        for kind in (vtkUnstructuredGrid, vtkImageData, vtkMultiBlockDataSet):
            with self.subTest(kind=kind.__name__):
                data = vtkTrivialProducer()
                data.SetOutput(kind())
                self.assert_refuses(kind.__name__, "Viewpoint Search", filter_=path_of(data))

    def test_recovers_from_an_error(self):
        path = path_of(search(phantom(12)), NumberOfFrames=1)
        path.Update()
        path.SetNumberOfFrames(10)
        path.Update()
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 10)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The plugin in pvpython: proxies, what they choose by themselves, state files.

import os
import tempfile
import unittest

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())


class TestPlugin(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

    def test_has_the_properties_of_the_contract(self):
        names = set(ExtinctionOptimizer(Input=OcclusionPhantom()).ListProperties())

        self.assertLessEqual(
            {"Input", "ScalarArray", "ImportanceArray", "UseImportanceFunction",
             "ImportanceFunction", "ExtinctionSource", "ScalarOpacityFunction",
             "ScalarOpacityUnitDistance", "ExtinctionArray", "CameraPosition", "CameraFocalPoint",
             "CameraViewUp", "CameraViewAngle", "CameraParallelProjection", "CameraParallelScale",
             "LightType", "LightPosition", "RegularizationWeight", "ClearingThreshold", "ViewWeight",
             "LightWeight",
             "Mode", "Solver", "MaximumIterations", "IterationsPerLevel", "LearningRate",
             "Tolerance", "MaximumSeconds", "Derivative", "RayDensity", "SkipUnneeded",
             "RestrictToView", "ProtectImportance", "Emphasis", "OptimizeViewpoint",
             "ViewpointGuide", "Preset", "Backend"}, names)
        self.assertLessEqual({"Resolution", "Scene"}, set(OcclusionPhantom().ListProperties()))

    def test_works_as_it_is_on_the_phantom(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=24))
        optimizer.UpdatePipeline()

        points = simple.servermanager.Fetch(optimizer).GetPointData()
        inputs = simple.servermanager.Fetch(optimizer.Input).GetPointData()
        np.testing.assert_array_equal(vtk_to_numpy(points.GetArray("Importance")),
                                      vtk_to_numpy(inputs.GetArray("Importance")))

        self.assertIn("Extinction", optimizer.PointData.keys())
        fields = optimizer.FieldData
        self.assertGreater(fields["VisibilityScore"].GetRange()[0],
                           fields["BaseVisibilityScore"].GetRange()[0])

    def test_writes_the_arrays_that_are_asked_for(self):
        phantom = OcclusionPhantom(Resolution=16)
        phantom.UpdatePipeline()
        given = set(phantom.PointData.keys())
        optimizer = ExtinctionOptimizer(Input=phantom, MaximumIterations=0)
        self.assertEqual(len(optimizer.ResultArrays), 8)
        optimizer.UpdatePipeline()
        self.assertEqual(set(optimizer.ResultArrays) - set(optimizer.PointData.keys()),
                         {"LightExtinction"})  # there is one in Separate mode only

        optimizer.ResultArrays = ["Transmittance", "Opacity"]
        optimizer.UpdatePipeline()

        self.assertEqual(set(optimizer.PointData.keys()) - given, {"Transmittance", "Opacity"})

    def test_takes_enumerations_by_their_texts(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=16, Scene="Shells"))
        optimizer.ExtinctionSource = "Array"
        optimizer.Solver = "Adam"
        optimizer.IterationsPerLevel = [2, 2, 2]
        optimizer.Mode = "Separate"
        optimizer.Backend = "CPU"
        optimizer.UpdatePipeline()

        self.assertIn("LightExtinction", optimizer.PointData.keys())

    def test_chooses_arrays_functions_and_unit_distance_by_the_data(self):
        wavelet = simple.Wavelet()
        wavelet.UpdatePipeline()
        low, high = wavelet.PointData["RTData"].GetRange()
        optimizer = ExtinctionOptimizer(Input=wavelet)

        self.assertEqual(list(optimizer.ScalarArray), ["POINTS", "RTData"])
        for function in (optimizer.ScalarOpacityFunction, optimizer.ImportanceFunction):
            self.assertEqual(list(function.Points), [low, 0, 0.5, 0, high, 1, 0.5, 0])
        volume = simple.Show(wavelet)
        volume.SetRepresentationType("Volume")
        self.assertEqual(optimizer.ScalarOpacityUnitDistance, 0)  # with any number of processes
        optimizer.ImportanceArray = ["POINTS", "RTData"]
        optimizer.UpdatePipeline()
        used = optimizer.FieldData["ScalarOpacityUnitDistance"].GetRange()[0]
        self.assertAlmostEqual(used, volume.ScalarOpacityUnitDistance)

        phantom = OcclusionPhantom()
        phantom.UpdatePipeline()
        optimizer = ExtinctionOptimizer(Input=phantom)
        self.assertEqual(list(optimizer.ImportanceArray), ["POINTS", "Importance"])
        self.assertEqual(list(optimizer.ExtinctionArray), ["POINTS", "BaseExtinction"])

    def test_takes_the_largest_values_for_important_whether_the_input_was_updated_or_not(self):
        for updates in (False, True):
            source = simple.Wavelet()
            if updates:
                source.UpdatePipeline()
            optimizer = ExtinctionOptimizer(Input=source, MaximumIterations=0)
            if updates:
                self.assertEqual(list(optimizer.ImportanceArray), ["POINTS", "(Automatic)"])

            optimizer.UpdatePipeline()

            points = simple.servermanager.Fetch(optimizer).GetPointData()
            values, importance = (vtk_to_numpy(points.GetArray(name)).astype(float)
                                  for name in ("RTData", "Importance"))
            ordered = np.sort(values)
            ends = [ordered[int(share * (ordered.size - 1))] for share in (0.95, 0.99)]
            np.testing.assert_allclose(importance, np.interp(values, ends, (0, 1)), atol=1e-6)

    def test_uses_the_opacity_function_of_the_color_map_editor(self):
        phantom = OcclusionPhantom(Resolution=16)
        phantom.UpdatePipeline()
        optimizer = ExtinctionOptimizer(Input=phantom)
        opacity = simple.GetOpacityTransferFunction("Scalars")
        opacity.Points = [0, 0, 0.5, 0, 1, 0.5, 0.5, 0]
        optimizer.ScalarOpacityFunction = opacity
        optimizer.UpdatePipeline()
        first = optimizer.PointData["BaseExtinction"].GetRange()[1]
        opacity.Points = [0, 0, 0.5, 0, 1, 0.25, 0.5, 0]
        optimizer.UpdatePipeline()

        self.assertLess(optimizer.PointData["BaseExtinction"].GetRange()[1], first)

    def test_has_the_convergence_as_second_output(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=16))
        table = simple.OutputPort(optimizer, "Convergence")
        simple.UpdatePipeline(proxy=optimizer)

        rows = simple.servermanager.Fetch(optimizer, idx=table.Port)
        self.assertEqual(rows.GetColumnName(0), "Iteration")
        self.assertGreater(rows.GetNumberOfRows(), 1)

    def test_comes_back_from_a_state_file(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=16, Scene="Flame"))
        optimizer.ExtinctionSource = "Array"
        optimizer.CameraPosition = [1, 2, 3]
        optimizer.IterationsPerLevel = [3, 4, 5]
        optimizer.ImportanceFunction.Points = [0, 0, 0.5, 0, 0.25, 1, 0.5, 0]
        simple.RenameSource("before", optimizer)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        loaded = simple.FindSource("before")

        self.assertEqual(loaded.ExtinctionSource, "Array")
        self.assertEqual(list(loaded.CameraPosition), [1, 2, 3])
        self.assertEqual(list(loaded.IterationsPerLevel), [3, 4, 5])
        self.assertEqual(list(loaded.ImportanceFunction.Points), [0, 0, 0.5, 0, 0.25, 1, 0.5, 0])
        self.assertEqual(loaded.Input.Scene, "Flame")

    def test_runs_again_for_every_time_step(self):
        script = """
import numpy as np
from paraview import vtk
time = self.GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
output.ShallowCopy(inputs[0].VTKObject)
base = inputs[0].PointData['BaseExtinction']
output.PointData.append(base * (1 + time), 'BaseExtinction')
"""
        information = """
from paraview import vtk
keys = vtk.vtkStreamingDemandDrivenPipeline
outInfo = self.GetOutputInformation(0)
outInfo.Set(keys.TIME_STEPS(), [0.0, 1.0, 2.0], 3)
outInfo.Set(keys.TIME_RANGE(), [0.0, 2.0], 2)
"""
        varying = simple.ProgrammableFilter(
            Input=OcclusionPhantom(Resolution=16), Script=script,
            RequestInformationScript=information)
        optimizer = ExtinctionOptimizer(Input=varying)
        optimizer.ExtinctionSource = "Array"

        scores = []
        for time in (0.0, 1.0, 2.0, 0.0):
            optimizer.UpdatePipeline(time)
            scores.append(optimizer.FieldData["VisibilityScore"].GetRange()[0])
        self.assertEqual(scores[0], scores[3])
        self.assertEqual(len(set(scores)), 3)


if __name__ == "__main__":
    runner.run()

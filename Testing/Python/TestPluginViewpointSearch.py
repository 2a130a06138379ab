# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The search for viewpoints in pvpython: the proxy, its outputs, state files, and cameras of a view.

import os
import tempfile
import unittest

from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())


class TestPluginViewpointSearch(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

    def test_has_the_properties_of_the_contract(self):
        search = ViewpointSearch(Input=OcclusionPhantom())

        self.assertLessEqual(
            {"Input", "ScalarArray", "ImportanceArray", "UseImportanceFunction",
             "ImportanceFunction", "ExtinctionSource", "ScalarOpacityFunction",
             "ScalarOpacityUnitDistance", "ExtinctionArray", "RegularizationWeight", "ClearingThreshold", "ViewWeight",
             "LightWeight", "ProtectImportance", "Emphasis", "Backend", "Field", "Sampling", "NumberOfDirections", "CameraDistance",
             "CameraViewAngle", "NumberOfViewpoints", "Refine"}, set(search.ListProperties()))
        self.assertEqual(search.SMProxy.GetXMLLabel(), "Viewpoint Search")
        self.assertEqual(search.SMProxy.GetVTKClassName(), "vtkViewpointSearch")

    def test_works_as_it_is_on_the_phantom(self):
        search = ViewpointSearch(Input=OcclusionPhantom(Resolution=16))
        search.UpdatePipeline()

        self.assertEqual(search.GetDataInformation().GetNumberOfPoints(), 642)
        self.assertEqual(search.PointData["NormalizedScore"].GetRange(), (0, 1))
        self.assertGreater(search.FieldData["BestVisibilityScore"].GetRange()[0],
                           search.FieldData["WorstVisibilityScore"].GetRange()[0])

    def test_takes_enumerations_by_their_texts(self):
        for field in ("Attainable", "Importance Proxy", "Base Extinction", "Extinction Array",
                      "Optimize Per View"):
            for sampling in ("Icosphere", "Fibonacci", "Latitude-Longitude"):
                search = ViewpointSearch(Input=OcclusionPhantom(Resolution=8), NumberOfDirections=12,
                                         Field=field, Sampling=sampling, Refine=0)
                search.UpdatePipeline()
                self.assertGreater(search.PointData["VisibilityScore"].GetRange()[0], 0)

    def test_has_three_outputs(self):
        search = ViewpointSearch(Input=OcclusionPhantom(Resolution=16), NumberOfDirections=42)
        search.ExtinctionSource = "Array"
        search.UpdatePipeline()

        for name, dimension in (("Sphere", 2), ("Viewpoints", 0), ("Paths", 1)):
            port = simple.OutputPort(search, name)
            output = simple.servermanager.Fetch(search, idx=port.Port)
            for cell in range(output.GetNumberOfCells()):
                self.assertEqual(output.GetCell(cell).GetCellDimension(), dimension)
        self.assertEqual(simple.OutputPort(search, "Sphere").Port, 0)

    def test_chooses_arrays_and_functions_by_the_data(self):
        phantom = OcclusionPhantom(Resolution=16)
        phantom.UpdatePipeline()
        search, optimizer = ViewpointSearch(Input=phantom), ExtinctionOptimizer(Input=phantom)

        for name in ("ScalarArray", "ImportanceArray", "ExtinctionArray"):
            self.assertEqual(list(getattr(search, name)), list(getattr(optimizer, name)))
        self.assertEqual(search.ScalarOpacityUnitDistance, optimizer.ScalarOpacityUnitDistance)
        self.assertEqual(list(search.ScalarOpacityFunction.Points),
                         list(optimizer.ScalarOpacityFunction.Points))

    def test_its_best_view_scores_the_same_in_the_optimizer(self):
        phantom = OcclusionPhantom(Resolution=24)
        search = ViewpointSearch(Input=phantom, Field="Base Extinction", NumberOfDirections=42)
        search.ExtinctionSource = "Array"
        search.UpdatePipeline()
        best = simple.servermanager.Fetch(search, idx=1).GetPointData()
        optimizer = ExtinctionOptimizer(Input=phantom)
        optimizer.ExtinctionSource = "Array"
        for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp"):
            setattr(optimizer, name, list(vtk_to_numpy(best.GetArray(name))[0]))
        optimizer.UpdatePipeline()

        score = best.GetArray("VisibilityScore").GetValue(0)
        base = optimizer.FieldData["BaseVisibilityScore"].GetRange()[0]
        # Both are quadratures of the same integral, with rays at different places.
        self.assertLess(abs(score / base - 1), 5e-3)

    def test_comes_back_from_a_state_file(self):
        search = ViewpointSearch(Input=OcclusionPhantom(Resolution=12, Scene="Flame"),
                                 Field="Base Extinction", Sampling="Fibonacci",
                                 NumberOfDirections=77, CameraDistance=2.5, SeparationAngle=45)
        search.ImportanceFunction.Points = [0, 0, 0.5, 0, 0.25, 1, 0.5, 0]
        simple.RenameSource("before", search)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        loaded = simple.FindSource("before")

        self.assertEqual((loaded.Field, loaded.Sampling), ("Base Extinction", "Fibonacci"))
        self.assertEqual((loaded.NumberOfDirections, loaded.CameraDistance), (77, 2.5))
        self.assertEqual(loaded.SeparationAngle, 45)
        self.assertEqual(list(loaded.ImportanceFunction.Points), [0, 0, 0.5, 0, 0.25, 1, 0.5, 0])
        self.assertEqual(loaded.Input.Scene, "Flame")


if __name__ == "__main__":
    unittest.main()

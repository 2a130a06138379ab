# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch with several processes: data that are no image, of which each process has some, are
# drawn like the image of the same field, without seams.

import os
import sys
import unittest

import numpy as np
from paraview import simple

import displays
import pictures

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=vars(simple))
PROCESSES = simple.servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()


class TestAnyDataOnRanks(displays.SampledDisplayTest):
    def test_there_are_several_processes(self):
        self.assertGreater(PROCESSES, 1)

    def test_points(self):
        image = simple.OcclusionPhantom(Resolution=32)
        self.assert_alike({
            "tetrahedra": simple.Tetrahedralize(Input=image),
            "structured grid": simple.Transform(Input=image),
            "meshes in blocks": simple.GroupDatasets(Input=[simple.AppendDatasets(Input=[image])])}, image)

    def test_cells(self):
        cells = simple.PointDatatoCellData(Input=simple.OcclusionPhantom(Resolution=32))
        self.assert_alike({"hexahedra": simple.AppendDatasets(Input=[cells])}, cells, ("CELLS", "Scalars"))

    def test_labels(self):
        image = simple.Calculator(Input=simple.OcclusionPhantom(Resolution=32), ResultArrayName="Labels",
                                  Function="4*round(Importance)")
        self.assert_alike({"hexahedra": simple.AppendDatasets(Input=[image])}, image,
                          StructureArray=["POINTS", "Labels"], Structures=["4", "core", "1", ""])

    def test_arrays_that_are_chosen_later_are_sampled_then(self):
        more = simple.Calculator(Input=simple.OcclusionPhantom(Resolution=32), ResultArrayName="Density",
                                 Function="Scalars*Importance+0.1*coordsX")
        meshes = simple.Tetrahedralize(Input=more)
        self.shown(meshes)
        pictures_of = [self.shown(source, ("POINTS", "Density"))[1]
                       for source in (meshes, simple.Tetrahedralize(Input=more))]
        self.assertGreater(pictures_of[0].std(), 3)
        np.testing.assert_array_equal(*pictures_of)

    def test_filters(self):
        image = simple.OcclusionPhantom(Resolution=32)
        meshes = simple.Tetrahedralize(Input=image)
        # Ranks share the work of the optimiser. With other methods, each of them has the whole image.
        for method in ("Optimized", "Viola 2004"):
            with self.subTest(method):
                results = [simple.ExtinctionOptimizer(Input=data, Method=method, ScalarArray=["POINTS", "Scalars"])
                           for data in (image, meshes)]
                for result in results:
                    result.UpdatePipeline()
                expected, found = [result.FieldData["VisibilityScore"].GetRange()[0] for result in results]
                self.assertAlmostEqual(found / expected, 1, delta=5e-3)
                for name in ("Extinction", "Transmittance", "MissedImportance"):
                    expected, found = [result.PointData[name].GetRange() for result in results]
                    np.testing.assert_allclose(found, expected, atol=0.02 * expected[1])
                integrals = [simple.IntegrateVariables(Input=result) for result in results]
                for integral in integrals:
                    integral.UpdatePipeline()
                expected, found = [integral.PointData["Extinction"].GetRange()[0] for integral in integrals]
                self.assertAlmostEqual(found / expected, 1, delta=5e-3)
        searches = [simple.ViewpointSearch(Input=data, NumberOfDirections=42, ScalarArray=["POINTS", "Scalars"])
                    for data in (image, meshes)]
        for search in searches:
            search.UpdatePipeline()
        expected, found = [search.PointData["VisibilityScore"].GetRange() for search in searches]
        np.testing.assert_allclose(found, expected, rtol=5e-3)

    def test_cells_at_borders_of_pieces_are_averaged_from_both_sides(self):
        cells = simple.PointDatatoCellData(Input=simple.OcclusionPhantom(Resolution=12))
        scores = []
        for data in (cells, simple.AppendDatasets(Input=[cells])):
            result = simple.ExtinctionOptimizer(Input=data, ScalarArray=["CELLS", "Scalars"],
                                                ImportanceArray=["CELLS", "Importance"])
            result.UpdatePipeline()
            scores.append([result.FieldData[name].GetRange()[0]
                           for name in ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction")])
        np.testing.assert_allclose(scores[1], scores[0], rtol=1e-4)

    def test_data_without_a_volume_say_so(self):
        display = displays.show(simple.AppendDatasets(Input=[simple.Sphere()]), self.view, array=("POINTS", "Normals"))
        pictures.take(self.view)
        display.UpdatePropertyInformation()
        self.assertIn("without cells that have a volume", display.Messages)


if __name__ == "__main__":
    # Only a failure leaves by sys.exit: it keeps ParaView from closing its windows and processes.
    if not unittest.main(exit=False).result.wasSuccessful():
        sys.exit(1)

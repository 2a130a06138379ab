# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: processes that share an image have the bits of one that has all of it, whatever
# pieces the image comes in; what goes wrong on one goes wrong on all, and they go on.

import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkFloatArray  # noqa: F401
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkCommonExecutionModel import (vtkAlgorithm, vtkExtentTranslator,
                                                vtkStreamingDemandDrivenPipeline)
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from limpid.vtkLimpidFilters import (vtkExtinctionOptimizer, vtkOcclusionPhantom,
                                     vtkViewpointSearch)

import images

CONTROLLER = vtkMultiProcessController.GetGlobalController()
RANK = CONTROLLER.GetLocalProcessId()
RANKS = CONTROLLER.GetNumberOfProcesses()

FIELDS = ("Extinction", "BaseExtinction", "Importance", "Opacity", "Transmittance",
          "LightTransmittance", "MissedImportance")
SCORES = ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction", "SacrificedFraction",
          "AttainableFraction", "AttainableScore", "AttainableLightScore", "Energy", "Iterations")


def whole_phantom(resolution=20):
    image = images.phantom(resolution)
    image.GetPointData().SetActiveScalars("Scalars")
    return image


class Pieces(VTKPythonAlgorithmBase):
    """An image of which every process has what extent_of(rank) says, whatever it is asked for."""

    def __init__(self, image, extent_of):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.image, self.extent_of = image, extent_of

    def RequestInformation(self, _request, _inputs, outputs):
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), self.image.GetExtent(), 6)
        info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        extent = self.extent_of(RANK)
        output = vtkImageData.GetData(outputs, 0)
        if extent:
            output.ShallowCopy(self.image)
            output.Crop(extent)
        return 1


def slabs(image, axis, more=0, empty=0):
    """Extents of slabs; the next one begins behind the end of one, or some layers before."""
    whole = image.GetExtent()
    count = whole[2 * axis + 1] + 1

    def extent_of(rank):
        part, parts = rank - empty, RANKS - empty
        if part < 0:
            return None
        extent = list(whole)
        extent[2 * axis] = max(count * part // parts - more, 0)
        extent[2 * axis + 1] = min(count * (part + 1) // parts - 1 + more, whole[2 * axis + 1])
        return extent
    return extent_of


def optimizer_of(connection=None, image=None, **properties):
    optimizer = vtkExtinctionOptimizer()
    if image:
        optimizer.SetInputData(image)
    else:
        optimizer.SetInputConnection(connection)
    optimizer.SetExtinctionSource(vtkExtinctionOptimizer.ARRAY)
    for name, value in properties.items():
        getattr(optimizer, "Set" + name)(value)
    return optimizer


def alone(image, **properties):
    """By every process for itself: nobody else is asked for a piece."""
    optimizer = optimizer_of(image=image, **properties)
    optimizer.UpdatePiece(0, 1, 0)
    return optimizer.GetOutput()


def together(producer, **properties):
    optimizer = optimizer_of(connection=producer.GetOutputPort(), **properties)
    optimizer.UpdatePiece(RANK, RANKS, 0)
    return optimizer


def values_in(image, name, extent):
    """Of a part of an image, by planes."""
    first = image.GetExtent()
    size = [first[2 * axis + 1] - first[2 * axis] + 1 for axis in (2, 1, 0)]
    array = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(size)
    part = tuple(slice(extent[2 * axis] - first[2 * axis], extent[2 * axis + 1] + 1 - first[2 * axis])
                 for axis in (2, 1, 0))
    return array[part]


def output_arrays(output):
    """Point arrays by name, but for times; nothing of an empty output."""
    data = output.GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).tolist()
            for i in range(data.GetNumberOfArrays()) if output.GetNumberOfPoints()}


class TestRanks(unittest.TestCase):
    def same(self, whole, optimizer, divided=True):
        output = optimizer.GetOutput()
        backend = output.GetFieldData().GetAbstractArray("Backend").GetValue(0)
        self.assertEqual(f", on each of {RANKS} ranks" in backend, divided, backend)
        for name in SCORES:
            self.assertEqual(output.GetFieldData().GetArray(name).GetTuple(0),
                             whole.GetFieldData().GetArray(name).GetTuple(0), name)
        for name in FIELDS if output.GetNumberOfPoints() else ():
            np.testing.assert_array_equal(values_in(output, name, output.GetExtent()),
                                          values_in(whole, name, output.GetExtent()), name)

    def test_assume_the_same_importance(self):
        image = whole_phantom()
        image.GetPointData().RemoveArray("Importance")
        for more in (0, 1):
            optimizer = together(Pieces(image, slabs(image, 2, more)))
            self.same(alone(image), optimizer)

    def test_pieces_of_a_source(self):
        phantom = vtkOcclusionPhantom()
        phantom.SetResolution(20)
        optimizer = together(phantom)
        self.same(alone(whole_phantom()), optimizer)
        extent = [0] * 6
        vtkExtentTranslator().PieceToExtentThreadSafe(
            RANK, RANKS, 0, (0, 19, 0, 19, 0, 19), extent, vtkExtentTranslator.BLOCK_MODE, 0)
        self.assertEqual(list(optimizer.GetOutput().GetExtent()), extent)

    def test_pieces_of_any_kind(self):
        image = whole_phantom()
        whole = alone(image)
        for axis in range(3):
            for more in (0, 1, 2):
                for empty in (0, 1) if RANKS > 2 else (0,):
                    pieces = Pieces(image, slabs(image, axis, more, empty))
                    with self.subTest(axis=axis, more=more, empty=empty):
                        self.same(whole, together(pieces))

    def test_opacities_of_scalars_and_separate_modes(self):
        image = whole_phantom()
        function = vtkPiecewiseFunction()
        function.AddPoint(0, 0)
        function.AddPoint(1, 0.3)
        for opacity in (None, function):
            for mode in (vtkExtinctionOptimizer.JOINT, vtkExtinctionOptimizer.SEPARATE):
                properties = {"ExtinctionSource": vtkExtinctionOptimizer.OPACITY_FUNCTION,
                              "ScalarOpacityFunction": opacity, "Mode": mode}
                with self.subTest(function=bool(opacity), mode=mode):
                    self.same(alone(image, **properties),
                              together(Pieces(image, slabs(image, 2)), **properties))

    def test_adam_and_smoothness(self):
        image = whole_phantom()
        adam = {"Solver": vtkExtinctionOptimizer.ADAM, "IterationsPerLevel": (3, 3, 4)}
        for properties in (adam, {"Smoothness": 0.2}, {**adam, "Smoothness": 0.2}):
            with self.subTest(**properties):
                self.same(alone(image, **properties),
                          together(Pieces(image, slabs(image, 2)), **properties))

    def test_what_is_carried_on(self):
        image = whole_phantom()
        for properties in ({"WarmStart": 1}, {"TemporalCoherence": 0.2}):
            pieces = Pieces(image, slabs(image, 1, 1))
            whole = optimizer_of(image=image, **properties)
            optimizer = optimizer_of(connection=pieces.GetOutputPort(), **properties)
            for weight in (10, 12):
                for one, piece in ((whole, (0, 1)), (optimizer, (RANK, RANKS))):
                    one.SetViewWeight(weight)
                    one.UpdatePiece(*piece, 0)
                with self.subTest(weight=weight, **properties):
                    self.same(whole.GetOutput(), optimizer)

    def same_in_slabs(self, image, choose, **properties):
        """Compares an optimizer of the whole image with one of slabs; `choose` sets both up."""
        whole = optimizer_of(image=image, **properties)
        choose(whole)
        whole.UpdatePiece(0, 1, 0)
        pieces = Pieces(image, slabs(image, 2, 1))
        optimizer = optimizer_of(connection=pieces.GetOutputPort(), **properties)
        choose(optimizer)
        optimizer.UpdatePiece(RANK, RANKS, 0)
        self.same(whole.GetOutput(), optimizer)
        return whole, optimizer

    def test_stay_near_a_reference(self):
        image = whole_phantom()
        array = vtkFloatArray()
        array.SetName("Half")
        for value in images.values(image, "BaseExtinction"):
            array.InsertNextValue(0.5 * float(value))
        image.GetPointData().AddArray(array)

        def choose(optimizer):
            optimizer.SetInputArrayToProcess(
                4, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Half")

        whole, _ = self.same_in_slabs(image, choose, ReferencePull=0.3)
        free = alone(image)
        self.assertTrue((values_in(free, "Extinction", free.GetExtent()) !=
                         values_in(whole.GetOutput(), "Extinction", free.GetExtent())).any())

    def test_structures(self):
        image = whole_phantom()
        array = vtkFloatArray()
        array.SetName("Labels")
        for value in images.values(image, "Importance"):
            array.InsertNextValue(float(int(4 * value)))
        image.GetPointData().AddArray(array)

        def choose(optimizer):
            optimizer.SetInputArrayToProcess(
                3, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Labels")
            optimizer.AddStructure(1, "some", 0.25)
            optimizer.AddStructure(3, "others", 1.0, 0.2)

        whole, optimizer = self.same_in_slabs(image, choose)
        tables = [one.GetStructureTable() for one in (whole, optimizer)]
        self.assertIsNotNone(tables[0].GetColumnByName("HiddenByOther"))
        for i in range(tables[0].GetNumberOfColumns()):
            columns = [table.GetColumn(i) for table in tables]
            self.assertEqual(*([column.GetVariantValue(row).ToString() for row in range(2)]
                               for column in columns), tables[0].GetColumnName(i))

    def test_importance_of_cells(self):
        image = whole_phantom()
        cells = images.values(image, "Importance").reshape(20, 20, 20)[:-1, :-1, :-1].ravel()
        array = vtkFloatArray()
        array.SetName("OfCells")
        for value in cells:
            array.InsertNextValue(float(value))
        image.GetCellData().AddArray(array)

        def choose(optimizer):
            optimizer.SetInputArrayToProcess(
                1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "OfCells")

        self.same_in_slabs(image, choose)

    def test_an_error_is_one_of_all_and_they_go_on(self):
        image = whole_phantom()
        bad = vtkImageData()
        bad.DeepCopy(image)
        bad.GetPointData().GetArray("Importance").SetName("Other")
        messages = []
        pieces = Pieces(bad if RANK == RANKS - 1 else image, slabs(image, 2))
        optimizer = optimizer_of(connection=pieces.GetOutputPort())
        optimizer.AddObserver("ErrorEvent", lambda *_: messages.append("error"))
        optimizer.UpdatePiece(RANK, RANKS, 0)
        self.assertEqual(messages, ["error"])
        self.assertEqual(optimizer.GetOutput().GetNumberOfPoints(), 0)
        self.same(alone(image), together(Pieces(image, slabs(image, 2))))

    def test_an_abort_is_one_of_all(self):
        image = whole_phantom(40)
        pieces = Pieces(image, slabs(image, 2))
        optimizer = optimizer_of(connection=pieces.GetOutputPort())
        if RANK == 0:
            optimizer.AddObserver("ProgressEvent", lambda *_: optimizer.SetAbortExecute(1))
        optimizer.UpdatePiece(RANK, RANKS, 0)
        self.assertIsNone(optimizer.GetOutput().GetPointData().GetArray("Extinction"))
        optimizer.RemoveAllObservers()
        self.same(alone(image), together(Pieces(image, slabs(image, 2))))

    def test_views_are_scored_by_all(self):
        image = whole_phantom(16)
        for field in (vtkViewpointSearch.BASE_EXTINCTION, vtkViewpointSearch.OPTIMIZE_PER_VIEW):
            results = []
            for piece in ((0, 1), (RANK, RANKS)):
                search = vtkViewpointSearch()
                search.SetInputData(image)
                search.SetExtinctionSource(vtkViewpointSearch.ARRAY)
                search.SetField(field)
                search.SetNumberOfDirections(13)
                search.SetNumberOfViewpoints(2)
                search.UpdatePiece(*piece, 0)
                results.append([output_arrays(search.GetOutput(port)) for port in range(3)])
            with self.subTest(field=field):
                if RANK == 0:
                    self.assertEqual(*results)
                else:
                    self.assertEqual(results[1], 3 * [{}])

    def test_views_of_an_image_in_pieces(self):
        image = whole_phantom(16)
        for field in (vtkViewpointSearch.BASE_EXTINCTION, vtkViewpointSearch.IMPORTANCE_PROXY,
                      vtkViewpointSearch.ATTAINABLE):
            for axis, more, empty in ((2, 0, 0), (0, 1, 0), (1, 1, RANKS - 1)):
                results = []
                for source in (None, Pieces(image, slabs(image, axis, more, empty))):
                    search = vtkViewpointSearch()
                    if source:
                        search.SetInputConnection(source.GetOutputPort())
                    else:
                        search.SetInputData(image)
                    search.SetExtinctionSource(vtkViewpointSearch.ARRAY)
                    search.SetField(field)
                    search.SetNumberOfDirections(13)
                    search.SetNumberOfViewpoints(2)
                    search.UpdatePiece(*((RANK, RANKS) if source else (0, 1)), 0)
                    results.append([output_arrays(search.GetOutput(port)) for port in range(3)])
                with self.subTest(field=field, axis=axis, more=more, empty=empty):
                    if RANK == 0:
                        self.assertEqual(*results)
                    else:
                        self.assertEqual(results[1], 3 * [{}])

    def test_what_cannot_be_shared_is_done_by_each(self):
        phantom = vtkOcclusionPhantom()
        phantom.SetResolution(16)
        other = {"Method": vtkExtinctionOptimizer.VIOLA_2004}
        self.same(alone(whole_phantom(16), **other), together(phantom, **other), divided=False)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=0 if RANK else 2).result
    if not result.wasSuccessful():
        sys.exit(1)

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the tests with VTK alone share: images, functions, filters and their messages."""

import contextlib
import resource
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import (vtkDataObject, vtkImageData, vtkMultiBlockDataSet,
                                           vtkPiecewiseFunction)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from limpid.vtkLimpidFilters import vtkOcclusionPhantom, vtkVisibilityAlgorithm


def image_of(shape, spacing=(1, 1, 1), origin=(0, 0, 0), **arrays):
    """An image with one point array per keyword; shape is (x, y, z), arrays are flat."""
    image = vtkImageData()
    image.SetDimensions(shape)
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    for name, data in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(data), deep=1)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    return image


def phantom(resolution=20, scene=0):
    source = vtkOcclusionPhantom()
    source.SetResolution(resolution)
    source.SetScene(scene)
    source.Update()
    image = vtkImageData()
    image.ShallowCopy(source.GetOutput())
    return image


def flipped(image, *axes):
    """The same image with its points in the opposite order along some axes: negative spacings."""
    shape = image.GetDimensions()
    spacing, origin = np.array(image.GetSpacing()), np.array(image.GetOrigin())
    for axis in axes:
        origin[axis] += (shape[axis] - 1) * spacing[axis]
        spacing[axis] *= -1
    names = [image.GetPointData().GetArrayName(i)
             for i in range(image.GetPointData().GetNumberOfArrays())]
    result = image_of(shape, spacing, origin,
                      **{name: in_order(image, name, *axes) for name in names})
    scalars = image.GetPointData().GetScalars()
    if scalars:
        result.GetPointData().SetActiveScalars(scalars.GetName())
    return result


def in_order(image, name, *axes):
    """The values of an array, flat, in the opposite order along some axes."""
    grid = values(image, name).reshape(image.GetDimensions()[::-1])
    return np.flip(grid, [2 - axis for axis in axes]).ravel()


def rounded_rotation(digits):
    """A direction matrix about two axes as a text file has it."""
    c, s = np.cos(np.radians(15)), np.sin(np.radians(15))
    return np.round(np.array([[c, -s, 0], [s * c, c * c, -s], [s * s, s * c, c]]), digits)


def blocks_of(*images):
    blocks = vtkMultiBlockDataSet()
    for number, image in enumerate(images):
        blocks.SetBlock(number, image)
    return blocks


def starting_importance(scalars):
    """What the display takes for important: the largest few per cent, in a ramp."""
    ordered = np.sort(scalars.astype(float), axis=None)
    ends = [ordered[int(share * (ordered.size - 1))] for share in (0.95, 0.99)]
    return np.interp(scalars, ends, (0, 1))


FILL_VALUES = [np.float32(9.96921e36), np.finfo(np.float32).max, 1e200, np.finfo(float).max]
FILL_VALUES += [-fill for fill in FILL_VALUES]


def image_with_fill(fill):
    """A ball of density up to 50 above a ground where there are no values, and how what is filled
    is empty and unimportant: a function of opacity and one of importance, as properties."""
    z, y, x = np.mgrid[-1:1:14j, -1:1:14j, -1:1:14j]
    density = 50 * np.exp(-4 * (x ** 2 + y ** 2 + z ** 2))
    density[:3] = fill
    kind = type(fill) if isinstance(fill, np.floating) else float
    image = image_of((14, 14, 14), density=density.astype(kind).ravel())
    image.GetPointData().SetActiveScalars("density")
    return image, dict(
        ScalarOpacityFunction=function_of((0, 0), (50, 0.5), (60, 0)), ScalarOpacityUnitDistance=1,
        UseImportanceFunction=1, ImportanceFunction=function_of((25, 0), (40, 1), (60, 0)))


class PartOf(VTKPythonAlgorithmBase):
    """Announces an image and gives a part of it."""

    def __init__(self, image, extent):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.image, self.extent = image, extent

    def RequestInformation(self, _, __, output):
        output.GetInformationObject(0).Set(
            vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), self.image.GetExtent(), 6)
        return 1

    def RequestData(self, _, __, output):
        part = vtkImageData()
        part.ShallowCopy(self.image)
        part.Crop(self.extent)
        output.GetInformationObject(0).Get(vtkDataObject.DATA_OBJECT()).ShallowCopy(part)
        return 1


def with_input(filter_, source):
    """The same filter with the output of an algorithm instead of its data."""
    filter_.RemoveAllInputConnections(0)
    filter_.SetInputConnection(source.GetOutputPort())
    return filter_


def function_of(*nodes):
    """Straight lines between nodes (position, value)."""
    function = vtkPiecewiseFunction()
    for position, value in nodes:
        function.AddPoint(position, value)
    return function


def values(output, name):
    return vtk_to_numpy(output.GetPointData().GetArray(name))


def caught(thing, *events):
    """Collects the texts of the events of a VTK object, by default errors and warnings."""
    texts = []

    def observe(_, __, text):
        texts.append(text)
    observe.CallDataType = "string0"
    for event in events or ("ErrorEvent", "WarningEvent"):
        thing.AddObserver(event, observe)
    return texts


@contextlib.contextmanager
def memory_limited_to(more):
    """No more bytes than those that the process has and so many."""
    with open("/proc/self/statm") as file:
        pages = int(file.read().split()[0])
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + more, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def catching(result):
    """A filter whose messages are caught, in `messages`."""
    result.messages = {event: caught(result, event) for event in ("ErrorEvent", "WarningEvent")}
    for event in result.messages:
        result.GetExecutive().AddObserver(event, lambda *_: None)
    return result


def filter_on(image, filter_class, **properties):
    """A filter that takes its extinction from the array BaseExtinction, with messages caught."""
    result = filter_class()
    result.SetInputData(image)
    result.SetExtinctionSource(vtkVisibilityAlgorithm.ARRAY)
    for name, value in properties.items():
        getattr(result, "Set" + name)(value)
    return catching(result)


def abort_at_every_event(filter_, look, step=1):
    """Aborts one run at the first event of its progress, the next `step` events later, …, and looks
    at what each leaves, until one comes to its end. Returns how many events that one had."""
    wanted, seen = 1 - step, 0

    def observe(*_):
        nonlocal seen
        seen += 1
        if seen == wanted:
            filter_.SetAbortExecute(1)
    tag = filter_.AddObserver("ProgressEvent", observe)
    while seen >= wanted:
        wanted, seen = wanted + step, 0
        filter_.SetAbortExecute(0)
        filter_.Modified()
        filter_.Update()
        look()
    filter_.RemoveObserver(tag)
    return seen


class FilterTest(unittest.TestCase):
    def assert_no_error(self, filter_):
        self.assertEqual(filter_.messages["ErrorEvent"], [])

    def assert_refuses(self, *words, filter_):
        """One error with these words in it, and nothing in the image or the surfaces put out."""
        filter_.Update()

        errors = filter_.messages["ErrorEvent"]
        self.assertEqual(len(errors), 1, errors)
        for word in words:
            self.assertIn(word, errors[0])
        outputs = [filter_.GetOutputDataObject(port)
                   for port in range(filter_.GetNumberOfOutputPorts())]
        for output in outputs:
            if output.IsA("vtkDataSet"):
                self.assertEqual(output.GetNumberOfPoints(), 0)
                self.assertEqual(output.GetPointData().GetNumberOfArrays(), 0)

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What VTK's tests ask of every class: BlackBox (VTK's own), TestSetGet, TestEmptyInput.

import inspect
import unittest

from vtkmodules.test import BlackBox
from vtkmodules.vtkCommonDataModel import (vtkImageData, vtkPolyData, vtkRectilinearGrid,
                                           vtkStructuredGrid, vtkUnstructuredGrid)

import limpid.vtkLimpidFilters as filters
import limpid.vtkLimpidRendering as rendering

from images import caught
from volume_views import View, phantom, phantom_property

ABSTRACT = ("vtkVisibilityAlgorithm",)

EMPTY = (vtkPolyData, vtkImageData, vtkStructuredGrid, vtkUnstructuredGrid, vtkRectilinearGrid)


def classes():
    """Those that can be made."""
    return [kind for module in (filters, rendering)
            for name, kind in inspect.getmembers(module, inspect.isclass)
            if name.startswith("vtk") and name not in ABSTRACT]


def own_methods(kind):
    """Those that VTK has not declared."""
    return {name for base in kind.__mro__ if base.__module__.startswith("limpid")
            for name in vars(base)}


def pairs(instance):
    """Names of what can be set, and got without an argument."""
    names = own_methods(type(instance))
    return sorted(name[3:] for name in names
                  if name.startswith("Set") and "Get" + name[3:] in names)


def as_arguments(value):
    return value if isinstance(value, tuple) else (value,)


class TestBlackBox(unittest.TestCase):
    def test_what_is_set_is_got_and_switches_switch(self):
        for kind in classes():
            with self.subTest(name=kind.__name__):
                instance = kind()
                instance.GlobalWarningDisplayOff()
                self.addCleanup(instance.GlobalWarningDisplayOn)
                tester = BlackBox.Tester()
                tester.testGetSet(instance)
                # An algorithm without an output has no data to release.
                tester.testBoolean(instance, ["ReleaseDataFlag"])


class TestSetGet(unittest.TestCase):
    def test_setting_what_is_there_changes_nothing(self):
        count = 0
        for kind in classes():
            instance = kind()
            texts = caught(instance)
            for name in pairs(instance):
                with self.subTest(name=kind.__name__ + "::" + name):
                    value = getattr(instance, "Get" + name)()
                    before = instance.GetMTime()
                    getattr(instance, "Set" + name)(*as_arguments(value))
                    self.assertEqual(getattr(instance, "Get" + name)(), value)
                    self.assertEqual(instance.GetMTime(), before)
                    count += 1
            self.assertEqual(texts, [])
        self.assertGreater(count, 100)

    def test_setting_something_else_is_seen(self):
        for kind in classes():
            instance = kind()
            for name in pairs(instance):
                value = getattr(instance, "Get" + name)()
                first = as_arguments(value)
                if not all(isinstance(number, (int, float)) for number in first):
                    continue
                with self.subTest(name=kind.__name__ + "::" + name):
                    before = instance.GetMTime()
                    # The default may be at an end of the range.
                    for change in (lambda n: n + 1, lambda n: n - 1, lambda n: n / 2):
                        other = tuple(map(change, first))
                        getattr(instance, "Set" + name)(*other)
                        if as_arguments(getattr(instance, "Get" + name)()) == other:
                            break
                    self.assertEqual(as_arguments(getattr(instance, "Get" + name)()), other)
                    self.assertGreater(instance.GetMTime(), before)

    def test_nothing_can_be_set(self):
        """A null pointer, for what is an object or a text."""
        for kind in classes():
            instance = kind()
            for name in pairs(instance):
                value = getattr(instance, "Get" + name)()
                if value is None or isinstance(value, str) or hasattr(value, "GetClassName"):
                    with self.subTest(name=kind.__name__ + "::" + name):
                        getattr(instance, "Set" + name)(None)
                        getattr(instance, "Get" + name)()
                        str(instance)

    def test_everything_is_printed(self):
        for kind in classes():
            instance = kind()
            printed = str(instance)
            for name in pairs(instance):
                with self.subTest(name=kind.__name__ + "::" + name):
                    self.assertIn(name + ":", printed)


class TestEmptyInput(unittest.TestCase):
    def check(self, algorithm, data, update):
        """A message, by the class or by VTK's pipeline."""
        said = caught(algorithm), caught(algorithm.GetExecutive())
        algorithm.SetInputDataObject(data())
        update()
        self.assertTrue(any(said))
        if data is vtkImageData:
            self.assertEqual(len(said[0]), 1)
            self.assertRegex(said[0][0], "there is nothing to (process|draw)")

    def test_filters_say_what_is_wrong(self):
        for kind in (filters.vtkExtinctionOptimizer, filters.vtkViewpointSearch):
            for data in EMPTY:
                with self.subTest(filter=kind.__name__, input=data.__name__):
                    instance = kind()
                    self.check(instance, data, instance.Update)
                    for port in range(instance.GetNumberOfOutputPorts()):
                        self.assertEqual(instance.GetOutputDataObject(port).GetNumberOfElements(0),
                                         0)

    def test_the_mapper_says_what_is_wrong(self):
        for data in EMPTY:
            with self.subTest(input=data.__name__):
                view = View()
                mapper = rendering.vtkTransmittanceVolumeMapper()
                view.add(phantom(8), phantom_property(), mapper)
                view.look()
                view.window.Render()
                self.check(mapper, data, view.window.Render)
                self.assertEqual(mapper.GetVisibilityScore(), 0)


if __name__ == "__main__":
    unittest.main()

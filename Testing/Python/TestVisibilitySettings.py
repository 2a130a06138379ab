# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The settings that filters and mapper own: the owners have the same methods, and pass them on.

import unittest

# What the extension module depends on.
import vtkmodules.vtkRenderingVolume  # noqa: F401
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction

from limpid.vtkLimpidFilters import (vtkAddStructures, vtkCameraPath, vtkExtinctionOptimizer,
                                     vtkOcclusionPhantom,
                                     vtkViewpointSearch, vtkVisibilitySettings)
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

from images import caught

OWNERS = (vtkExtinctionOptimizer, vtkViewpointSearch, vtkTransmittanceVolumeMapper)
# Defaults that are the owner's own.
OWN_DEFAULTS = {
    vtkExtinctionOptimizer: {"TemporalCoherence": 0},
    vtkViewpointSearch: {"MaximumIterations": 1, "TemporalCoherence": 0, "Smoothness": 0},
    vtkTransmittanceVolumeMapper: {"ScalarComponent": vtkTransmittanceVolumeMapper.UNDECIDED,
                                   "RestrictToView": 1},
}


def names():
    """Of all settings."""
    return [name[3:] for name in vars(vtkVisibilitySettings)
            if name.startswith("Set") and hasattr(vtkVisibilitySettings, "Get" + name[3:])]


def other(value):
    """A value of the same kind that is not this one, within the range of its setting."""
    if value is None:
        return vtkPiecewiseFunction()
    if isinstance(value, tuple):
        return tuple(number + 1 for number in value)
    if isinstance(value, int):
        return value - 1 if value > 0 else value + 1
    return value / 2 if value > 0 else 1.0


class TestVisibilitySettings(unittest.TestCase):
    def test_owners_pass_every_setting_on(self):
        self.assertGreater(len(names()), 30)
        for owner in OWNERS:
            instance = owner()
            settings = instance.GetVisibilitySettings()
            for name in names():
                with self.subTest(owner=owner.__name__, setting=name):
                    value = other(getattr(settings, "Get" + name)())
                    getattr(instance, "Set" + name)(value)
                    self.assertEqual(getattr(settings, "Get" + name)(), value)
                    self.assertEqual(getattr(instance, "Get" + name)(), value)

    def assert_moved(self, instance, name, wrong, settings, told):
        """A value below the range and one above it; None: there is none. settings: which knows
        the ends; told: what it has said."""
        ends = [getattr(settings, f"Get{name}{end}Value")() for end in ("Min", "Max")]
        for value, end in zip(wrong, ends):
            if value is None:
                continue
            with self.subTest(owner=instance.GetClassName(), setting=name, value=value):
                told.clear()
                getattr(instance, "Set" + name)(value)
                self.assertEqual(getattr(instance, "Get" + name)(), end)
                self.assertEqual(len(told), 1, told)
                self.assertIn(f"{name} is {value} ", told[0])
                getattr(instance, "Set" + name)(end)
                self.assertEqual(len(told), 1, told)

    def test_values_out_of_range_are_moved_into_it_and_said(self):
        infinite = float("inf")
        cases = {"Mode": (-1, 7), "Solver": (-1, 2), "Method": (-1, 5), "LightType": (-1, 2),
                 "Derivative": (-1, 2), "Views": (-1, 3), "ImportanceSmoothing": (-1, 2),
                 "Backend": (-1, 9), "NumberOfViews": (0, 361), "AmentSmoothing": (-1, 101),
                 "ProtectImportance": (-0.5, 1.5), "Emphasis": (-1, 1.1), "Smoothness": (-1, 11),
                 "RayDensity": (0, 100), "MaximumIterations": (-1, None), "Tolerance": (-1, None),
                 "MaximumSeconds": (-1, None), "TemporalCoherence": (-1, None),
                 "ClearingThreshold": (-4, None), "ViewWeight": (-1, None),
                 "LightWeight": (-2, None), "AmentExponent": (-1, None),
                 "AmentOccluders": (-1, None), "AmentBackground": (-1, None),
                 "AmentLightOccluders": (-1, None), "AmentLightBackground": (-1, None)}
        for owner in OWNERS:
            for name, wrong in cases.items():
                instance = owner()
                settings = instance.GetVisibilitySettings()
                self.assert_moved(instance, name, wrong, settings, caught(settings, "WarningEvent"))
        settings = vtkVisibilitySettings()
        told = caught(settings, "WarningEvent")
        settings.SetRegularizationWeight(-3)
        settings.SetIterationsPerLevel(8, -1, 4)
        self.assertEqual(settings.GetRegularizationWeight(), 0)
        self.assertEqual(settings.GetIterationsPerLevel(), (8, 0, 4))
        self.assertEqual(len(told), 2, told)
        settings.SetViewWeight(infinite)  # it is not near any weight: owners refuse it
        self.assertEqual(settings.GetViewWeight(), infinite)

    def test_owners_move_what_is_their_own_and_say_so(self):
        cases = {
            vtkAddStructures: {"Resampling": (-1, 2)},
            vtkViewpointSearch: {
                "Field": (-1, 5), "Sampling": (-1, 3), "NumberOfDirections": (0, 100001),
                "CameraDistance": (0.5, None), "AvoidanceAngle": (-1, 181),
                "NumberOfViewpoints": (0, None), "SeparationAngle": (-1, 181),
                "ExtinctionSource": (-1, 2)},
            vtkExtinctionOptimizer: {"ViewpointGuide": (-1, 3), "ExtinctionSource": (-1, 2)},
            vtkCameraPath: {
                "Way": (-1, 2), "NumberOfKeyViews": (0, None), "SeparationAngle": (-1, 181),
                "NumberOfFrames": (1, 100001), "LeastShare": (-0.1, 1.1)},
            vtkTransmittanceVolumeMapper: {
                "ExtinctionSource": (-1, 2), "Optimization": (-1, 3), "LightSource": (-1, 2),
                "ImportanceArrayAssociation": (-1, 4), "ExtinctionArrayAssociation": (-1, 4),
                "ShadowStrength": (-0.1, 1.5), "Ambient": (-0.5, 1.1), "Specular": (-1, None),
                "SpecularPower": (-2, None), "LightIntensity": (-4, None), "EaseTime": (-1, None)}}
        for owner, properties in cases.items():
            for name, wrong in properties.items():
                instance = owner()
                told = caught(instance, "WarningEvent")
                self.assert_moved(instance, name, wrong, instance, told)

    def test_owners_move_vectors_and_say_so(self):
        for owner, name, wrong, right in (
                (vtkViewpointSearch, "ElevationRange", (-91, 100), (-90, 90)),
                (vtkCameraPath, "ElevationRange", (-91, 100), (-90, 90)),
                (vtkTransmittanceVolumeMapper, "MissedColor", (-1, 0.5, 2), (0, 0.5, 1))):
            instance = owner()
            told = caught(instance, "WarningEvent")
            getattr(instance, "Set" + name)(wrong)
            self.assertEqual(getattr(instance, "Get" + name)(), right)
            self.assertEqual(len(told), 2, told)
            getattr(instance, "Set" + name)(*right)
            self.assertEqual(len(told), 2, told)

    def test_switches_are_passed_on(self):
        for owner in OWNERS:
            for name in ("UseImportanceFunction", "SkipUnneeded", "RestrictToView"):
                instance = owner()
                getattr(instance, name + "On")()
                self.assertEqual(getattr(instance.GetVisibilitySettings(), "Get" + name)(), 1)
                getattr(instance, name + "Off")()
                self.assertEqual(getattr(instance.GetVisibilitySettings(), "Get" + name)(), 0)

    def test_defaults_are_the_same_but_for_the_named_ones(self):
        plain = vtkVisibilitySettings()
        for owner in OWNERS:
            for name in names():
                with self.subTest(owner=owner.__name__, setting=name):
                    expected = OWN_DEFAULTS[owner].get(name, getattr(plain, "Get" + name)())
                    self.assertEqual(getattr(owner(), "Get" + name)(), expected)

    def test_presets_are_those_of_the_table(self):
        names = [vtkVisibilitySettings.GetPresetName(index)
                 for index in range(vtkVisibilitySettings.GetNumberOfPresets())]
        self.assertEqual(names, ["Default", "Keep Context", "Strong Reveal", "Paper"])
        self.assertIsNone(vtkVisibilitySettings.GetPresetName(len(names)))

    def test_owners_have_presets(self):
        paper = {"RegularizationWeight": 1e-3, "ClearingThreshold": 0, "ViewWeight": 10,
                 "LightWeight": 1, "ProtectImportance": 0, "Emphasis": 1, "Smoothness": 0,
                 "ImportanceSmoothing": vtkVisibilitySettings.AS_GIVEN, "TemporalCoherence": 0}
        for owner in OWNERS:
            instance = owner()
            defaults = {name: getattr(instance, "Get" + name)() for name in paper}
            for preset, expected in (("PAPER", paper), ("Default", defaults)):
                with self.subTest(owner=owner.__name__, preset=preset):
                    self.assertTrue(instance.SetPreset(preset))
                    self.assertEqual(
                        {name: getattr(instance, "Get" + name)() for name in paper}, expected)

    def test_an_unknown_preset_changes_nothing_and_says_which_there_are(self):
        settings = vtkVisibilitySettings()
        errors = []

        def observe(_, __, text):
            errors.append(text)
        observe.CallDataType = "string0"
        settings.AddObserver("ErrorEvent", observe)
        before = settings.GetMTime()

        self.assertFalse(settings.SetPreset("Nonsense"))

        self.assertEqual(settings.GetMTime(), before)
        self.assertEqual(len(errors), 1)
        self.assertIn("Default, Keep Context, Strong Reveal, Paper.", errors[0])

    def test_the_regularization_weight_counts_when_it_is_changed(self):
        for owner in OWNERS:
            instance = owner()
            self.assertGreater(instance.GetClearingThreshold(), 0)
            instance.SetRegularizationWeight(2 * instance.GetRegularizationWeight())
            self.assertEqual(instance.GetClearingThreshold(), 0)

    def test_a_change_makes_every_owner_newer(self):
        shared = vtkVisibilitySettings()
        function = vtkPiecewiseFunction()
        shared.SetImportanceFunction(function)
        for owner in OWNERS:
            instance = owner()
            instance.SetVisibilitySettings(shared)
            for change in (lambda: shared.SetViewWeight(shared.GetViewWeight() + 1),
                           lambda: function.AddPoint(function.GetSize(), 1)):
                before = instance.GetMTime()
                change()
                self.assertGreater(instance.GetMTime(), before)
                self.assertEqual(instance.GetMTime(), instance.GetMTime())

    def test_no_settings_are_no_choice(self):
        for owner in OWNERS:
            instance = owner()
            settings = instance.GetVisibilitySettings()
            instance.SetVisibilitySettings(None)
            self.assertIs(instance.GetVisibilitySettings(), settings)

    def test_a_filter_runs_again_when_shared_settings_change(self):
        phantom = vtkOcclusionPhantom()
        phantom.SetResolution(12)
        optimizer = vtkExtinctionOptimizer()
        optimizer.SetInputConnection(phantom.GetOutputPort())
        optimizer.SetInputArrayToProcess(0, 0, 0, 0, "Scalars")
        mapper = vtkTransmittanceVolumeMapper()
        mapper.SetVisibilitySettings(optimizer.GetVisibilitySettings())
        optimizer.Update()
        before = optimizer.GetOutput().GetFieldData().GetArray("VisibilityScore").GetValue(0)

        mapper.SetViewWeight(0)
        optimizer.Update()

        after = optimizer.GetOutput().GetFieldData().GetArray("VisibilityScore").GetValue(0)
        self.assertLess(after, before)


if __name__ == "__main__":
    unittest.main()

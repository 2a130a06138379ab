# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Labels of structures in place of an importance, in filters and mapper: what is important, and what
# is said about labels and structures that are none.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkViewpointSearch

from images import FilterTest, filter_on, image_of, phantom, values
from mapper_tests import MapperTest, placement_of, show
from volume_views import actor_of, gray_property, sphere

SINGLE = float(np.finfo(np.float32).eps)
LABELS = 3  # input array of the labels
POINTS, CELLS = vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS


def add(data, name, array):
    array = numpy_to_vtk(np.ascontiguousarray(array), deep=1)
    array.SetName(name)
    data.AddArray(array)


def labelled(labels, on_cells=False):
    """An image of unit extinction with labels, indexed [x, y, z]."""
    shape = np.add(labels.shape, 1) if on_cells else labels.shape
    image = image_of(shape, BaseExtinction=np.ones(np.prod(shape), np.float32))
    data = image.GetCellData() if on_cells else image.GetPointData()
    add(data, "Labels", labels.ravel(order="F"))
    return image


def optimizer(image, *structures, on_cells=False, filter_class=vtkExtinctionOptimizer, **properties):
    """A filter whose structures are (label, name, importance, target)."""
    result = filter_on(image, filter_class, **properties)
    result.SetInputArrayToProcess(LABELS, 0, 0, CELLS if on_cells else POINTS, "Labels")
    for structure in structures:
        result.AddStructure(*structure)
    return result


class StructuresTest(FilterTest):
    def importance(self, image, *structures, **arguments):
        """The importance that the filter has used, indexed [x, y, z]."""
        result = optimizer(image, *structures, MaximumIterations=0, **arguments)
        result.Update()
        self.assert_no_error(result)
        return values(result.GetOutput(), "Importance").reshape(image.GetDimensions(), order="F")

    def error(self, image, *structures, **arguments):
        result = optimizer(image, *structures, **arguments)
        result.Update()
        self.assertEqual(len(result.messages["ErrorEvent"]), 1)
        return result.messages["ErrorEvent"][0]


class TestLabels(StructuresTest):
    def test_with_gaps_have_the_importance_of_their_structures(self):
        labels = np.random.default_rng(1).choice([0, 3, 1034, 65535], (7, 5, 6))
        for kind in (np.uint16, np.int32, np.uint32, np.int64, np.float32, np.float64):
            with self.subTest(kind=kind):
                found = self.importance(labelled(labels.astype(kind)), (3, "a", 1.0),
                                        (65535, "b", 0.25))

                np.testing.assert_array_equal(
                    found, np.where(labels == 3, 1, np.where(labels == 65535, 0.25, 0)))

    def test_of_eight_bits_and_below_zero_count(self):
        labels = np.random.default_rng(2).integers(-3, 4, (6, 5, 4))
        found = self.importance(labelled(labels.astype(np.int8)), (-2, "a", 0.5), (3, "b", 1.0))

        np.testing.assert_array_equal(found, np.where(labels == -2, 0.5, labels == 3))

    def test_that_touch_do_not_become_those_between(self):
        labels = np.full((8, 6, 6), 1)
        labels[4:] = 3
        self.assertEqual(self.importance(labelled(labels), (2, "between", 1.0)).max(), 0)

    def test_that_are_nan_are_none(self):
        labels = np.full((6, 6, 6), 2.0)
        labels[3:] = np.nan
        image = labelled(labels)
        found = self.importance(image, (2, "a", 1.0))

        np.testing.assert_array_equal(found, np.where(labels == 2, 1, 0))

    def test_on_cells_are_those_of_the_majority(self):
        random = np.random.default_rng(3)
        labels = random.choice([0, 3, 9], (5, 4, 6))
        found = self.importance(labelled(labels, on_cells=True), (3, "a", 1.0), (9, "b", 0.5),
                                on_cells=True)

        for point in np.ndindex(*found.shape):
            around = labels[tuple(slice(max(i - 1, 0), i + 1) for i in point)].ravel()
            counts = [np.count_nonzero(around == label) for label in (3, 9, 0)]
            self.assertEqual(found[point], (1, 0.5, 0)[int(np.argmax(counts))], point)

    def test_one_cell_thin_have_points(self):
        labels = np.zeros((6, 6, 6), np.uint8)
        labels[3] = 7
        found = self.importance(labelled(labels, on_cells=True), (7, "sheet", 1.0), on_cells=True)

        np.testing.assert_array_equal(np.flatnonzero(found.max(axis=(1, 2))), [3, 4])

    def test_that_are_no_whole_numbers_are_refused(self):
        labels = np.full((5, 5, 5), 2.0)
        labels[1, 2, 3] = 2.5
        self.assertIn('The structure array "Labels" has the value 2.5',
                      self.error(labelled(labels), (2, "a", 1.0)))

    def test_that_are_missing_are_refused(self):
        image = image_of((5, 5, 5), BaseExtinction=np.ones(125))
        self.assertIn('The structure array "Labels" is not among',
                      self.error(image, (2, "a", 1.0)))

    def test_with_several_components_are_refused(self):
        image = image_of((5, 5, 5), BaseExtinction=np.ones(125), Labels=np.ones((125, 3), int))
        self.assertIn('The structure array "Labels" has 3 components',
                      self.error(image, (2, "a", 1.0)))


class TestTable(StructuresTest):
    def image(self):
        labels = np.zeros((6, 6, 6), int)
        labels[2:4], labels[4:] = 1, 2
        return labelled(labels)

    def test_takes_texts_as_properties_have_them(self):
        found = self.importance(self.image(), ("1", "a", "0.5", ""), ("2", "b", "1", "0.9"))

        np.testing.assert_array_equal(found[:, 0, 0], [0, 0, 0.5, 0.5, 1, 1])

    def test_without_rows_makes_all_labels_important_and_says_so(self):
        result = optimizer(self.image(), MaximumIterations=0)
        result.Update()

        np.testing.assert_array_equal(
            values(result.GetOutput(), "Importance"), values(self.image(), "Labels") > 0)
        self.assertEqual(len(result.messages["WarningEvent"]), 1)
        self.assertIn("all labels but 0 are equally important", result.messages["WarningEvent"][0])

    def test_that_is_changed_is_a_new_run(self):
        result = optimizer(self.image(), (1, "a", 1.0), MaximumIterations=0)
        result.Update()
        result.RemoveAllStructures()
        result.AddStructure(2, "b", 1.0)
        result.Update()

        np.testing.assert_array_equal(
            values(result.GetOutput(), "Importance"), values(self.image(), "Labels") == 2)

    def test_with_mistakes_is_refused_in_words(self):
        for words, structures in {
                "has the label \"liver\"": [("liver", "1", "1", "")],
                "The importance of the structure \"a\" is \"high\"": [("1", "a", "high", "")],
                "The target of the structure \"a\" is 1.5": [(1, "a", 1.0, 1.5)],
                "The importance of the structure \"a\" is 2": [(1, "a", 2.0)],
                "Two structures have the label 1": [(1, "a", 1.0), (1, "b", 1.0)],
                "Two structures have the name \"a\"": [(1, "a", 1.0), (2, "a", 1.0)]}.items():
            with self.subTest(words):
                self.assertIn(words, self.error(self.image(), *structures))

    def test_can_be_read_back(self):
        settings = optimizer(self.image(), (1, "a", 0.1, 0.9), ("2", "b", "1", "")) \
            .GetVisibilitySettings()

        self.assertEqual(
            [[settings.GetStructureText(row, column) for column in range(4)] for row in range(2)],
            [["1", "a", "0.10000000000000001", "0.90000000000000002"], ["2", "b", "1", ""]])


def labelled_phantom():
    """The phantom, and structures that say the same as its importance."""
    image = phantom(20)
    importance = values(image, "Importance")
    shares = [share for share in np.unique(importance) if share > 0]
    labels = np.zeros(importance.shape, np.int32)
    for number, share in enumerate(shares, 1):
        labels[importance == share] = 10 * number
    add(image.GetPointData(), "Labels", labels)
    return image, [(10 * number, f"structure {number}", float(share))
                   for number, share in enumerate(shares, 1)]


class TestScenes(StructuresTest):
    def test_are_optimised_as_by_an_importance(self):
        image, structures = labelled_phantom()
        by_labels = optimizer(image, *structures)
        by_importance = filter_on(image, vtkExtinctionOptimizer, ImportanceSmoothing=0)
        for one in (by_labels, by_importance):
            one.Update()
            self.assert_no_error(one)

        for name in ("Extinction", "Importance"):
            expected = values(by_importance.GetOutput(), name)
            np.testing.assert_allclose(values(by_labels.GetOutput(), name), expected,
                                       rtol=0, atol=16 * SINGLE * expected.max())

    def test_are_searched_as_by_an_importance(self):
        image, structures = labelled_phantom()
        by_labels = optimizer(image, *structures, filter_class=vtkViewpointSearch)
        by_importance = filter_on(image, vtkViewpointSearch, ImportanceSmoothing=0)
        for one in (by_labels, by_importance):
            one.Update()

        np.testing.assert_array_equal(
            vtk_to_numpy(by_labels.GetOutput().GetPointData().GetArray("VisibilityScore")),
            vtk_to_numpy(by_importance.GetOutput().GetPointData().GetArray("VisibilityScore")))


class TestThinStructures(StructuresTest):
    """They are no noise, which ImportanceSmoothing removes from other importance."""

    def test_are_as_important_as_others(self):
        labels = np.zeros((24, 24, 24), np.uint8)
        labels[:, 12, 12] = 1  # across the view
        image = labelled(labels)
        result = optimizer(image, (1, "line", 1.0), Preset="Default")
        self.assertEqual(result.GetImportanceSmoothing(), result.MEDIAN)
        result.Update()

        self.assert_no_error(result)
        data = result.GetOutput().GetFieldData()
        base, fraction = (data.GetArray(name).GetTuple1(0)
                          for name in ("BaseVisibleFraction", "VisibleFraction"))
        self.assertGreater(fraction, 10 * base)


LAYERS = [(3, "rim", 0.25), (1034, "middle", 0.5), (65535, "core", 1.0)]


def layered_phantom():
    """The phantom with the labels of LAYERS."""
    image = phantom(20)
    labels = np.array([0, 3, 1034, 65535])[
        np.digitize(values(image, "Importance"), [0.01, 0.3, 0.6])]
    add(image.GetPointData(), "Labels", labels)
    return image


def columns_of(table):
    return {table.GetColumnName(i): table.GetColumn(i) for i in range(table.GetNumberOfColumns())}


class TestShares(StructuresTest):
    """What is seen of each structure."""

    def run_filter(self, *structures, **properties):
        result = optimizer(layered_phantom(), *(structures or LAYERS), **properties)
        result.Update()
        self.assert_no_error(result)
        self.warnings = result.messages["WarningEvent"]
        return result.GetOutput(), columns_of(result.GetStructureTable())

    def test_have_a_row_each(self):
        _, columns = self.run_filter()
        names = [name for _, name, _ in LAYERS]

        self.assertEqual(vtk_to_numpy(columns["Label"]).tolist(),
                         [label for label, _, _ in LAYERS])
        self.assertEqual([columns["Name"].GetValue(i) for i in range(3)], names)
        self.assertEqual(vtk_to_numpy(columns["Target"]).tolist(), [-1, -1, -1])
        self.assertEqual(list(columns), [
            "Label", "Name", "Importance", "Target", "Visible", "BaseVisible", "Removed",
            "Attainable", "HiddenByOther", *(f"HiddenBy{name}" for name in names), "Weight"])

    def test_add_up(self):
        output, columns = self.run_filter()
        hidden = sum(vtk_to_numpy(column) for name, column in columns.items()
                     if name.startswith("HiddenBy"))
        visible, removed = (vtk_to_numpy(columns[name]) for name in ("Visible", "Removed"))

        np.testing.assert_allclose(visible + removed + hidden, 1, atol=1e-5)  # rounding of float
        self.assertTrue((visible <= vtk_to_numpy(columns["Attainable"]) + 1e-5).all())
        fraction = output.GetFieldData().GetArray("VisibleFraction").GetTuple1(0)
        self.assertTrue(visible.min() <= fraction <= visible.max())
        self.assertGreater(visible.max(), vtk_to_numpy(columns["BaseVisible"]).max())

    def test_of_a_structure_called_other_are_not_those_of_other_matter(self):
        _, columns = self.run_filter((65535, "Other", 1.0), LAYERS[0])
        hidden = [vtk_to_numpy(columns[name]) for name in columns if name.startswith("HiddenBy")]

        self.assertIn("HiddenByOther 65535", columns)
        np.testing.assert_allclose(
            sum(hidden) + vtk_to_numpy(columns["Visible"]) + vtk_to_numpy(columns["Removed"]), 1,
            atol=1e-5)

    def test_of_one_structure_are_those_of_the_score(self):
        output, columns = self.run_filter((65535, "core", 1.0))
        data = output.GetFieldData()

        for column, name in (("Visible", "VisibleFraction"), ("BaseVisible", "BaseVisibleFraction"),
                             ("Removed", "SacrificedFraction"), ("Attainable", "AttainableFraction")):
            self.assertAlmostEqual(columns[column].GetTuple1(0), data.GetArray(name).GetTuple1(0),
                                   delta=1e-5)

    def test_that_are_not_in_the_data_are_zero(self):
        _, columns = self.run_filter((65535, "core", 1.0), (777, "nowhere", 1.0, 0.5))

        for name in ("Visible", "Removed", "Attainable", "HiddenByOther"):
            self.assertEqual(columns[name].GetTuple1(1), 0)
        self.assertEqual(columns["Target"].GetTuple1(1), 0.5)
        self.assertEqual(len(self.warnings), 1)
        self.assertIn("there is nothing to see in the image: nowhere (", self.warnings[0])

    def test_without_targets_weigh_what_they_are_given(self):
        output, columns = self.run_filter()

        np.testing.assert_array_equal(vtk_to_numpy(columns["Weight"]), [0.25, 0.5, 1])
        self.assertIsNone(output.GetFieldData().GetAbstractArray("Targets"))

    def test_reach_their_targets(self):
        settings = {"ProtectImportance": 0}
        _, before = self.run_filter(**settings)
        wanted = 0.5 * (before["Visible"].GetTuple1(0) + before["Attainable"].GetTuple1(0))
        output, columns = self.run_filter((3, "rim", 0.25, wanted), *LAYERS[1:], **settings)

        self.assertGreaterEqual(columns["Visible"].GetTuple1(0), wanted - 0.001)
        np.testing.assert_array_equal(vtk_to_numpy(columns["Importance"]), [0.25, 0.5, 1])
        weights = vtk_to_numpy(columns["Weight"])
        self.assertGreater(weights[0] / weights[2], 0.25)
        self.assertEqual(self.warnings, [])
        text = output.GetFieldData().GetAbstractArray("Targets").GetValue(0)
        self.assertRegex(text, r"^rim \d+\.\d % \(>= \d+\.\d %\)$")
        self.assertEqual(values(output, "Importance").max(), np.float32(weights.max()))

    def test_lose_their_protection_where_targets_ask_for_it(self):
        _, before = self.run_filter()
        wanted = before["Visible"].GetTuple1(0) + 0.005
        _, columns = self.run_filter((3, "rim", 0.25, wanted), *LAYERS[1:])

        self.assertGreaterEqual(columns["Visible"].GetTuple1(0), wanted - 0.001)
        self.assertEqual(len(self.warnings), 1)
        self.assertIn("ProtectImportance is not used", self.warnings[0])

    def test_above_a_ceiling_are_refused_with_it_and_a_better_view(self):
        _, columns = self.run_filter((3, "rim", 0.25, 1.0), *LAYERS[1:])

        most = columns["Attainable"].GetTuple1(0)
        self.assertEqual(len(self.warnings), 1)
        self.assertIn(f'The target of "rim" is 100.0 %, and at most {100 * most:.1f} %',
                      self.warnings[0])
        np.testing.assert_array_equal(vtk_to_numpy(columns["Weight"]), [0.25, 0.5, 1])

    def test_of_methods_that_do_not_iterate_are_not_aimed_at(self):
        _, columns = self.run_filter((65535, "core", 0.5, 0.3),
                                     Method=vtkExtinctionOptimizer.ORDINARY)

        self.assertEqual(columns["Weight"].GetTuple1(0), 0.5)
        self.assertEqual(len(self.warnings), 1)
        self.assertIn("the method Ordinary does not aim at targets", self.warnings[0])

    def test_are_aimed_at_until_an_abort(self):
        image = phantom(20)
        add(image.GetPointData(), "Labels", (values(image, "Importance") > 0.3).astype(np.uint8))
        result = optimizer(image, (1, "a", 0.05))
        result.Update()
        most = result.GetStructureTable().GetColumnByName("Attainable").GetTuple1(0)
        result.RemoveAllStructures()
        result.AddStructure(1, "a", 0.05, 0.999 * most)
        texts = []

        def progress(caller, _):
            texts.append(caller.GetProgressText())
            if texts[-1] and "target" in texts[-1]:
                caller.SetAbortExecute(1)

        result.AddObserver("ProgressEvent", progress)
        result.Update()

        self.assertTrue(any(text and "target" in text for text in texts))
        self.assertIsNone(result.GetOutput().GetPointData().GetArray("Extinction"))

    def test_without_labels_are_no_rows(self):
        result = filter_on(phantom(20), vtkExtinctionOptimizer)
        result.Update()
        self.assertEqual(result.GetStructureTable().GetNumberOfRows(), 0)


class TestMapper(MapperTest):
    def test_are_drawn_as_by_an_importance(self):
        image, structures = labelled_phantom()
        view, mapper = show(image, ImportanceSmoothing=0)
        expected = view.picture()
        fraction = mapper.GetVisibleFraction()
        view, mapper = show(image)
        mapper.SetInputArrayToProcess(LABELS, 0, 0, POINTS, "Labels")
        for structure in structures:
            mapper.AddStructure(*structure)

        self.assertLessEqual(np.abs(view.picture().astype(int) - expected).max(), 1)  # of 255
        self.assertAlmostEqual(mapper.GetVisibleFraction(), fraction, delta=16 * SINGLE)
        self.assert_fine(view)

        mapper.RemoveAllStructures()
        self.assert_says(view, "all labels but 0 are equally important")
        view.messages.clear()
        mapper.AddStructure("x", "a", "1", "")
        self.assert_says(view, 'has the label "x"')
        view.messages.clear()
        mapper.SetInputArrayToProcess(LABELS, 0, 0, POINTS, "Absent")
        self.assert_says(view, 'The structure array "Absent" is not among')


class TestSharesOfMapper(MapperTest):
    """What the camera of the last picture sees of each structure."""

    SETTINGS = {"LightWeight": 0, "RestrictToView": 0}

    def show(self, **properties):
        image = layered_phantom()
        image.GetPointData().SetActiveScalars("Scalars")
        view, mapper = show(image, **self.SETTINGS, **properties)
        mapper.SetExtinctionSource(mapper.ARRAY)
        mapper.SetExtinctionArray("BaseExtinction")
        mapper.SetInputArrayToProcess(LABELS, 0, 0, POINTS, "Labels")
        for structure in LAYERS:
            mapper.AddStructure(*structure)
        return view, mapper

    def test_reach_their_targets(self):
        view, mapper = self.show(ProtectImportance=0)
        view.picture()
        columns = columns_of(mapper.GetStructureTable())
        before = columns["Visible"].GetTuple1(0)
        wanted = before + 0.3 * (columns["Attainable"].GetTuple1(0) - before)
        (label, name, importance), *others = LAYERS
        mapper.RemoveAllStructures()
        for structure in ((label, name, importance, wanted), *others):
            mapper.AddStructure(*structure)
        view.picture()
        columns = columns_of(mapper.GetStructureTable())

        self.assertTrue(mapper.GetConverged())
        self.assertGreaterEqual(columns["Visible"].GetTuple1(0), wanted - 0.001)
        self.assertEqual(columns["Importance"].GetTuple1(0), importance)
        weights = vtk_to_numpy(columns["Weight"])
        self.assertGreater(weights[0] / weights[2], importance / others[1][2])
        self.assert_fine(view)

        # Another view begins with the importances that were found.
        camera = view.renderer.GetActiveCamera()
        camera.Azimuth(5)
        view.picture()
        self.assertTrue(mapper.GetConverged())
        columns = columns_of(mapper.GetStructureTable())
        self.assertGreaterEqual(columns["Visible"].GetTuple1(0), wanted - 0.001)
        self.assert_fine(view)

    def test_reach_targets_in_the_mean_of_several_views(self):
        settings = {"ProtectImportance": 0, "Views": 1, "EyeAngle": 60}
        view, mapper = self.show(**settings)
        free = self.filtered(view, **settings)
        wanted = 0.7 * free["Visible"].GetTuple1(0) + 0.3 * free["Attainable"].GetTuple1(0)
        structures = ((*LAYERS[0], wanted), *LAYERS[1:])
        mapper.RemoveAllStructures()
        for structure in structures:
            mapper.AddStructure(*structure)
        view.picture()

        self.assertTrue(mapper.GetConverged())
        found = self.filtered(view, structures, **settings)
        self.assertGreaterEqual(found["Visible"].GetTuple1(0), wanted - 0.001)
        np.testing.assert_array_equal(
            vtk_to_numpy(columns_of(mapper.GetStructureTable())["Weight"]),
            vtk_to_numpy(found["Weight"]))
        self.assert_fine(view)

    def test_say_which_targets_are_not_met(self):
        view, mapper = self.show()
        mapper.AddStructure(99, "nowhere", 1.0, 0.5)
        view.picture()
        self.assert_fine(view)
        (label, name, importance), *others = LAYERS
        mapper.RemoveAllStructures()
        mapper.AddStructure(label, name, importance, 1.0)
        self.assert_says(view, f'No opacity shows as much of "{name}" from here')

    def filtered(self, view, structures=LAYERS, **properties):
        """The table of the filter for the camera of a view."""
        result = optimizer(layered_phantom(), *structures, **self.SETTINGS, **properties,
                           **placement_of(view))
        result.Update()
        return columns_of(result.GetStructureTable())

    def assert_same(self, table, expected):
        found = columns_of(table)
        self.assertEqual(list(found), list(expected))
        self.assertEqual([found["Name"].GetValue(i) for i in range(3)],
                         [name for _, name, _ in LAYERS])
        for name in set(found) - {"Name"}:
            np.testing.assert_array_equal(
                vtk_to_numpy(found[name]), vtk_to_numpy(expected[name]), name)

    def test_are_those_of_the_filter(self):
        view, mapper = self.show()
        view.window.Render()

        self.assert_same(mapper.GetStructureTable(), self.filtered(view))
        self.assert_fine(view)

    def test_are_found_once_for_a_picture(self):
        view, mapper = self.show()
        self.assertTrue(mapper.GetStructuresMeasured())  # there is nothing to measure yet
        self.assertEqual(mapper.GetStructureTable().GetNumberOfRows(), 0)
        view.window.Render()
        self.assertFalse(mapper.GetStructuresMeasured())
        mapper.GetStructureTable()
        self.assertTrue(mapper.GetStructuresMeasured())
        view.window.Render()
        self.assertTrue(mapper.GetStructuresMeasured())

        view.renderer.GetActiveCamera().Azimuth(30)
        view.window.Render()
        self.assertFalse(mapper.GetStructuresMeasured())
        self.assert_same(mapper.GetStructureTable(), self.filtered(view))

    def test_are_unknown_until_the_picture_has_converged(self):
        view, mapper = self.show(ProgressiveStill=1, InteractiveFrameTime=1e-3)
        view.window.Render()
        self.assertFalse(mapper.GetConverged())
        columns = columns_of(mapper.GetStructureTable())
        self.assertEqual(list(columns), ["Label", "Name", "Importance", "Target", "Weight"])

        self.frames_to_the_end(view, mapper)
        self.assert_same(mapper.GetStructureTable(), self.filtered(view))

    def test_of_the_original_are_those_before(self):
        view, mapper = self.show()
        view.window.Render()
        mapper.SetOptimization(mapper.OFF)
        view.window.Render()
        columns = columns_of(mapper.GetStructureTable())
        expected = vtk_to_numpy(self.filtered(view)["BaseVisible"])

        for name in ("Visible", "BaseVisible"):
            np.testing.assert_array_equal(vtk_to_numpy(columns[name]), expected)
        self.assertEqual(vtk_to_numpy(columns["Removed"]).tolist(), [0, 0, 0])

    def test_stay_unknown_if_the_user_aborts(self):
        view, mapper = self.show()
        view.window.Render()
        abort = view.window.AddObserver(
            "AbortCheckEvent", lambda window, _: window.SetAbortRender(1))
        self.assertNotIn("Visible", columns_of(mapper.GetStructureTable()))
        view.window.RemoveObserver(abort)
        view.window.Render()
        self.assertIn("Visible", columns_of(mapper.GetStructureTable()))

    def test_behind_opaque_geometry_are_hidden(self):
        view, mapper = self.show()
        view.window.Render()
        free = columns_of(mapper.GetStructureTable())
        middle = np.array(layered_phantom().GetCenter())
        eye = np.array(view.renderer.GetActiveCamera().GetPosition())
        wall = actor_of(sphere(middle + 0.65 * (eye - middle), 0.3 * np.linalg.norm(eye - middle)))
        view.renderer.AddActor(wall)
        view.window.Render()
        self.assertFalse(mapper.GetStructuresMeasured())
        hidden = columns_of(mapper.GetStructureTable())

        for name in ("Visible", "BaseVisible", "Attainable"):
            self.assertTrue((vtk_to_numpy(free[name]) > 0.01).all())
            self.assertEqual(vtk_to_numpy(hidden[name]).max(), 0)
        self.assertAlmostEqual(mapper.GetVisibleFraction(), 0)
        np.testing.assert_array_equal(vtk_to_numpy(hidden["Removed"]),
                                      vtk_to_numpy(free["Removed"]))
        np.testing.assert_allclose(vtk_to_numpy(hidden["HiddenByOther"]),
                                   1 - vtk_to_numpy(free["Removed"]), atol=1e-9)
        view.renderer.RemoveActor(wall)
        view.window.Render()
        self.assertEqual(columns_of(mapper.GetStructureTable())["Visible"].GetTuple1(0),
                         free["Visible"].GetTuple1(0))

    def test_half_behind_opaque_geometry_are_as_the_score_says(self):
        view, mapper = self.show()
        mapper.RemoveAllStructures()
        mapper.AddStructure(65535, "core", 1.0)
        middle = np.array(layered_phantom().GetCenter())
        view.renderer.AddActor(actor_of(sphere(middle + [0.35, 0, 0], 0.3)))
        view.window.Render()
        columns = columns_of(mapper.GetStructureTable())

        for column, share in (("Visible", mapper.GetVisibleFraction()),
                              ("BaseVisible", mapper.GetBaseVisibleFraction()),
                              ("Attainable", mapper.GetAttainableFraction())):
            # Points are in front or behind; in the score, those at the edge are partly so.
            self.assertAlmostEqual(columns[column].GetTuple1(0) / share, 1, delta=0.05)

    def test_are_picked_where_they_are_seen(self):
        labels = np.ones((12, 12, 12), int)
        labels[6:] += 1
        labels[:, :, 6:] += 2
        labels[:, 8:] = 9  # behind them
        image = labelled(labels)
        image.GetPointData().SetActiveScalars("BaseExtinction")
        view, mapper = show(image, gray_property())
        mapper.SetInputArrayToProcess(LABELS, 0, 0, POINTS, "Labels")
        for label in (9, 1, 2, 3, 4):
            mapper.AddStructure(label, f"structure {label}", 0.5)
        self.assertEqual(mapper.PickStructure(0.5, 0.5), -1)  # there is no picture yet
        camera = view.renderer.GetActiveCamera()
        camera.SetPosition(5.5, -40, 5.5)
        camera.SetFocalPoint(5.5, 5.5, 5.5)
        camera.SetViewUp(0, 0, 1)
        view.renderer.ResetCameraClippingRange()
        view.window.Render()

        for x, z, row in ((3, 3, 1), (8, 3, 2), (3, 8, 3), (8, 8, 4)):
            view.renderer.SetWorldPoint(x, 0, z, 1)
            view.renderer.WorldToView()
            right, up, _ = view.renderer.GetViewPoint()
            self.assertEqual(mapper.PickStructure((right + 1) / 2, (up + 1) / 2), row)
        self.assertEqual(mapper.PickStructure(0.02, 0.5), -1)  # beside the volume

    def test_need_structures(self):
        view, mapper = show()
        view.window.Render()
        self.assertTrue(mapper.GetStructuresMeasured())
        self.assertEqual(mapper.GetStructureTable().GetNumberOfColumns(), 0)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A time series that is played as in a window on a busy machine: there is no time for more than to
# begin, and no frame shows less of the important structures than the original of its step does.

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import colors_of, difference, image_of, opacity_of, property_of

STEPS = 20
FAST = 1e-6  # seconds per frame, so that pictures are as coarse as they can be


AZIMUTH, ELEVATION = np.radians(35), np.radians(20)
TO_EYE = (np.sin(AZIMUTH) * np.cos(ELEVATION), np.sin(ELEVATION),
          np.cos(AZIMUTH) * np.cos(ELEVATION))  # where View.look stands


def step(number, resolution=24):
    """A hot core in a haze that goes to and fro between the eye and the back, and so comes to where
    the haze was cleared to show it."""
    places = np.meshgrid(*3 * [np.linspace(-1, 1, resolution)], indexing="ij")
    way = 0.5 * np.sin(0.9 * number)
    distance = np.sqrt(sum((place - way * along) ** 2 for place, along in zip(places, TO_EYE)))
    haze = np.where(sum(place ** 2 for place in places) < 0.9, 0.3, 0)
    core = np.exp(-(distance / 0.2) ** 4)
    heat = np.maximum(haze, core).astype(np.float32).ravel(order="F")
    image = image_of(3 * (resolution,), 3 * (2 / (resolution - 1),), (-1, -1, -1), Heat=heat)
    image.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), number)
    return image


def heat_property():
    return property_of(colors_of((0, 0.3, 0.3, 0.6), (1, 1, 0.3, 0)),
                       opacity_of((0, 0), (0.3, 0.15), (1, 0.6)), 0.1)


def played(method, **settings):
    view, mapper = show(step(0), heat_property(), Method=method, ImportanceArray="Heat", Shadows=0,
                        **settings)
    mapper.SetImportanceFunction(opacity_of((0.4, 0), (0.8, 1)))
    mapper.UseImportanceFunctionOn()
    return view, mapper


class TestPlaying(MapperTest):
    def play(self, look, moves=False, **settings):
        """Plays steps of which the first one was finished. Calls `look(number, mapper, view)` after
        each of three frames of a step."""
        view, mapper = played(Mapper.OPTIMIZED, ProgressiveStill=1, InteractiveFrameTime=FAST,
                              **settings)
        self.frames_to_the_end(view, mapper)
        self.assertGreater(mapper.GetVisibleFraction(), 1.2 * mapper.GetBaseVisibleFraction())
        view.interact(moves)
        for number in range(1, STEPS):
            mapper.SetInputData(step(number))
            for frame in range(3):
                view.window.Render()
                look(number, frame, mapper, view)
        self.assert_fine(view)

    def ordinary_steps(self):
        """Visible shares and first frames of the original."""
        view, mapper = played(Mapper.ORDINARY, ProgressiveStill=1, InteractiveFrameTime=FAST)
        shares, pictures = [], []
        for number in range(STEPS):
            mapper.SetInputData(step(number))
            pictures.append(view.picture())
            shares.append(mapper.GetVisibleFraction())
        return shares, pictures

    def test_no_frame_shows_less_than_the_original_of_its_step(self):
        ordinary, pictures = self.ordinary_steps()
        for coherence in (0, 0.5):
            for ease in (0, 100):
                originals = []

                def look(number, frame, mapper, view):
                    self.assertAlmostEqual(mapper.GetBaseVisibleFraction(), ordinary[number], 6)
                    self.assertGreaterEqual(mapper.GetVisibleFraction(),
                                            mapper.GetBaseVisibleFraction())
                    if mapper.GetVisibleFraction() == mapper.GetBaseVisibleFraction():
                        originals.append(number)
                        if frame == 0:  # and what it shows is what it says
                            np.testing.assert_array_equal(view.pixels(), pictures[number])
                with self.subTest(coherence=coherence, ease=ease):
                    self.play(look, TemporalCoherence=coherence, EaseTime=ease)
                    self.assertGreaterEqual(len(set(originals)), STEPS // 4)

    def test_nor_while_the_view_moves(self):
        def look(_, __, mapper, ___):
            self.assertGreaterEqual(mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction())
        for coherence in (0, 0.5, 100):
            with self.subTest(coherence=coherence):
                self.play(look, moves=True, TemporalCoherence=coherence, EaseTime=0.3)

    def test_where_the_series_stops_it_is_as_if_it_had_not_been_played(self):
        view, mapper = played(Mapper.OPTIMIZED, ProgressiveStill=1, InteractiveFrameTime=FAST,
                              TemporalCoherence=0)
        self.frames_to_the_end(view, mapper)
        for number in range(1, STEPS):
            mapper.SetInputData(step(number))
            view.window.Render()
        self.frames_to_the_end(view, mapper)
        fresh, other = played(Mapper.OPTIMIZED, TemporalCoherence=0)
        other.SetInputData(step(STEPS - 1))
        self.assertEqual(difference(view.pixels(), fresh.picture()), 0)
        self.assertEqual(mapper.GetVisibleFraction(), other.GetVisibleFraction())

    def test_a_change_that_still_serves_is_carried_on(self):
        view, mapper = played(Mapper.OPTIMIZED, ProgressiveStill=1, InteractiveFrameTime=FAST)
        self.frames_to_the_end(view, mapper)
        before = mapper.GetVisibleFraction()
        mapper.SetInputData(step(0.05))
        view.window.Render()
        self.assertFalse(mapper.GetConverged())
        self.assertGreater(mapper.GetVisibleFraction(), 0.8 * before)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" drawn by a pvserver: the client shows the same picture
# and knows the same scores and messages as if it had drawn it itself.

import gc
import os
import shutil
import unittest

import numpy as np
from paraview import simple

import displays
import pictures
import runner
from server import Server

PLUGIN = os.environ["LIMPID_PLUGIN"]
INFORMATION = ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction", "BaseVisibleFraction",
               "SacrificedFraction", "AttainableFraction", "AttainableScore", "Converged", "Iterations", "LightDescription", "Messages")


def load_plugin():
    simple.LoadPlugin(PLUGIN, remote=False, ns=globals())
    vars(simple).update(OcclusionPhantom=OcclusionPhantom)


def information_of(display):
    display.SMProxy.UpdatePropertyInformation()
    return {name: getattr(display, name) for name in INFORMATION}


class Shown:
    """What the client has of a view: the picture, and what the display says about it."""

    def __init__(self, view, display):
        self.picture = pictures.take(view)
        self.information = information_of(display)


def new_view():
    view = displays.new_view()
    view.UseFXAA = 0  # ParaView does that to the server's picture in another way than to its own
    return view


def optimized(view):
    return Shown(view, displays.show_head(view))


def with_score(view):
    return Shown(view, displays.show_head(view, ShowScore=1, ScoreInScreenshots=1))


def two_with_scores(view):
    for name, x in (("one", -1.2), ("another", 1.2)):
        source = OcclusionPhantom(Resolution=24, registrationName=name)
        display = displays.show(source, view)
        displays.move(display, [x, 0, 0])
        display.ShowScore = display.ScoreInScreenshots = 1
    return Shown(view, display)


def with_own_light(view):
    return Shown(view, displays.show_head(view, Mode="Separate", LightSource="Own", Jitter=1,
                                          LightPosition=[-2.5, -4.5, 4.5]))


def after_moving(view):
    display = displays.show_head(view)
    for position in displays.POSITIONS:
        displays.look(view, position)
        view.SMProxy.UpdateVTKObjects()
        view.SMProxy.InteractiveRender()
    return Shown(view, display)


def in_motion(view):
    """What the display says of moving frames, and the picture when they are over."""
    display = displays.show_head(view, InteractiveFrameTime=10)  # enough for the finest previews
    simple.Render(view)
    moving = []
    for position in displays.POSITIONS[1:]:
        displays.look(view, position)
        view.SMProxy.UpdateVTKObjects()
        view.SMProxy.InteractiveRender()
        moving.append(information_of(display))
    shown = Shown(view, display)
    shown.information = {"at rest": shown.information, "moving": moving}
    return shown


def by_importance_function(view):
    display = displays.show_head(view, UseImportanceFunction=1,
                                 ImportanceArray=["POINTS", "(Color Array)"])
    display.ImportanceFunction.Points = [0, 0, 0.5, 0, 0.7, 0, 0.5, 0, 1, 1, 0.5, 0]
    return Shown(view, display)


def hidden_and_shown(view):
    source = OcclusionPhantom(Resolution=32)
    display = displays.show(source, view)
    simple.Render(view)
    simple.Hide(source, view)
    simple.Render(view)
    simple.Show(source, view)
    return Shown(view, display)


def of_its_own_choice(view):
    source = OcclusionPhantom(Resolution=32)
    source.UpdatePipeline()
    display = simple.Show(source, view)
    display.SetRepresentationType("Optimized Volume")
    return Shown(view, display)


def by_another_method(view):
    return Shown(view, displays.show_head(view, Method="Viola 2004"))


def without_importance(view):
    return Shown(view, displays.show_head(view, ImportanceArray=["POINTS", "nothing"]))


def ordinary(view, position=displays.POSITIONS[0]):
    displays.look(view, position)
    return Shown(view, displays.show_head(view, Method="Ordinary", Shadows=0))


def ordinary_from_above(view):
    return ordinary(view, displays.POSITIONS[1])


def ordinary_from_the_side(view):
    return ordinary(view, [5, 0.3, 0.2])  # onto the edge where two pieces meet


def with_a_white_box(view):
    display = displays.show_head(view)
    # Pieces of a Sphere have coordinates rounded in their own way, so that the depths differ.
    box = simple.Box(Center=[0.3, -0.4, 0.3], XLength=0.5, YLength=0.5, ZLength=0.5)
    simple.Show(box, view).AmbientColor = [1, 1, 1]
    simple.Render(view)
    return Shown(view, display)


def in_a_corner(view):
    display = displays.show_head(view)
    camera = view.GetActiveCamera()
    camera.Yaw(12)
    camera.Pitch(9)
    simple.Render(view)
    return Shown(view, display)


def turned_away(view):
    display = displays.show_head(view)
    for _ in range(2):
        view.GetActiveCamera().Yaw(180)  # and back
        simple.Render(view)
    return Shown(view, display)


STORIES = (optimized, with_score, with_own_light, after_moving, in_motion,
           by_importance_function, hidden_and_shown, of_its_own_choice, by_another_method, without_importance, ordinary)
STORIES_OF_SEVERAL = (optimized, with_own_light, after_moving, in_motion,
                      by_importance_function, hidden_and_shown, of_its_own_choice, without_importance, ordinary,
                      ordinary_from_above, ordinary_from_the_side, with_a_white_box, in_a_corner,
                      turned_away)


def tell(stories):
    shown = {}
    for story in stories:
        displays.clear()
        shown[story.__name__] = story(new_view())
    displays.clear()
    return shown


class ServerTest(unittest.TestCase):
    """Tells stories without a server and with one, and keeps what was shown."""

    processes = 1
    stories = ()

    @classmethod
    def setUpClass(cls):
        load_plugin()
        cls.here = tell(cls.stories)
        with Server(cls.processes) as server:
            simple.Connect("localhost", server.port)
            simple.LoadPlugin(PLUGIN, remote=True)
            load_plugin()
            cls.there = tell(cls.stories)
            simple.Connect()  # without a server: that one has nobody left
            gc.collect()
            cls.exit_code = server.wait(20 if runner.PARAVIEW < (6, 1) else 0)
            cls.output = server.output()

    def check_that_the_server_ends_with_the_client(self):
        if runner.PARAVIEW >= (6, 1):
            self.skipTest("pvserver 6.1 does not exit with its client after a plugin was loaded")
        self.assertEqual(self.exit_code, 0, self.output)
        self.assertNotIn("FATL", self.output)


class TestOneServer(ServerTest):
    stories = (*STORIES, two_with_scores)

    def test_pictures_are_those_of_the_client_alone(self):
        for name in (story.__name__ for story in STORIES):
            with self.subTest(name):
                # The same program on the same machine, and pictures at rest travel unchanged.
                np.testing.assert_array_equal(self.there[name].picture, self.here[name].picture)

    def test_scores_have_the_names_that_the_client_knows(self):
        # Where one volume is blended over the other one, a step of rounding may be between them.
        # A letter differs by a hundred.
        np.testing.assert_allclose(self.there["two_with_scores"].picture,
                                   self.here["two_with_scores"].picture, rtol=0, atol=1)

    def test_information_is_that_of_the_client_alone(self):
        for name, here in self.here.items():
            with self.subTest(name):
                self.assertEqual(self.there[name].information, here.information)

    def test_there_is_something_to_compare(self):
        background = 255 * np.array(displays.BACKGROUND)
        for name, there in self.there.items():
            with self.subTest(name):
                inside = np.abs(there.picture - background).max(axis=2) > 5
                self.assertGreater(inside.mean(), 0.1)
        for moving in self.there["in_motion"].information["moving"]:
            self.assertGreater(moving["VisibleFraction"], 1.5 * moving["BaseVisibleFraction"])
            self.assertEqual(moving["Iterations"], 0)  # a preview
        score = self.there["optimized"].information
        self.assertGreater(score["VisibleFraction"], score["BaseVisibleFraction"])
        self.assertEqual(score["Converged"], 1)
        self.assertEqual(score["Messages"], "")
        self.assertEqual(self.there["by_another_method"].information["Messages"], "")
        self.assertIn("nothing", self.there["without_importance"].information["Messages"])

    def test_the_server_ends_with_the_client(self):
        self.check_that_the_server_ends_with_the_client()


@unittest.skipUnless(shutil.which("mpiexec"), "there is no mpiexec")
class TestTwoServerProcesses(ServerTest):
    processes = 2
    stories = (*STORIES_OF_SEVERAL, with_score, by_another_method)

    def test_pictures_are_those_of_the_client_alone(self):
        for name in (story.__name__ for story in STORIES_OF_SEVERAL):
            with self.subTest(name):
                apart = np.abs(self.there[name].picture - self.here[name].picture)
                # Sums of the same numbers in another order, rounded once.
                self.assertLessEqual(apart.max(), 1)

    def test_information_is_that_of_the_client_alone(self):
        for name in (story.__name__ for story in (*STORIES_OF_SEVERAL, with_score)):
            with self.subTest(name):
                self.assertEqual(self.there[name].information, self.here[name].information)

    def test_the_score_is_in_the_corner(self):
        background = 255 * np.array(displays.BACKGROUND)
        picture = self.there["with_score"].picture
        corner = picture[-60:, :150] if picture[0, 0, 0] == background[0] else picture[:60, :150]
        self.assertGreater(np.abs(corner - background).max(), 100)

    def test_a_volume_behind_the_camera_is_no_error(self):
        self.assertNotIn("determinant", self.output)

    def test_what_they_cannot_do_together_is_said_once(self):
        there = self.there["by_another_method"]

        self.assertIn("several processes share the image", there.information["Messages"])
        self.assertEqual(self.output.count("several processes share the image"), 1)

    def test_the_server_ends_with_the_client(self):
        self.check_that_the_server_ends_with_the_client()


@unittest.skipUnless(shutil.which("mpiexec"), "there is no mpiexec")
class TestFourServerProcesses(TestTwoServerProcesses):
    processes = 4


del ServerTest  # it is no test itself

if __name__ == "__main__":
    runner.run()

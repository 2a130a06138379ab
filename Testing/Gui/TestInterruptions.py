# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What becomes of an optimisation that something comes in between, in ParaView's window with its
# built-in server and with a pvserver: another representation type, a deleted source, a hidden
# display, a second view, an animation, the end of the connection. Nothing may go on rendering, and
# what is still shown must reach its end.

import os
import shutil

import displays
import pictures
import story
from paraview import simple
from server import Server
from story import expect

SOON = 0.1  # seconds: an optimisation is under way then, and far from its end


def new_view():
    view = simple.CreateView("RenderView")
    simple.AssignViewToLayout(view)
    return view


def show(view, resolution=128, **source):
    """The phantom as an optimised volume, not rendered yet."""
    phantom = OcclusionPhantom(Resolution=resolution, **source)
    phantom.UpdatePipeline()
    return phantom, show_also(phantom, view)


def show_also(phantom, view):
    display = simple.Show(phantom, view)
    simple.ColorBy(display, ("POINTS", "Scalars"))
    display.SetRepresentationType("Optimized Volume")
    simple.ResetCamera(view)
    return display


def start(view):
    view.GetActiveCamera().Azimuth(20)
    simple.Render(view)
    story.live(SOON)


def nothing_is_rendered(frames, what):
    story.live(1.0)  # in which ParaView may render once more
    frames.clear()
    story.live(2.0)
    expect(frames.all() == 0, f"{what}: {frames.all()} renders in 2 s")


def other_types(view, frames):
    phantom, display = show(view)
    for name in ["Volume", "Surface", "Outline", "Slice"]:
        display.SetRepresentationType(name)
        simple.Render(view)
        display.SetRepresentationType("Optimized Volume")
        start(view)
    frames.expect_end(display, "back from other types")
    start(view)
    display.SetRepresentationType("Surface")
    simple.Render(view)
    nothing_is_rendered(frames, "another type")
    display.SetRepresentationType("Optimized Volume")
    start(view)
    simple.Delete(phantom)
    nothing_is_rendered(frames, "the source is deleted")


def hidden(view, frames):
    phantom, display = show(view)
    start(view)
    simple.Hide(phantom, view)
    simple.Render(view)
    nothing_is_rendered(frames, "hidden")
    simple.Show(phantom, view)
    simple.Render(view)
    frames.expect_end(display, "shown again")
    simple.Delete(phantom)


def two_volumes(view, frames):
    phantom, display = show(view)
    other, _ = show(view, 64, Scene="Shells")
    displays.move(simple.GetDisplayProperties(other, view), [2.5, 0, 0])
    simple.ResetCamera(view)
    start(view)
    frames.expect_end(display, "two volumes")
    # ParaView may render both before one is moved.
    said = story.take_messages()
    expect(all("overlap" in text for text in said), f"all that is said is where they are {said}")
    start(view)
    simple.Delete(other)
    simple.Render(view)
    frames.expect_end(display, "one of two volumes deleted")
    simple.Delete(phantom)


def two_views(view, frames):
    phantom, display = show(view)
    second = new_view()
    other = show_also(phantom, second)
    second_frames = story.Frames(second)
    start(view)
    start(second)
    frames.expect_end(display, "the first of two views")
    second_frames.expect_end(other, "the second of two views")
    before = story.shown(second)
    story.turn(view, 5)
    story.let_go(view)
    frames.expect_end(display, "one of two views turned")
    mean, _ = pictures.difference(before, story.shown(second))
    expect(mean == 0, f"the other one has its picture (mean absolute difference {mean:.3f})")
    start(second)
    simple.Delete(second)
    start(view)
    frames.expect_end(display, "one of two views closed")
    simple.Delete(phantom)


def animation(view, frames):
    phantom, display = show(view)
    scene = simple.GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = 4
    track = simple.GetAnimationTrack("ShadowStrength", proxy=display)
    track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=time, KeyValues=[time]) for time in (0, 1)]
    start(view)
    frames.clear()
    scene.Play()
    count = frames.all()
    expect(count <= 8, f"{count} renders while an animation of 4 frames plays")
    frames.expect_end(display, "after the animation")
    simple.Delete(track)
    simple.Delete(phantom)


def every_case(where):
    for case in [other_types, hidden, two_volumes, two_views, animation]:
        story.say(f"{where}, {case.__name__}:")
        view = new_view()
        case(view, story.Frames(view))
        simple.Delete(view)
        story.live(0.5)


def tell():
    plugins = [os.path.abspath(name) for name in ("Limpid.so", "LimpidGui.so")]
    for plugin in plugins:
        simple.LoadPlugin(plugin, remote=False, ns=globals())
    simple.Delete(simple.GetActiveView())
    every_case("built in")
    if not shutil.which("pvserver"):
        story.say("There is no pvserver: nothing is told of it.")
        yield
        return
    with Server() as server:
        simple.Connect("localhost", server.port)
        simple.LoadPlugin(plugins[0], remote=True, ns=globals())
        every_case("client and server")
        view = new_view()
        show(view)
        start(view)
        yield  # the events disconnect

        expect(server.wait(10) is not None, "disconnected in between")
        # That the client is gone is said as an error, too.
        errors = [line for line in server.output().splitlines()
                  if "ERR|" in line and "Socket" not in line and "NetworkAccess" not in line]
        expect(not errors, f"the server has nothing to complain about: {errors}")


story.begin(tell())

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A volume that is shown in two views is deleted, brought back by Undo, deleted again by Redo, and
# brought back once more: it is as it was, and nothing is said. TestDelete.xml presses. Python lets go
# of all displays before: what it holds is not deleted.

import gc

import numpy as np

import story
from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMPropertyHelper, vtkSMProxyManager
from story import expect

PROPERTIES = ("Representation", "ImportanceArray", "UseImportanceFunction", "LightWeight")

_frames = []


def views():
    return sorted(simple.GetRenderViews(), key=lambda view: view.SMProxy.GetGlobalID())


def display_of(view):
    """The server manager's: simple's would be kept."""
    found = [helper.GetAsProxy(i) for helper in [vtkSMPropertyHelper(view.SMProxy, "Representations")]
             for i in range(helper.GetNumberOfElements())]
    return next(proxy for proxy in found if proxy.GetProperty("ImportanceArray"))


def points_of(display, name):
    property = display.GetProperty(name)
    function = property.GetProxy(0) if property.GetNumberOfProxies() else None
    if not function:
        return None
    points = function.GetProperty("Points")
    return [points.GetElement(i) for i in range(points.GetNumberOfElements())]


def value_of(display, name):
    property = display.GetProperty(name)
    return [property.GetElement(i) for i in range(property.GetNumberOfElements())]


def state_of(view):
    display = display_of(view)
    display.UpdatePropertyInformation()
    state = {name: value_of(display, name) for name in PROPERTIES + ("VisibleFraction", "Messages")}
    for name in ("ImportanceFunction", "ScalarOpacityFunction"):
        state[name] = points_of(display, name)
    return state


def make_views():
    first = simple.GetActiveView()
    simple.GetLayout().SplitHorizontal(0, 0.5)
    simple.AssignViewToLayout(simple.CreateView("RenderView"))
    for view in views():
        _frames.append(story.Frames(view))
        story.listen(view)
    simple.SetActiveView(first)


def show_in_second_view():
    source = simple.GetActiveSource()
    first, second = views()
    simple.Show(source, second).SetRepresentationType("Optimized Volume")
    simple.ResetCamera(second)
    simple.Render(second)
    simple.SetActiveView(first)


def settled(what):
    expect(all(frames.settle() for frames in _frames), f"{what}: rendering ends")


def tell():
    story.load_plugins()
    make_views()
    yield

    show_in_second_view()
    settled("shown")
    before = [state_of(view) for view in views()]
    pictures = [story.shown(view) for view in views()]
    story.say(str(before))
    gc.collect()
    yield

    def expect_deleted(what):
        manager = vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
        expect(manager.GetNumberOfProxies("sources") == 0, f"{what}: the volume is gone")

    def expect_as_before(what):
        settled(what)
        for number, view in enumerate(views()):
            now = state_of(view)
            same = all(now[name] == value for name, value in before[number].items())
            expect(same, f"{what}: view {number} is as it was {'' if same else now}")
            difference = np.abs(story.shown(view) - pictures[number]).mean()
            expect(difference == 0, f"{what}: so is its picture ({difference:.3f})")

    expect_deleted("deleted")
    yield
    expect_as_before("undone")
    story.screenshot("window-undone.png")
    gc.collect()
    yield
    expect_deleted("redone")
    yield
    expect_as_before("undone again")
    simple.SetActiveSource(list(simple.GetSources().values())[0])
    story.live(1)
    yield

    points = points_of(display_of(views()[0]), "ImportanceFunction")
    expect(points != before[0]["ImportanceFunction"], f"its curve can be edited {points}")


story.begin(tell())

# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A movie through the best views of a scene.

  pvpython camera_path.py --plugin Limpid.so --output FOLDER [--scene FILE.scene.json]
                          [--frames 120] [--keys 4] [--views Orbit]

draws the volume optimized in every frame, as FOLDER/frame.0000.png and so on. In a script, with a
Camera Path of anything that a Viewpoint Search has scored, round trip or through time,

  from camera_path import animate
  simple.LoadPlugin("Limpid.so", remote=False, ns=vars(simple))
  path = simple.CameraPath(Input=simple.ViewpointSearch(Input=source, CameraViewUp=[0, 0, 1]))
  animate(path, view)
  simple.SaveAnimation("movie.png", view)

As a macro of ParaView's window (Macros > Import new macro), it animates the camera of the active
view by the selected Camera Path.
"""

import argparse
import os
import sys

from paraview import servermanager, simple


def animate(path, view):
    """Makes the view's camera go the way of a Camera Path, instead of what its animation was.
    Returns the camera's animation cue."""
    path.UpdatePipeline()
    line = servermanager.Fetch(path)
    count = line.GetNumberOfPoints()
    if count == 0:
        raise RuntimeError("The camera path is empty (no camera position is allowed). Read its message.")
    values, fields = line.GetPointData(), line.GetFieldData()
    closed = line.GetCell(0).GetNumberOfPoints() > count
    first, last = (values.GetArray("Time").GetTuple1(at) for at in (0, count - 1))
    span = 1 if closed else (last - first) or 1
    frames = []
    for number in range(count + (1 if closed else 0)):
        at = number % count
        time = values.GetArray("Time").GetTuple1(at)
        frames.append(simple.CameraKeyFrame(
            KeyTime=1 if number == count else (time - (0 if closed else first)) / span,
            Position=values.GetArray("CameraPosition").GetTuple(at),
            FocalPoint=values.GetArray("CameraFocalPoint").GetTuple(at),
            ViewUp=values.GetArray("CameraViewUp").GetTuple(at),
            ViewAngle=fields.GetArray("CameraViewAngle").GetValue(0),
            ParallelScale=fields.GetArray("CameraParallelScale").GetValue(0)))
    view.CameraParallelProjection = int(fields.GetArray("CameraParallelProjection").GetValue(0))
    track = simple.GetCameraTrack(view=view)
    track.Mode = "Interpolate Camera"
    track.KeyFrames = frames
    scene = simple.GetAnimationScene()
    if closed:
        scene.PlayMode = "Sequence"
        scene.NumberOfFrames = count + 1
    else:
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.PlayMode = "Snap To TimeSteps"
    return track


def draw(options):
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import optimize_scene  # pylint: disable=import-outside-toplevel
    import scenes  # pylint: disable=import-outside-toplevel
    import viewpoints  # pylint: disable=import-outside-toplevel

    simple.LoadPlugin(os.path.abspath(options.plugin), remote=False, ns=vars(simple))
    scene = (scenes.read_scene(simple, options.scene) if options.scene
             else scenes.phantom_scene(simple))
    scene.source.UpdatePipeline()
    os.makedirs(options.output, exist_ok=True)
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    display.Views = options.views
    search = viewpoints.search_scene(scene, 642)
    search.CameraViewUp = scene.view_up
    path = simple.CameraPath(Input=search, NumberOfFrames=options.frames,
                             NumberOfKeyViews=options.keys)
    animate(path, view)
    simple.SaveAnimation(os.path.join(options.output, "frame.png"), view,
                         ImageResolution=view.ViewSize, FrameWindow=[0, options.frames - 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--scene")
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--keys", type=int, default=4)
    parser.add_argument("--views", default="Single View", choices=("Single View", "Orbit"))
    draw(parser.parse_args())


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main()
    else:  # a macro
        animate(simple.GetActiveSource(), simple.GetActiveView())

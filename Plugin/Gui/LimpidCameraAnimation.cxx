// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidCameraAnimation.h"

#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSmartPointer.h"

#include <QCoreApplication>

#include <cstring>

namespace
{
// `set`: gives the new proxy its values. A controller knows only what it has itself begun.
template <class Set>
vtkSmartPointer<vtkSMProxy> NewProxy(
  vtkSMProxy* scene, const char* group, const char* name, const Set& set)
{
  vtkSmartPointer<vtkSMProxy> proxy;
  proxy.TakeReference(scene->GetSessionProxyManager()->NewProxy(group, name));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(proxy);
  set(proxy.Get());
  controller->PostInitializeProxy(proxy);
  proxy->UpdateVTKObjects();
  controller->RegisterAnimationProxy(proxy);
  return proxy;
}

// Returns the track of a view's camera. A view has one.
vtkSmartPointer<vtkSMProxy> CameraTrackOf(vtkSMProxy* view, vtkSMProxy* scene)
{
  vtkSMPropertyHelper tracks(scene, "Cues");
  for (unsigned int i = 0; i < tracks.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* track = tracks.GetAsProxy(i);
    if (std::strcmp(track->GetXMLName(), "CameraAnimationCue") == 0 &&
      vtkSMPropertyHelper(track, "AnimatedProxy").GetAsProxy() == view)
    {
      return track;
    }
  }
  vtkSmartPointer<vtkSMProxy> track = NewProxy(scene, "animation", "CameraAnimationCue",
    [view](vtkSMProxy* proxy) { vtkSMPropertyHelper(proxy, "AnimatedProxy").Set(view); });
  tracks.Add(track);
  scene->UpdateVTKObjects();
  return track;
}

// ParaView rolls the camera along its path, whatever the view-up is, if the path's first step is
// along the view-up. The first point stands twice, so that this step has no direction. The path is
// the same.
std::vector<double> PathThrough(const std::vector<limpid::Camera>& frames)
{
  const limpid::Vec3& first = frames.front().position;
  std::vector<double> points(&first.x, &first.x + 3);
  for (const limpid::Camera& camera : frames)
  {
    points.insert(points.end(), &camera.position.x, &camera.position.x + 3);
  }
  return points;
}

// A way through points, from the beginning on; at the end nothing new begins.
vtkSmartPointer<vtkSMProxy> KeyFrameAt(
  double time, const std::vector<limpid::Camera>& frames, vtkSMProxy* scene)
{
  const std::vector<double> points = PathThrough(frames);
  const auto set = [&](vtkSMProxy* frame)
  {
    vtkSMPropertyHelper(frame, "KeyTime").Set(time);
    vtkSMPropertyHelper(frame, "PositionPathPoints")
      .Set(points.data(), static_cast<unsigned int>(points.size()));
    vtkSMPropertyHelper(frame, "ClosedPositionPath").Set(1);
    vtkSMPropertyHelper(frame, "FocalPathPoints").Set(&frames.front().focalPoint.x, 3);
    vtkSMPropertyHelper(frame, "ViewUp").Set(&frames.front().viewUp.x, 3);
    vtkSMPropertyHelper(frame, "ViewAngle").Set(frames.front().viewAngle);
    vtkSMPropertyHelper(frame, "ParallelScale").Set(frames.front().parallelScale);
  };
  return NewProxy(scene, "animation_keyframes", "CameraKeyFrame", set);
}

void SetKeyFrames(vtkSMProxy* track, const std::vector<limpid::Camera>& frames, vtkSMProxy* scene)
{
  vtkSMPropertyHelper keyFrames(track, "KeyFrames");
  std::vector<vtkSmartPointer<vtkSMProxy>> before;
  for (unsigned int i = 0; i < keyFrames.GetNumberOfElements(); ++i)
  {
    before.emplace_back(keyFrames.GetAsProxy(i));
  }
  const vtkSmartPointer<vtkSMProxy> now[] = { KeyFrameAt(0, frames, scene),
    KeyFrameAt(1, frames, scene) };
  keyFrames.RemoveAllValues();
  for (vtkSMProxy* each : now)
  {
    keyFrames.Add(each);
  }
  constexpr int pathBased = 1;
  vtkSMPropertyHelper(track, "Mode").Set(pathBased);
  track->UpdateVTKObjects();
  vtkNew<vtkSMParaViewPipelineController> controller;
  for (vtkSMProxy* each : before)
  {
    controller->UnRegisterAnimationProxy(each);
  }
}
}

void AnimateCamera(vtkSMRenderViewProxy* view, const std::vector<limpid::Camera>& frames)
{
  vtkNew<vtkSMParaViewPipelineController> controller;
  vtkSMProxy* scene = controller->GetAnimationScene(view->GetSession());
  if (!scene || frames.empty())
  {
    return;
  }
  SCOPED_UNDO_SET(QCoreApplication::translate("LimpidCameraAnimation", "Make Movie"));
  const vtkSmartPointer<vtkSMProxy> track = CameraTrackOf(view, scene);
  SetKeyFrames(track, frames, scene);
  {
    SM_SCOPED_TRACE(CreateAnimationTrack).arg("cue", track);
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", scene);
  constexpr int sequence = 0;
  vtkSMPropertyHelper(scene, "PlayMode").Set(sequence);
  vtkSMPropertyHelper(scene, "NumberOfFrames").Set(static_cast<int>(frames.size()) + 1);
  scene->UpdateVTKObjects();
}

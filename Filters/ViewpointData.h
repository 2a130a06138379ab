// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a search for viewpoints has found, as surfaces, points and lines.

#ifndef limpid_ViewpointData_h
#define limpid_ViewpointData_h

#include "DirectionSphere.h"

#include "viewpoint/FittedCamera.h"
#include "viewpoint/Search.h"

#include <string>
#include <vector>

class vtkFieldData;
class vtkPolyData;

namespace limpid
{
struct FoundViews
{
  DirectionSphere sphere;
  Vec3 sphereCentre{ 0.0 };
  double sphereRadius = 1;   ///< [length]
  Orbit orbit;               ///< where views are scored
  std::vector<Vec3> corners; ///< of the image's box
  Aim aim = Aim::Box;
  std::vector<ScoredView> samples; ///< one per direction of the sphere
  SearchResult search;
  bool isAttainable = false; ///< whether scores are ceilings
  double seconds = 0;
  double unitDistance = 1; ///< of opacities [length]
  std::string backend;

  /// The camera to look through.
  Camera CameraOf(const ScoredView& view) const
  {
    return FittedCamera(this->orbit, this->corners, view.direction, this->aim);
  }
};

/// The S-sphere: the score of every direction on a closed surface round the data.
void FillSphere(const FoundViews& found, vtkPolyData* output);

/// One vertex per ranked viewpoint, best first, where its camera stands.
void FillViewpoints(const FoundViews& found, vtkPolyData* output);

/// The ways from samples up to better views, where they were scored.
void FillPaths(const FoundViews& found, vtkPolyData* output);

/// Best and worst view, what they have in common, and the effort.
void AddSearchSummary(const FoundViews& found, vtkFieldData* output);
}

#endif

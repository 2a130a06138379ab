// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the result of a viewpoint search to surfaces, points and lines.

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
  Orbit orbit;               ///< cameras of the scores
  std::vector<Vec3> corners; ///< corners of the image's box
  Aim aim = Aim::Box;
  std::vector<ScoredView> samples; ///< one per direction of the sphere
  SearchResult search;
  bool isAttainable = false; ///< whether scores are upper bounds
  double seconds = 0;
  double unitDistance = 1; ///< unit distance of opacities [length]
  std::string backend;

  /// Returns the camera of a view.
  Camera CameraOf(const ScoredView& view) const
  {
    return FittedCamera(this->orbit, this->corners, view.direction, this->aim);
  }
};

/// Fills the S-sphere: a closed surface around the data with the score of every direction.
void FillSphere(const FoundViews& found, vtkPolyData* output);

/// Adds one vertex per ranked viewpoint, best first, at its camera position.
void FillViewpoints(const FoundViews& found, vtkPolyData* output);

/// Adds the paths from samples to better views, through the positions that were scored.
void FillPaths(const FoundViews& found, vtkPolyData* output);

/// Adds the best and worst view, parameters of all views, and the effort.
void AddSearchSummary(const FoundViews& found, vtkFieldData* output);
}

#endif

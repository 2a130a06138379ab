// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_MethodScene_h
#define limpid_methods_MethodScene_h

#include "methods/Method.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/Occupancy.h"
#include "sweep/SumRays.h"

#include <memory>

namespace limpid
{
/// What a method without iterations works on: fields on a device, one value per node, as one source
/// of rays sees them.
template <class AnyDevice>
struct MethodScene
{
  std::shared_ptr<AnyDevice> device;
  Grid grid;
  const Occupancy* occupancy; ///< of base and importance
  RaySource source;
  double rayDensity;       ///< rays per voxel and axis on the farthest slice
  const float* base;       ///< base extinction [1/length]
  const float* importance; ///< [0, 1]
  AmentWeights ament;
  bool forLight; ///< whether the source is the light

  /// The source without a frame: what lies outside the picture is there all the same.
  RaySource WholeSource() const
  {
    RaySource whole = this->source;
    whole.viewPlanes.clear();
    return whole;
  }
};

/**
 * What a method does in the optimiser's place; null: nothing of its own. To add a method: its file,
 * its row here and in InfoOf, and, if it has one, its way through the samples of a ray (render).
 */
template <class AnyDevice>
struct MethodPasses
{
  /// Finds the extinction that the source is shown, at nodes that hold the base [1/length].
  void (*findExtinction)(const MethodScene<AnyDevice>& scene, float* extinction) = nullptr;

  /// What the source sees; else it is that of transport, Eq. (32).
  Seen (*see)(const MethodScene<AnyDevice>& scene) = nullptr;
};

template <class AnyDevice>
MethodPasses<AnyDevice> PassesOf(Method method);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_MethodScene_h
#define limpid_methods_MethodScene_h

#include "methods/Method.h"
#include "scene/Grid.h"
#include "scene/Occupancy.h"
#include "scene/RaySource.h"
#include "sweep/SumRays.h"

#include <memory>

namespace limpid
{
/// The input of a method without iterations: fields on a device, one value per node, and one
/// source of rays.
template <class AnyDevice>
struct MethodScene
{
  std::shared_ptr<AnyDevice> device;
  Grid grid;
  const Occupancy* occupancy; ///< of base extinction and importance
  RaySource source;
  double rayDensity;       ///< rays per voxel and axis on the farthest slice
  const float* base;       ///< base extinction [1/length]
  const float* importance; ///< [0, 1]
  AmentWeights ament;
  bool forLight; ///< whether the source is the light

  /// The source without view planes, so that structures outside of the view count.
  RaySource WholeSource() const
  {
    RaySource whole = this->source;
    whole.viewPlanes.clear();
    return whole;
  }
};

/**
 * The passes of a method that replaces the optimiser; null if it has none of its own. To add a
 * method: its file, a value of Method, its rows in PassesOf and InfoOf, and, if it has one, its
 * compositing (render).
 */
template <class AnyDevice>
struct MethodPasses
{
  /// Computes the extinction for the source at nodes; the array holds the base at first
  /// [1/length].
  void (*findExtinction)(const MethodScene<AnyDevice>& scene, float* extinction) = nullptr;

  /// Returns what the source sees; null for light transport, Eq. (32).
  Seen (*see)(const MethodScene<AnyDevice>& scene) = nullptr;
};

template <class AnyDevice>
MethodPasses<AnyDevice> PassesOf(Method method);
}

#endif

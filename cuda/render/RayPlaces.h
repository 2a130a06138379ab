// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RayPlaces_h
#define limpid_render_RayPlaces_h

#include "render/Ray.h"
#include "render/RayScene.h"

namespace limpid
{
/// Positions of samples of a ray, in as many lanes as AnySampler processes at a time.
template <class AnySampler>
struct RayPlaces
{
  using Lanes = typename AnySampler::Lanes;

  Lanes distance; ///< from the entry [samples]
  CellPlaces<AnySampler> scalars;

  /// Sets the samples that begin with number `k`.
  LIMPID_HD LIMPID_INLINE void Set(const RayScene& scene, const Ray& ray, int k)
  {
    this->SetAt(scene, ray, DistanceOf(ray, ToFloat(k) + AnySampler::Numbers()));
  }

  /// Sets places at distances from the entry [samples].
  LIMPID_HD LIMPID_INLINE void SetAt(const RayScene& scene, const Ray& ray, const Lanes& distances)
  {
    this->distance = distances;
    const Lanes position[3] = { this->Along(ray, 0), this->Along(ray, 1), this->Along(ray, 2) };
    this->scalars.Set(scene.grid, position);
  }

  /// Returns these places among the nodes of the overlay. `apart`: storage for them, used if the
  /// overlay has other nodes than the scalars.
  LIMPID_HD LIMPID_INLINE const CellPlaces<AnySampler>& InOverlay(
    const RayScene& scene, const Ray& ray, CellPlaces<AnySampler>& apart) const
  {
    if (scene.overlaySameNodes)
    {
      return this->scalars;
    }
    const Lanes position[3] = { this->AlongOverlay(scene, ray, 0),
      this->AlongOverlay(scene, ray, 1), this->AlongOverlay(scene, ray, 2) };
    apart.Set(scene.overlayGrid, position);
    return apart;
  }

private:
  /// Returns the positions of the samples along an axis of the overlay [nodes].
  LIMPID_HD LIMPID_INLINE Lanes AlongOverlay(const RayScene& scene, const Ray& ray, int axis) const
  {
    return (this->Along(ray, axis) + scene.overlayShift[axis]) * scene.overlayScale[axis];
  }

  /// Returns the positions of the samples along an axis [index].
  LIMPID_HD LIMPID_INLINE Lanes Along(const Ray& ray, int axis) const
  {
    return ray.entry[axis] + this->distance * ray.step[axis];
  }
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "methods/Viola2004.h"

#include "backend/CompiledDevice.h"
#include "math/Number.h"
#include "methods/RayObject.h"
#include "sweep/Sweeps.h"

namespace limpid
{
namespace
{
/// Resets the object of every ray.
struct RayObjects
{
  RayObject* rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const { this->rays[i] = RayObject(); }
};

struct MeetStep
{
  RayObject* rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    constexpr float points[2] = { float(gaussPoints[0]), float(gaussPoints[1]) };
    RayObject object = this->rays[i];
    for (int half = 0; half < 2; ++half)
    {
      const float depth = here.layer.front + points[half] * here.layer.thickness;
      const bool inside =
        depth >= here.Entry() && depth <= here.column.end && depth <= here.row.end;
      if (inside)
      {
        object.Meet(depth, here.importance[half]);
      }
    }
    this->rays[i] = object;
  }
};

/// Front to back: finds the objects, in relative depths.
template <class Field>
struct ObjectKernel
{
  static constexpr const char* label = "most important objects";

  Field importance; ///< [0, 1]
  RayObject* objects;

  template <class Windows>
  ObjectKernel<SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->importance, FieldUse{ 1 }), this->objects };
  }

  /// Rays carry nothing but their objects.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit&) const
  {
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (rays.EnterLayer(s, false))
    {
      rays.SampleImportance(this->importance);
      rays.ForEachInLayer(
        MeetStep{ this->objects + rays.Plan().RayAt(rays.FirstColumn(), rays.FirstRow()) });
    }
  }
};

/// Computes the fraction of a slice behind a ray's clip, in RayChannel::Behind.
struct ClipStep
{
  RayStates rays;
  const RayObject* objects;
  float depth;
  float thickness; ///< thickness of a layer

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    const float share = 0.5f + (this->depth - this->objects[i].begin) / this->thickness;
    this->rays[RayChannel::Behind][i] = Clamp(share, 0.0f, 1.0f);
  }
};

struct KeepStep
{
  const float* share;
  float* extinction; ///< in: the base extinction

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    const float mean = this->share[u];
    const float kept = mean < 1.0f ? mean : 1.0f; // means may exceed 1 by rounding
    this->extinction[u] *= kept; // NOLINT(clang-analyzer-core.NullDereference): the field is there
  }
};

/// The voxels of every slice keep the fraction of the rays around them.
template <class Output>
struct ClipKernel
{
  static constexpr const char* label = "clipped extinction";
  static constexpr RayChannel readByVoxels = RayChannel::Behind; ///< see ForRead

  Output extinction; ///< in: the base extinction [1/length]
  const RayObject* objects;

  template <class Windows>
  ClipKernel<SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 0, true }), this->objects };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    visit(RayChannel::Behind);
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    const bool last = s == rays.Plan().lastSlice;
    const float thickness = rays.Plan().SliceAt(last && s > 0 ? s - 1 : s).layer.thickness;
    if (rays.EnterLayer(s, false))
    {
      const Index first = rays.Plan().RayAt(rays.FirstColumn(), rays.FirstRow());
      rays.ForEach(ClipStep{
        rays.States(), this->objects + first, rays.Plan().SliceAt(s).RelativeDepth(), thickness });
    }
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LeaveStep(Rays&) const
  {
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    if (voxels.FindSeen(rays))
    {
      voxels.ForActive(KeepStep{ voxels.SeenHere().behind, voxels.Row(this->extinction) });
    }
  }
};
}

template <class AnyDevice>
void FindViola2004(const MethodScene<AnyDevice>& scene, float* extinction)
{
  const Occupancy everywhere(scene.grid, scene.base, scene.importance, false);
  for (FrustumRays<AnyDevice>& rays :
    PlanRays(scene.device, scene.grid, everywhere, scene.WholeSource(), { scene.rayDensity }))
  {
    const Index count = rays.Plan().RayCount();
    DeviceArray<AnyDevice, RayObject> objects(scene.device, std::size_t(count), "objects on rays");
    scene.device->ForIndices("no objects", count, RayObjects{ objects.Data() });
    SweepForward(*scene.device, rays, everywhere,
      ObjectKernel<const float*>{ scene.importance, objects.Data() });
    SweepBackward(
      *scene.device, rays, everywhere, ClipKernel<float*>{ extinction, objects.Data() });
  }
}

template void FindViola2004(const MethodScene<CompiledDevice>&, float*);
}

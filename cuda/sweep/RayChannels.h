// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The values of rays in a sweep. A kernel declares in ForCarried which of them its rays carry. How
// they start, stay in memory, are redistributed and end follows from that.

#ifndef limpid_sweep_RayChannels_h
#define limpid_sweep_RayChannels_h

#include "math/Vec.h"

namespace limpid
{
/// The optical depths of a ray, in double precision.
enum class RayDepth
{
  ToSlice,  ///< from the source to the slice that the sweep has reached
  Collected ///< of the layers that a back-to-front sweep has passed
};

/// The other values of a ray, in single precision.
enum class RayChannel
{
  Behind,         ///< visible importance behind, times scale^2; also defined in front of the entry
  Visible,        ///< visible importance behind the entry into the box; see HasEntered
  Unattenuated,   ///< importance without attenuation, inside the box, times scale^2
  Transmittance,  ///< from the source to the slice [0, 1]
  Density,        ///< optical depth per unit of depth, near the sides of the box: see DepthPerUnit
  Ahead,          ///< visible importance behind the middle of the layer behind the slice
  RearImportance, ///< importance in the rear half of the layer behind the slice [0, 1]

  KeptBehind, ///< Behind of the kept base extinction; see Kept
  KeptVisible,
  KeptUnattenuated,

  AlternativeBehind, ///< Behind through an alternative extinction; see WeighStep
  Cost,              ///< cost of not using the alternative extinction behind
  Reach,             ///< last slice that the ray should reach; kept for the next sweep

  Effect,       ///< effect of the slice's extinction on what the ray sees, see EffectStep
  EffectBehind, ///< contribution of the layer behind the next slice to that slice's effect

  Count ///< number of channels
};

/// Addresses of the values of all rays, or of the rays from one on.
struct RayStates
{
  double* toSlice;   ///< RayDepth::ToSlice
  double* collected; ///< RayDepth::Collected
  float* channels;   ///< [channel][ray]
  Index rays;        ///< number of rays of a channel

  LIMPID_HD LIMPID_INLINE RayStates From(Index ray) const
  {
    return { this->toSlice + ray, this->collected + ray, this->channels + ray, this->rays };
  }

  LIMPID_HD LIMPID_INLINE double* operator[](RayDepth depth) const
  {
    return depth == RayDepth::ToSlice ? this->toSlice : this->collected;
  }

  LIMPID_HD LIMPID_INLINE float* operator[](RayChannel channel) const
  {
    return this->channels + Index(channel) * this->rays;
  }
};

/// Calls visit(value) for each of `values`: RayDepth or RayChannel.
template <class Visit, class... Values>
LIMPID_HD LIMPID_INLINE void ForValues(const Visit& visit, Values... values)
{
  (visit(values), ...);
}

/// Calls visit(channel) for the channels of the kept base extinction, see Kept.
template <class Visit>
LIMPID_HD LIMPID_INLINE void ForKept(const Visit& visit)
{
  ForValues(visit, RayChannel::KeptBehind, RayChannel::KeptVisible, RayChannel::KeptUnattenuated);
}

/// Calls visit(channel) for the channels that voxels read: either the effect alone, or the
/// transmittance, the density and, unless `read` is the transmittance itself, the importance in
/// `read`. Kernels with voxels declare it as readByVoxels.
template <RayChannel read, class Visit>
LIMPID_HD LIMPID_INLINE void ForRead(const Visit& visit)
{
  if constexpr (read != RayChannel::Effect)
  {
    ForValues(visit, RayChannel::Transmittance, RayChannel::Density);
  }
  if constexpr (read != RayChannel::Transmittance)
  {
    visit(read);
  }
}

/// Value of RayChannel::Visible until a back-to-front sweep reaches the ray's entry. Visible
/// importance itself is never negative.
constexpr float notEntered = -1;

/// Whether a back-to-front sweep has reached the layer of the ray's entry into the box, so that
/// its visible importance is known.
LIMPID_HD LIMPID_INLINE bool HasEntered(float visible)
{
  return visible >= 0;
}

/// Returns the visible importance of a whole ray after a back-to-front sweep.
LIMPID_HD LIMPID_INLINE float VisibleOf(float visible, float behind)
{
  return HasEntered(visible) ? visible : behind;
}

/// Initialises a value of a ray for a front-to-back sweep.
struct StartInFront
{
  RayStates ray;

  LIMPID_HD LIMPID_INLINE void operator()(RayDepth depth) const { *this->ray[depth] = 0; }

  LIMPID_HD LIMPID_INLINE void operator()(RayChannel channel) const
  {
    *this->ray[channel] = channel == RayChannel::Transmittance ? 1.0f : 0.0f;
  }
};

/// Initialises a value of a ray for a back-to-front sweep. RayDepth::ToSlice and RayChannel::Reach
/// are kept.
struct StartBehind
{
  RayStates ray;

  LIMPID_HD LIMPID_INLINE void operator()(RayDepth depth) const
  {
    if (depth == RayDepth::Collected)
    {
      *this->ray[depth] = 0;
    }
  }

  LIMPID_HD LIMPID_INLINE void operator()(RayChannel channel) const
  {
    if (channel == RayChannel::Visible || channel == RayChannel::KeptVisible)
    {
      *this->ray[channel] = notEntered;
    }
    else if (channel != RayChannel::Reach)
    {
      StartInFront{ this->ray }(channel);
    }
  }
};

/// Completes a value of a ray after a back-to-front sweep: the visible importance of the whole ray.
struct FinishBehind
{
  RayStates ray;

  LIMPID_HD LIMPID_INLINE void operator()(RayDepth) const {}

  LIMPID_HD LIMPID_INLINE void operator()(RayChannel channel) const
  {
    if (channel == RayChannel::Visible)
    {
      this->Finish(channel, RayChannel::Behind);
    }
    else if (channel == RayChannel::KeptVisible)
    {
      this->Finish(channel, RayChannel::KeptBehind);
    }
  }

private:
  LIMPID_HD LIMPID_INLINE void Finish(RayChannel visible, RayChannel behind) const
  {
    *this->ray[visible] = VisibleOf(*this->ray[visible], *this->ray[behind]);
  }
};

/// Copies a value of a ray.
struct CopyValue
{
  RayStates from;
  RayStates to;

  template <class Value>
  LIMPID_HD LIMPID_INLINE void operator()(Value value) const
  {
    *this->to[value] = *this->from[value];
  }
};
}

#endif

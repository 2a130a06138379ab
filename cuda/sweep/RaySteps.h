// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The steps that change the values of rays in a sweep, for all backends.

#ifndef limpid_sweep_RaySteps_h
#define limpid_sweep_RaySteps_h

#include "math/Vec.h"
#include "sweep/RayChannels.h"
#include "sweep/ResolvedLayer.h"

namespace limpid
{
/// The values that the voxels of a slice read from the rays next to them, one per ray.
struct RaysBeside
{
  const float* transmittance; ///< see RayChannel
  const float* density;
  const float* behind; ///< visible importance behind, as defined by the kernel [scale^2]
};

/**
 * Whether a sweep also counts what is seen of important structures in the data: the integral of g
 * min(mu, mu-bar) T. Extinction mu above the base mu-bar attenuates but adds nothing to it
 * (Documentation/Method.md, section on what is visible). min(mu, mu-bar) is taken at the nodes.
 */
enum class Kept
{
  Ignored,
  Counted
};

/// Front to back, Eqs. (2), (15) and (16): adds the optical depth of the layer. Optical depth
/// counts from the entry into the box. It is negative in front of the entry and continues behind
/// the exit, so that it is continuous across neighbouring rays.
struct DeepenStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays[RayDepth::ToSlice][i] += here.DepthFromEntry();
  }
};

/// Front to back, Eq. (32): adds the layer's visible importance to `visible`, and its importance
/// without attenuation to `unattenuated`, both inside the box only. Adds its optical depth.
template <Kept kept>
struct ScoreStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    const LayerLight light = here.Light();
    const float transmittance = Attenuate(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
    this->rays[RayChannel::Visible][i] += transmittance * light.visible;
    this->rays[RayChannel::Unattenuated][i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      this->rays[RayChannel::KeptVisible][i] += transmittance * light.keptVisible;
      this->rays[RayChannel::KeptUnattenuated][i] += light.keptUnattenuated;
    }
    this->rays[RayDepth::ToSlice][i] += light.opticalDepth;
  }
};

/// Back to front: subtracts the layer's optical depth.
struct UnwindStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays[RayDepth::ToSlice][i] -= here.WholeDepth();
  }
};

/// Back to front, Eqs. (19) and (20): carries visible importance from the back of the layer to its
/// front.
template <Kept kept>
struct CarryStep
{
  RayStates rays;

  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    const TwoHalves inside = TwoHalves::Inside(here);
    const TwoHalves toExit = TwoHalves::ToExit(here);
    // Selections by one condition each, see WeighStep.
    constexpr float never = -1e30f;
    const float entry = HasEntered(this->rays[RayChannel::Visible][i]) ? never : here.Entry();
    const bool enters = passage == LayerCrossing::Clipped && entry >= here.layer.front;
    Carry<passage>(inside, toExit, enters, this->rays[RayChannel::Behind][i],
      this->rays[RayChannel::Visible][i], this->rays[RayChannel::Unattenuated][i]);
    if (kept == Kept::Counted)
    {
      Carry<passage>(inside.CountingShares(here), toExit.CountingShares(here), enters,
        this->rays[RayChannel::KeptBehind][i], this->rays[RayChannel::KeptVisible][i],
        this->rays[RayChannel::KeptUnattenuated][i]);
    }
  }

  /// `Resolved`: ResolvedRay or LitRay.
  template <class Resolved>
  LIMPID_HD LIMPID_INLINE void operator()(const Resolved& here, Index i) const
  {
    const RayInLayer<LayerCrossing::Clipped>& plain = here.plain;
    const LayerLight light = here.Light();
    const bool ahead = plain.Entry() > plain.layer.front;
    const bool enters =
      !HasEntered(this->rays[RayChannel::Visible][i]) && plain.Entry() >= plain.layer.front;
    const TwoHalves toExit = TwoHalves::ToExit(plain);
    const auto carry = [&](float gained, const TwoHalves& halves, float& behind, float& visible)
    {
      const float front = gained + light.passed * behind;
      visible = enters ? front : visible;
      behind = ahead ? limpid::Carried(halves.front, halves.rear, behind) : front;
    };
    carry(
      light.visible, toExit, this->rays[RayChannel::Behind][i], this->rays[RayChannel::Visible][i]);
    this->rays[RayChannel::Unattenuated][i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      carry(light.keptVisible, toExit.CountingShares(plain), this->rays[RayChannel::KeptBehind][i],
        this->rays[RayChannel::KeptVisible][i]);
      this->rays[RayChannel::KeptUnattenuated][i] += light.keptUnattenuated;
    }
  }

private:
  /// `enters`: whether the ray enters the box in this layer.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static void Carry(const TwoHalves& inside, const TwoHalves& toExit,
    bool enters, float& behind, float& visible, float& unattenuated)
  {
    unattenuated += inside.front.unattenuated + inside.rear.unattenuated;
    if (passage == LayerCrossing::Clipped)
    {
      visible = enters ? Carried(inside.front, inside.rear, behind) : visible;
    }
    behind = Carried(toExit.front, toExit.rear, behind);
  }
};

/// Carries visible importance through a layer of new extinction and collects its optical depth.
template <Kept kept>
struct CarryAndCollectStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    CarryStep<kept>{ this->rays }(here, i);
    this->rays[RayDepth::Collected][i] += here.DepthFromEntry();
  }
};

/**
 * Carries visible importance through a layer, once with the new extinction mu and once with an
 * alternative mu', and collects the optical depth. The new extinction behind is not worth its cost
 * where
 *
 *    T (V - V') < p/(2 q) integral of (mu - mu')^2 dt.
 *
 * There the ray continues as if it had met the alternative, and `reach` records that the ray
 * should not go beyond this slice.
 */
struct WeighStep
{
  RayStates rays;
  float priceOfSquare; ///< p/(2 q) [length]
  float slice;         ///< index of the slice in front of the layer

  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    constexpr float least = 0.02f; // smaller gains do not matter to the next sweep
    const float behind = CarriedTo(here, this->rays[RayChannel::Behind][i]);
    RayInLayer<passage> other = here;
    other.extinction[0] = here.kept[0];
    other.extinction[1] = here.kept[1];
    const float alternative = CarriedTo(other, this->rays[RayChannel::AlternativeBehind][i]);
    const float cost = this->rays[RayChannel::Cost][i] + this->CostOf(here);
    const float shown = this->rays[RayChannel::Transmittance][i] * (behind - alternative);
    const bool pays = shown > cost;
    const float reach = this->rays[RayChannel::Reach][i];
    // One selection after the other: compilers do not vectorise those by several conditions.
    const float nearer = this->slice < reach ? this->slice : reach;
    const float smallest = least * here.layer.frontScale * here.layer.frontScale;
    const float reachIfNot = shown > smallest ? nearer : reach;
    this->rays[RayChannel::Behind][i] = pays ? behind : alternative;
    this->rays[RayChannel::AlternativeBehind][i] = alternative;
    this->rays[RayChannel::Cost][i] = pays ? cost : 0.0f;
    this->rays[RayChannel::Reach][i] = pays ? reach : reachIfNot;
    this->rays[RayDepth::Collected][i] += here.DepthFromEntry();
  }

private:
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static float CarriedTo(const RayInLayer<passage>& ray, float behind)
  {
    const TwoHalves halves = TwoHalves::ToExit(ray);
    return Carried(halves.front, halves.rear, behind);
  }

  /// Cost of the change in the layer, times scale^2.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE float CostOf(const RayInLayer<passage>& ray) const
  {
    RayInLayer<passage> changed = ray; // for T = 1, importance times extinction is the cost
    for (int half = 0; half < 2; ++half)
    {
      const float change = ray.extinction[half] - ray.kept[half];
      const float amount = change < 0.0f ? -change : change;
      changed.extinction[half] = amount;
      changed.importance[half] = this->priceOfSquare * amount;
    }
    const TwoHalves halves = TwoHalves::ToExit(changed);
    return halves.front.unattenuated + halves.rear.unattenuated;
  }
};

/// Initialises the effect of a slice with the contribution of the layer behind it.
struct BeginEffectStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays[RayChannel::Effect][i] = this->rays[RayChannel::EffectBehind][i];
    this->rays[RayChannel::EffectBehind][i] = 0;
  }
};

/**
 * Back to front: carries visible importance through a layer and computes the effect of its
 * extinction. The effect is the derivative of minus the ray's visible importance by the
 * extinction, divided by the ray's length per unit of depth. With V the importance behind per unit
 * of transmittance it is, Eqs. (27) and (28),
 *
 *    integral of w T (V - g) dt, w = 1 - t for the front slice, t for the back slice,
 *
 * with the quadrature of the score. Optical depths are those at the front.
 */
template <Kept kept>
struct EffectStep
{
  RayStates rays;

  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    constexpr float ofBack[2] = { float(gaussPoints[0]), float(gaussPoints[1]) };
    const HalfLayer<float> front = here.template Half<Cut::Both>(0);
    const HalfLayer<float> rear = here.template Half<Cut::Both>(1);
    const float behind = this->rays[RayChannel::Behind][i];
    const float unit = here.layer.thickness * this->TransmittanceTo(here, i);
    const float middle = Carried(rear, behind);
    const float effects[2] = { here.WayInHalf(0) * unit *
        (front.Passed() * middle - front.visibleSlope),
      here.WayInHalf(1) * unit * front.Passed() * (rear.Passed() * behind - rear.visibleSlope) };
    this->rays[RayChannel::Effect][i] += ofBack[0] * effects[0] + ofBack[1] * effects[1];
    this->rays[RayChannel::EffectBehind][i] =
      (1.0f - ofBack[0]) * effects[0] + (1.0f - ofBack[1]) * effects[1];
    this->Gain(here.Light(), i);
  }

  /// `Resolved`: ResolvedRay or LitRay.
  template <class Resolved>
  LIMPID_HD LIMPID_INLINE void operator()(const Resolved& here, Index i) const
  {
    const float transmittance = this->TransmittanceTo(here.plain, i);
    LayerEffect effect;
    const LayerLight light = here.Light(this->rays[RayChannel::Behind][i], effect);
    this->rays[RayChannel::Effect][i] += transmittance * effect.back;
    this->rays[RayChannel::EffectBehind][i] = transmittance * effect.front;
    this->Gain(light, i);
  }

private:
  /// Transmittance at the front of the layer, or at the ray's entry if it enters the box here.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE float TransmittanceTo(const RayInLayer<passage>& here, Index i) const
  {
    const bool entersHere = passage == LayerCrossing::Clipped && here.Entry() > here.layer.front;
    return entersHere ? 1.0f : Transmitted(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
  }

  LIMPID_HD LIMPID_INLINE void Gain(const LayerLight& light, Index i) const
  {
    this->rays[RayChannel::Behind][i] =
      light.visible + light.passed * this->rays[RayChannel::Behind][i];
    this->rays[RayChannel::Unattenuated][i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      this->rays[RayChannel::KeptBehind][i] =
        light.keptVisible + light.passed * this->rays[RayChannel::KeptBehind][i];
      this->rays[RayChannel::KeptUnattenuated][i] += light.keptUnattenuated;
    }
  }
};

/// Whether a step moves several rays at once through resolved layers, on the processor:
/// Lanes<Cuts>(RowBetweenSlices, RaysInLanes) changes the states of all of them.
template <class Step>
constexpr bool stepsLanes = false;

/// Whether a step needs LayerEffect of resolved layers.
template <class Step>
constexpr bool findsEffects = false;
template <Kept kept>
inline constexpr bool findsEffects<EffectStep<kept>> = true;

/// Carries visible importance to the middle of the layer (RayChannel::Ahead).
struct LookAheadStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays[RayChannel::Ahead][i] =
      Carried(here.template Half<Cut::Exit>(1), this->rays[RayChannel::Behind][i]);
  }
};

/// Computes the transmittance of a ray, which voxels read.
struct TransmitStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays[RayChannel::Transmittance][i] =
      Transmitted(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
  }
};

/// Sets the transmittance to 0 for voxels that the ray should not reach.
struct ReachStep
{
  RayStates rays;
  float slice; ///< index of the voxels' slice

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    const float transmittance = this->rays[RayChannel::Transmittance][i];
    this->rays[RayChannel::Transmittance][i] =
      this->slice > this->rays[RayChannel::Reach][i] ? 0.0f : transmittance;
  }
};

/// Initialises RayChannel::Reach: no limit.
struct StartReach
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    constexpr float unlimited = 1e30f;
    this->rays[RayChannel::Reach][i] = unlimited;
  }
};

/// Computes the optical depth per unit of depth, which voxels near the sides of the box read.
struct DensityStep
{
  RayStates rays;
  float frontDepth; ///< relative depth where rays start that do not enter through a side
  bool knownAhead;  ///< see DepthPerUnit
  float limit;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    const float row = here.row.begin < this->frontDepth ? this->frontDepth : here.row.begin;
    const float entry = row > here.column.begin ? row : here.column.begin;
    this->rays[RayChannel::Density][i] =
      DepthPerUnit(static_cast<float>(this->rays[RayDepth::ToSlice][i]), here.layer.front - entry,
        here.extinction[0] * here.length, this->knownAhead, this->limit);
  }
};
}

#endif

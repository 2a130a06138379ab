// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The values that rays carry in a sweep, and the steps that change them, for all backends.

#ifndef limpid_sweep_RaySteps_h
#define limpid_sweep_RaySteps_h

#include "math/Vec.h"
#include "sweep/ResolvedLayer.h"

#include <cstddef>
#include <vector>

namespace limpid
{
/// Pointers to the values of all rays. From returns the view of one row of rays.
struct RayStates
{
  double* opticalDepth; ///< from the source to the slice that the sweep has reached
  double* collected;    ///< optical depth of the layers that a back-to-front sweep has passed
  float* behind;  ///< visible importance behind, times scale^2; also defined in front of the entry
  float* visible; ///< visible importance behind the entry into the box; see HasEntered
  float* unattenuated;  ///< importance without attenuation, inside the box, times scale^2
  float* transmittance; ///< from the source to the slice [0, 1]
  float* density; ///< optical depth per unit of depth, near the sides of the box: see DepthPerUnit
  float* ahead;   ///< visible importance behind the middle of the layer behind the slice
  float* rearImportance; ///< importance in the rear half of the layer behind the slice [0, 1]

  float* keptBehind; ///< `behind` of the kept base extinction; see Kept
  float* keptVisible;
  float* keptUnattenuated;

  float* alternativeBehind; ///< `behind` through an alternative extinction; see WeighStep
  float* cost;              ///< cost of not using the alternative extinction behind
  float* reach;             ///< last slice that the ray should reach; kept for the next sweep

  float* effect;       ///< effect of the slice's extinction on what the ray sees, see EffectStep
  float* effectBehind; ///< contribution of the layer behind the next slice to that slice's effect

  LIMPID_HD LIMPID_INLINE RayStates From(Index ray) const
  {
    return { this->opticalDepth + ray, this->collected + ray, this->behind + ray,
      this->visible + ray, this->unattenuated + ray, this->transmittance + ray, this->density + ray,
      this->ahead + ray, this->rearImportance + ray, this->keptBehind + ray,
      this->keptVisible + ray, this->keptUnattenuated + ray, this->alternativeBehind + ray,
      this->cost + ray, this->reach + ray, this->effect + ray, this->effectBehind + ray };
  }
};

/// One kind of ray values, as bytes, to be redistributed.
struct RayValues
{
  std::byte* first;
  std::size_t bytes; ///< of one ray's value

  template <class Value>
  RayValues(Value* values)
    : first(reinterpret_cast<std::byte*>(values))
    , bytes(sizeof(Value))
  {
  }
};

/// The values that the voxels of a slice read from the rays next to them, one per ray.
struct RaysBeside
{
  const float* transmittance; ///< see RayStates
  const float* density;
  const float* behind; ///< visible importance behind, as defined by the kernel [scale^2]
};

/// What a device keeps of every ray on a slice, for the voxels there.
enum class RayImage
{
  Seen,          ///< transmittance and attenuated importance behind; density near sides of the box
  Transmittance, ///< transmittance; density near sides of the box
  Effect         ///< see EffectStep
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

/// Value of RayStates::visible until a back-to-front sweep reaches the ray's entry. Visible
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

/// Initialises rays for a back-to-front sweep. Optical depths are kept.
struct StartBehind
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.collected[i] = 0;
    this->rays.behind[i] = 0;
    this->rays.visible[i] = notEntered;
    this->rays.unattenuated[i] = 0;
    this->rays.transmittance[i] = 1;
    this->rays.density[i] = 0;
    this->rays.ahead[i] = 0;
    this->rays.keptBehind[i] = 0;
    this->rays.keptVisible[i] = notEntered;
    this->rays.keptUnattenuated[i] = 0;
    this->rays.alternativeBehind[i] = 0;
    this->rays.cost[i] = 0;
    this->rays.effect[i] = 0;
    this->rays.effectBehind[i] = 0;
  }
};

/// Initialises rays for a front-to-back sweep that computes transmittance only.
struct StartDepth
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.opticalDepth[i] = 0;
    this->rays.transmittance[i] = 1;
    this->rays.density[i] = 0;
  }
};

/// Initialises rays for any front-to-back sweep.
struct StartInFront
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    StartDepth{ this->rays }(i);
    this->rays.visible[i] = 0;
    this->rays.unattenuated[i] = 0;
    this->rays.keptVisible[i] = 0;
    this->rays.keptUnattenuated[i] = 0;
  }
};

/// Sets the visible importance of whole rays after a back-to-front sweep.
struct FinishBehind
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.visible[i] = VisibleOf(this->rays.visible[i], this->rays.behind[i]);
    this->rays.keptVisible[i] = VisibleOf(this->rays.keptVisible[i], this->rays.keptBehind[i]);
  }
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
    this->rays.opticalDepth[i] += here.DepthFromEntry();
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
    const float transmittance = Attenuate(static_cast<float>(this->rays.opticalDepth[i]));
    this->rays.visible[i] += transmittance * light.visible;
    this->rays.unattenuated[i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      this->rays.keptVisible[i] += transmittance * light.keptVisible;
      this->rays.keptUnattenuated[i] += light.keptUnattenuated;
    }
    this->rays.opticalDepth[i] += light.opticalDepth;
  }
};

/// Back to front: subtracts the layer's optical depth.
struct UnwindStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays.opticalDepth[i] -= here.WholeDepth();
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
    const bool enters = passage == LayerCrossing::Clipped && !HasEntered(this->rays.visible[i]) &&
      here.Entry() >= here.layer.front;
    Carry<passage>(inside, toExit, enters, this->rays.behind[i], this->rays.visible[i],
      this->rays.unattenuated[i]);
    if (kept == Kept::Counted)
    {
      Carry<passage>(inside.CountingShares(here), toExit.CountingShares(here), enters,
        this->rays.keptBehind[i], this->rays.keptVisible[i], this->rays.keptUnattenuated[i]);
    }
  }

  /// `Resolved`: ResolvedRay or LitRay.
  template <class Resolved>
  LIMPID_HD LIMPID_INLINE void operator()(const Resolved& here, Index i) const
  {
    const RayInLayer<LayerCrossing::Clipped>& plain = here.plain;
    const LayerLight light = here.Light();
    const bool ahead = plain.Entry() > plain.layer.front;
    const bool enters = !HasEntered(this->rays.visible[i]) && plain.Entry() >= plain.layer.front;
    const TwoHalves toExit = TwoHalves::ToExit(plain);
    const auto carry = [&](float gained, const TwoHalves& halves, float& behind, float& visible)
    {
      const float front = gained + light.passed * behind;
      visible = enters ? front : visible;
      behind = ahead ? limpid::Carried(halves.front, halves.rear, behind) : front;
    };
    carry(light.visible, toExit, this->rays.behind[i], this->rays.visible[i]);
    this->rays.unattenuated[i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      carry(light.keptVisible, toExit.CountingShares(plain), this->rays.keptBehind[i],
        this->rays.keptVisible[i]);
      this->rays.keptUnattenuated[i] += light.keptUnattenuated;
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
    this->rays.collected[i] += here.DepthFromEntry();
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
    const float behind = CarriedTo(here, this->rays.behind[i]);
    RayInLayer<passage> other = here;
    other.extinction[0] = here.kept[0];
    other.extinction[1] = here.kept[1];
    const float alternative = CarriedTo(other, this->rays.alternativeBehind[i]);
    const float cost = this->rays.cost[i] + this->CostOf(here);
    const float shown = this->rays.transmittance[i] * (behind - alternative);
    const bool pays = shown > cost;
    const float reach = this->rays.reach[i];
    const bool nearer =
      !pays && this->slice < reach && shown > least * here.layer.frontScale * here.layer.frontScale;
    this->rays.behind[i] = pays ? behind : alternative;
    this->rays.alternativeBehind[i] = alternative;
    this->rays.cost[i] = pays ? cost : 0.0f;
    this->rays.reach[i] = nearer ? this->slice : reach;
    this->rays.collected[i] += here.DepthFromEntry();
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
    this->rays.effect[i] = this->rays.effectBehind[i];
    this->rays.effectBehind[i] = 0;
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
    const float behind = this->rays.behind[i];
    const float unit = here.layer.thickness * this->TransmittanceTo(here, i);
    const float middle = Carried(rear, behind);
    const float effects[2] = { here.WayInHalf(0) * unit *
        (front.Passed() * middle - front.visibleSlope),
      here.WayInHalf(1) * unit * front.Passed() * (rear.Passed() * behind - rear.visibleSlope) };
    this->rays.effect[i] += ofBack[0] * effects[0] + ofBack[1] * effects[1];
    this->rays.effectBehind[i] = (1.0f - ofBack[0]) * effects[0] + (1.0f - ofBack[1]) * effects[1];
    this->Gain(here.Light(), i);
  }

  /// `Resolved`: ResolvedRay or LitRay.
  template <class Resolved>
  LIMPID_HD LIMPID_INLINE void operator()(const Resolved& here, Index i) const
  {
    const float transmittance = this->TransmittanceTo(here.plain, i);
    LayerEffect effect;
    const LayerLight light = here.Light(this->rays.behind[i], effect);
    this->rays.effect[i] += transmittance * effect.back;
    this->rays.effectBehind[i] = transmittance * effect.front;
    this->Gain(light, i);
  }

private:
  /// Transmittance at the front of the layer, or at the ray's entry if it enters the box here.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE float TransmittanceTo(const RayInLayer<passage>& here, Index i) const
  {
    const bool entersHere = passage == LayerCrossing::Clipped && here.Entry() > here.layer.front;
    return entersHere ? 1.0f : Transmitted(static_cast<float>(this->rays.opticalDepth[i]));
  }

  LIMPID_HD LIMPID_INLINE void Gain(const LayerLight& light, Index i) const
  {
    this->rays.behind[i] = light.visible + light.passed * this->rays.behind[i];
    this->rays.unattenuated[i] += light.unattenuated;
    if (kept == Kept::Counted)
    {
      this->rays.keptBehind[i] = light.keptVisible + light.passed * this->rays.keptBehind[i];
      this->rays.keptUnattenuated[i] += light.keptUnattenuated;
    }
  }
};

/// Whether a step needs LayerEffect of resolved layers.
template <class Step>
constexpr bool findsEffects = false;
template <Kept kept>
constexpr bool findsEffects<EffectStep<kept>> = true;

/// Carries visible importance to the middle of the layer (RayStates::ahead).
struct LookAheadStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays.ahead[i] = Carried(here.template Half<Cut::Exit>(1), this->rays.behind[i]);
  }
};

/// Computes the transmittance of a ray, which voxels read.
struct TransmitStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.transmittance[i] = Transmitted(static_cast<float>(this->rays.opticalDepth[i]));
  }
};

/// Sets the transmittance to 0 for voxels that the ray should not reach.
struct ReachStep
{
  RayStates rays;
  float slice; ///< index of the voxels' slice

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    const float transmittance = this->rays.transmittance[i];
    this->rays.transmittance[i] = this->slice > this->rays.reach[i] ? 0.0f : transmittance;
  }
};

/// Initialises RayStates::reach: no limit.
struct StartReach
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    constexpr float unlimited = 1e30f;
    this->rays.reach[i] = unlimited;
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
    this->rays.density[i] = DepthPerUnit(static_cast<float>(this->rays.opticalDepth[i]),
      here.layer.front - entry, here.extinction[0] * here.length, this->knownAhead, this->limit);
  }
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What travels with the rays of a sweep, and what a step does to it: the same for all backends.

#ifndef limpid_sweep_RaySteps_h
#define limpid_sweep_RaySteps_h

#include "math/Vec.h"
#include "sweep/RayLayer.h"

namespace limpid
{
/// One value per ray. A row of rays has its own view of them (From).
struct RayStates
{
  double* opticalDepth;  ///< from the source to the slice that the sweep has reached
  double* collected;     ///< optical depth of the layers that a sweep from the back has passed
  float* behind;         ///< visible importance behind, times scale^2; goes on ahead of the entry
  float* visible;        ///< ... from the entry into the box on; see HasEntered
  float* unattenuated;   ///< importance without attenuation, inside the box, times scale^2
  float* transmittance;  ///< from the source to the slice [0, 1]
  float* density;        ///< near the sides of the box: see DepthPerUnit
  float* ahead;          ///< what `behind` is half way to the slice behind
  float* rearImportance; ///< sampled in the rear half of the layer behind the slice [0, 1]

  float* keptBehind; ///< the same as `behind`, of what is kept of the base extinction; see Kept
  float* keptVisible;
  float* keptUnattenuated;

  LIMPID_HD LIMPID_INLINE RayStates From(Index ray) const
  {
    return { this->opticalDepth + ray, this->collected + ray, this->behind + ray,
      this->visible + ray, this->unattenuated + ray, this->transmittance + ray, this->density + ray,
      this->ahead + ray, this->rearImportance + ray, this->keptBehind + ray,
      this->keptVisible + ray, this->keptUnattenuated + ray };
  }
};

/**
 * Whether a sweep also counts what is seen of important matter that the data has: the integral of
 * g min(mu, mu-bar) T, where extinction mu above the base mu-bar attenuates but shows nothing more
 * (Documentation/Method.md, section on what is visible). min(mu, mu-bar) is taken at the nodes.
 */
enum class Kept
{
  Ignored,
  Counted
};

/// RayStates::visible of a ray whose entry a sweep from the back has not come to yet: no visible
/// importance is negative.
constexpr float notEntered = -1;

/// Whether a sweep from the back has come to the layer of a ray's entry into the box, so that its
/// visible importance is known.
LIMPID_HD LIMPID_INLINE bool HasEntered(float visible)
{
  return visible >= 0;
}

/// Visible importance of a whole ray when a sweep from the back is through.
LIMPID_HD LIMPID_INLINE float VisibleOf(float visible, float behind)
{
  return HasEntered(visible) ? visible : behind;
}

/// What a ray is before a sweep from the back, where nothing is behind. Optical depths stay.
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
  }
};

/// What a ray is before a sweep from the front.
struct StartInFront
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.opticalDepth[i] = 0;
    this->rays.visible[i] = 0;
    this->rays.unattenuated[i] = 0;
    this->rays.transmittance[i] = 1;
    this->rays.density[i] = 0;
    this->rays.keptVisible[i] = 0;
    this->rays.keptUnattenuated[i] = 0;
  }
};

/// Visible importance of a whole ray, when a sweep from the back is through.
struct FinishBehind
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.visible[i] = VisibleOf(this->rays.visible[i], this->rays.behind[i]);
    this->rays.keptVisible[i] = VisibleOf(this->rays.keptVisible[i], this->rays.keptBehind[i]);
  }
};

/// Front to back, Eqs. (2), (15) and (16): the optical depth grows by that of the layer. It is that
/// since the entry into the box, negative before, and goes on behind the exit, so that nothing
/// jumps between neighbouring rays.
struct DeepenStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays.opticalDepth[i] += here.DepthFromEntry();
  }
};

/// Front to back, Eq. (32): `visible` gains the visible importance of the layer, and `unattenuated`
/// what it would be without attenuation, inside the box only; the optical depth grows.
struct ScoreStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<Passage::Through>& here, Index i) const
  {
    const HalfLayer<float> front = here.Whole(0);
    const HalfLayer<float> rear = here.Whole(1);
    this->Gain(i, front, rear);
    this->rays.opticalDepth[i] += front.LimitedDepth() + rear.LimitedDepth();
  }

  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<Passage::Clipped>& here, Index i) const
  {
    this->Gain(i, here.Half<Cut::Both>(0), here.Half<Cut::Both>(1));
    this->rays.opticalDepth[i] += here.DepthFromEntry();
  }

private:
  LIMPID_HD LIMPID_INLINE void Gain(
    Index i, const HalfLayer<float>& front, const HalfLayer<float>& rear) const
  {
    const float transmittance = Attenuate(static_cast<float>(this->rays.opticalDepth[i]));
    this->rays.visible[i] += transmittance * (front.visible + front.Passed() * rear.visible);
    this->rays.unattenuated[i] += front.unattenuated + rear.unattenuated;
  }
};

/// The same of what is kept, before ScoreStep goes on: apart from it, so that scores have the same
/// bits whether that is counted or not.
struct ScoreKeptStep
{
  RayStates rays;

  template <Passage passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    const TwoHalves kept = TwoHalves::Inside(here).CountingShares(here);
    const float transmittance = Attenuate(static_cast<float>(this->rays.opticalDepth[i]));
    this->rays.keptVisible[i] += transmittance * Carried(kept.front, kept.rear, 0);
    this->rays.keptUnattenuated[i] += kept.front.unattenuated + kept.rear.unattenuated;
  }
};

/// Back to front: the optical depth shrinks to that at the front of the layer.
struct UnwindStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays.opticalDepth[i] -= here.WholeDepth();
  }
};

/// Back to front, Eqs. (19) and (20): visible importance is carried from the back of the layer to
/// its front.
template <Kept kept>
struct CarryStep
{
  RayStates rays;

  template <Passage passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    const TwoHalves inside = TwoHalves::Inside(here);
    const TwoHalves toExit = TwoHalves::ToExit(here);
    const bool enters = passage == Passage::Clipped && !HasEntered(this->rays.visible[i]) &&
      here.Entry() >= here.layer.front;
    Carry<passage>(inside, toExit, enters, this->rays.behind[i], this->rays.visible[i],
      this->rays.unattenuated[i]);
    if (kept == Kept::Counted)
    {
      Carry<passage>(inside.CountingShares(here), toExit.CountingShares(here), enters,
        this->rays.keptBehind[i], this->rays.keptVisible[i], this->rays.keptUnattenuated[i]);
    }
  }

private:
  /// `enters`: whether the ray enters the box in the layer.
  template <Passage passage>
  LIMPID_HD LIMPID_INLINE static void Carry(const TwoHalves& inside, const TwoHalves& toExit,
    bool enters, float& behind, float& visible, float& unattenuated)
  {
    unattenuated += inside.front.unattenuated + inside.rear.unattenuated;
    if (passage == Passage::Clipped)
    {
      visible = enters ? Carried(inside.front, inside.rear, behind) : visible;
    }
    behind = Carried(toExit.front, toExit.rear, behind);
  }
};

/// Carries visible importance through a layer of a fixed extinction and unwinds the optical depth.
template <Kept kept>
struct CarryAndUnwindStep
{
  RayStates rays;

  template <Passage passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    CarryStep<kept>{ this->rays }(here, i);
    this->rays.opticalDepth[i] += -here.WholeDepth();
  }
};

/// Carries visible importance through a layer of a new extinction and collects its optical depth.
template <Kept kept>
struct CarryAndCollectStep
{
  RayStates rays;

  template <Passage passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    CarryStep<kept>{ this->rays }(here, i);
    this->rays.collected[i] += here.DepthFromEntry();
  }
};

/// Visible importance behind the middle of the layer.
struct LookAheadStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    this->rays.ahead[i] = Carried(here.template Half<Cut::Exit>(1), this->rays.behind[i]);
  }
};

/// What voxels read of a ray: its transmittance.
struct TransmitStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays.transmittance[i] = Transmitted(static_cast<float>(this->rays.opticalDepth[i]));
  }
};

/// What voxels read of a ray near the sides of the box: its optical depth per unit of depth.
struct DensityStep
{
  RayStates rays;
  float frontDepth; ///< relative depth where rays begin that enter through no side
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

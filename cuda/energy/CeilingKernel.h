// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_CeilingKernel_h
#define limpid_energy_CeilingKernel_h

#include "energy/MostExtinction.h"
#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

#include <vector>

namespace limpid
{
struct RaysInLanes;
struct RowBetweenSlices;

/// Resolves the layers that would be thick at the upper bound of the extinction.
template <class TheCuts>
struct ResolveImportant
{
  using Cuts = TheCuts;

  MostExtinction<float> most;

  LIMPID_HD LIMPID_INLINE bool Reaches(Index) const { return true; }
  LIMPID_HD LIMPID_INLINE float Densest(float sampled) const { return this->most(sampled); }

  LIMPID_HD LIMPID_INLINE float LeastOnWay(float way) const
  {
    return this->most.majorant * way > Cuts::thick ? -1.0f : 1e30f;
  }
};

/// A segment of a ray whose extinction may be chosen. `Number`: see RayPieceOf.
template <class Number>
struct ChosenPiece
{
  /// A possible extinction of the segment, see RayPiece.
  struct Matter
  {
    Number opticalDepth;
    Number tilt;

    LIMPID_HD LIMPID_INLINE Matter Part(const Number& share) const
    {
      return { share * this->opticalDepth, share * share * this->tilt };
    }

    template <class Condition>
    LIMPID_HD LIMPID_INLINE static Matter Chosen(
      const Condition& condition, const Matter& one, const Matter& other)
    {
      return { Select(condition, one.opticalDepth, other.opticalDepth),
        Select(condition, one.tilt, other.tilt) };
    }
  };

  RayPieceOf<Number> piece;

  /// The lower bound of the extinction, if there is one.
  LIMPID_HD LIMPID_INLINE Matter Least(bool isThere) const
  {
    return isThere
      ? Matter{ this->piece.keptShare * this->piece.opticalDepth, this->piece.keptTilt }
      : Matter{ 0.0f, 0.0f };
  }

  LIMPID_HD LIMPID_INLINE Matter Base() const
  {
    return { this->piece.opticalDepth, this->piece.tilt };
  }

  /// The upper bound of the extinction. `length`: of the segment [length].
  LIMPID_HD LIMPID_INLINE Matter Most(const MostExtinction<float>& most, const Number& length) const
  {
    return { length * most(Quotient(this->piece.opticalDepth, length)),
      (1.0f - most.emphasis) * this->piece.tilt };
  }

  /// Returns the most that the segment can show with the ceiling W behind it: with maximum
  /// extinction where g > W and minimum extinction elsewhere.
  LIMPID_HD LIMPID_INLINE Number Best(
    const Matter& least, const Matter& most, const Number& behind) const
  {
    const Number front = this->piece.front;
    const Number back = this->piece.back;
    const Number dense = this->Shown(most, front, back, behind);
    const Number thin = this->Shown(least, front, back, behind);
    const Number best = Select(dense > thin, dense, thin);
    const auto crosses = (front - behind) * (back - behind) < 0.0f;
    if (!AnyOf(crosses))
    {
      return best;
    }
    const Number at = Quotient(behind - front, back - front); // the position where g = W
    const auto first = front > behind;
    const Matter inFront = Matter::Chosen(first, most, least);
    const Matter inRear = Matter::Chosen(first, least, most);
    const Number rear = this->Shown(inRear.Part(1.0f - at), behind, back, behind);
    const Number both = this->Shown(inFront.Part(at), front, behind, rear);
    return Select(And(crosses, both > best), both, best);
  }

private:
  /// Returns what shows if the importance changes from `front` to `back`, including what is
  /// behind.
  LIMPID_HD LIMPID_INLINE Number Shown(
    const Matter& matter, const Number& front, const Number& back, const Number& behind) const
  {
    RayPieceOf<Number> part = this->piece;
    part.opticalDepth = matter.opticalDepth;
    part.tilt = matter.tilt;
    part.front = front;
    part.back = back;
    return part.Visible() + part.Passed() * behind;
  }
};

/**
 * Back to front: the most that a ray can show if it chooses its own extinction
 * (Documentation/Method.md, section on the ceiling).
 *
 * In a half layer of importance g and optical depth x, with the ceiling W behind it, the ray shows
 * g A(x) (1 - e^-x) + W e^-x. A is the mean of scale^2, weighted by where light is stopped. As
 *
 *    g A (1 - e^-x) + W e^-x = W + (1 - e^-x) (g A(x) - W)
 *
 * and A decreases with x, the smallest x is best if g A(least) <= W, and the largest x where rays
 * do not widen. Where they do, the maximum may lie between if g A(0) exceeds W by little; the step
 * then also tries the x of TurningPoint.
 *
 * `behind` becomes the ceiling of S: extinction up to `most`. `keptBehind` becomes that of the
 * kept base extinction (Kept): up to the base extinction, as more of it only attenuates.
 * `unattenuated` becomes the integral of g mu-bar.
 */
template <Kept kept>
struct CeilingStep
{
  RayStates rays;
  MostExtinction<float> most;

  /// RayInLayer::extinction is the base extinction, RayInLayer::kept the lower bound.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    this->Through(here, 1, i);
    this->Through(here, 0, i);
  }

  /// The ceiling of kept base extinction uses the same segments as a score of the base extinction,
  /// so that rounding cannot put the ceiling below the score.
  template <class Sampler, class Cuts>
  LIMPID_HD LIMPID_INLINE void operator()(const ResolvedRay<Sampler, Cuts>& here, Index i) const
  {
    ResolvedRay<Sampler, Cuts> ofBase = here;
    ofBase.densest = here.sampled;
    float* behind =
      kept == Kept::Counted ? this->rays[RayChannel::KeptBehind] : this->rays[RayChannel::Behind];
    float unattenuated = 0;
    const bool hasLeast = here.fields.base != nullptr;
    ofBase.ForPiecesBackward(
      [&](const RayPiece& piece)
      {
        const ChosenPiece<float> chosen{ piece };
        behind[i] = chosen.Best(chosen.Least(hasLeast), chosen.Base(), behind[i]);
        unattenuated += piece.Unattenuated();
        return true;
      });
    this->rays[RayChannel::Unattenuated][i] += ofBase.Unattenuated(unattenuated);
    if (kept == Kept::Counted)
    {
      here.ForPiecesBackward(
        [&](const RayPiece& piece)
        {
          const ChosenPiece<float> chosen{ piece };
          this->rays[RayChannel::Behind][i] = chosen.Best(chosen.Least(hasLeast),
            chosen.Most(this->most, here.LengthOf(piece)), this->rays[RayChannel::Behind][i]);
          return true;
        });
    }
  }

  /// Moves several rays at once, with the same bits; on the processor.
  template <class Cuts>
  void Lanes(const RowBetweenSlices& layer, const RaysInLanes& lanes) const;

private:
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE void Through(const RayInLayer<passage>& here, int half, Index i) const
  {
    const float base = here.extinction[half];
    const float least = here.kept[half] < base ? here.kept[half] : base;
    const HalfLayer<float> baseHalf = HalfOf(here, half, base);
    this->rays[RayChannel::Unattenuated][i] += baseHalf.unattenuated;
    if (kept == Kept::Ignored)
    {
      this->rays[RayChannel::Behind][i] =
        Best(here, half, { least, base }, baseHalf, this->rays[RayChannel::Behind][i]);
      return;
    }
    const float dense = this->most(base);
    this->rays[RayChannel::Behind][i] = Best(
      here, half, { least, dense }, HalfOf(here, half, dense), this->rays[RayChannel::Behind][i]);
    this->rays[RayChannel::KeptBehind][i] =
      Best(here, half, { least, base }, baseHalf, this->rays[RayChannel::KeptBehind][i]);
  }

  /// The part of a half inside the box, with another extinction [1/length].
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static HalfLayer<float> HalfOf(
    const RayInLayer<passage>& here, int half, float extinction)
  {
    return passage == LayerCrossing::Through
      ? WholeHalf<float>(
          here.layer, RangeOfHalf(half), here.length, extinction, here.importance[half])
      : CutHalf<Cut::Both>(
          here.layer, half, here.length, extinction, here.importance[half], here.column, here.row);
  }

  /// Returns the ceiling in front of a half whose extinction is in `bounds` [1/length]. `most`:
  /// the half at the upper bound.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static float Best(const RayInLayer<passage>& here, int half,
    const Range<float>& bounds, const HalfLayer<float>& most, float behind)
  {
    const float turning = TurningPoint(here, half, behind);
    const float atLeast = turning > bounds.begin ? turning : bounds.begin;
    const float other =
      Carried(HalfOf(here, half, atLeast < bounds.end ? atLeast : bounds.end), behind);
    const float atMost = Carried(most, behind);
    return atMost > other ? atMost : other;
  }

  /// Returns the extinction that maximises (1 - e^-x) (g A(x) - W), or 0 [1/length]. To first
  /// order in the widening, x depends only on r = (g A(0) - W) / (g (back^2 - front^2)): x = 6 r
  /// for small r, and within 3 % for all r
  ///
  ///    x = 6 r (1 + 0.54 r) / (1 + 2.04 r + 0.432 r^2).
  ///
  /// The error of the maximum is of second order in that. For large x, where the maximum is flat,
  /// the upper bound is used.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static float TurningPoint(
    const RayInLayer<passage>& here, int half, float behind)
  {
    const Layer& layer = here.layer;
    const Range<float> part = RangeOfHalf(half);
    const float widening = layer.backScale - layer.frontScale;
    const float front = layer.frontScale + part.begin * widening;
    const float wider = 0.5f * widening;
    const float importance = here.importance[half];
    const float gain = importance * (front * front + wider * (front + (1.0f / 3) * wider)) - behind;
    const float spread = importance * wider * (2.0f * front + wider);
    const float wanted = 6.0f * gain * (spread + 0.54f * gain);
    const float least = spread * spread + gain * (2.04f * spread + 0.432f * gain);
    return gain > 0.0f ? Quotient(wanted, least * (0.5f * layer.thickness * here.length)) : 0.0f;
  }
};

template <Kept kept>
inline constexpr bool stepsLanes<CeilingStep<kept>> = true;

/**
 * An upper bound of what a source sees for any extinction of the nodes within its bounds: the sum
 * over rays, each with its own best extinction. For SweepRaysBackward; the results are in
 * RayChannel::Visible and RayChannel::KeptVisible. `Cuts`: how layers are resolved.
 */
template <class Field, class Cuts>
struct CeilingKernel
{
  static constexpr const char* label = "ceiling";

  Field base;       ///< base extinction [1/length]
  Field importance; ///< [0, 1]
  Field least;      ///< lower bound of the extinction [1/length]; null stands for 0
  MostExtinction<float> most;
  Kept kept; ///< whether the ceiling of kept base extinction is computed, too

  template <class Windows>
  CeilingKernel<SliceWindow*, Cuts> With(Windows& windows) const
  {
    return { windows(this->base, FieldUse{ 1 }), windows(this->importance, FieldUse{ 1 }),
      windows(this->least, FieldUse{ 1 }), this->most, this->kept };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    ForValues(visit, RayChannel::Behind, RayChannel::Visible, RayChannel::Unattenuated);
    if (this->kept == Kept::Counted)
    {
      ForKept(visit);
    }
  }

  /// Moves rays from the slice behind to slice `s`.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, true))
    {
      return;
    }
    rays.SampleExtinction(this->base);
    rays.SampleImportance(this->importance);
    rays.SampleLeast(this->least);
    const RayFields<Field> fields{ this->base, this->importance, this->least };
    const ResolveImportant<Cuts> resolve{ this->most };
    if (this->kept == Kept::Counted)
    {
      rays.ForEachResolved(
        fields, resolve, CeilingStep<Kept::Counted>{ rays.States(), this->most });
    }
    else
    {
      rays.ForEachResolved(
        fields, resolve, CeilingStep<Kept::Ignored>{ rays.States(), this->most });
    }
  }
};
}

#endif

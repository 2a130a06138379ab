// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ceilings of resolved layers, of sixteen rays side by side.

#include "energy/CeilingKernel.h"
#include "sweep/RowsInLanes.h"

namespace limpid
{
namespace
{
/// The layer of several rays, back to front.
template <class Cuts>
struct LayerInLanes
{
  const RowBetweenSlices& layer;
  const HalvesInLanes& halves;
  const RaysInLanes& lanes;
  LaneSampler& sampler;

  /// Carries ceilings to the front of the layer, and returns the integral of g mu dt over all
  /// segments. `densest`: decides how layers are divided, see ResolvedRay; mostOf(segment, length):
  /// the largest extinction of a segment of that length.
  template <class MostOf>
  LIMPID_INLINE FloatLanes Carry(
    const float* densest, const MostOf& mostOf, FloatLanes& behind) const
  {
    const PartsInLanes<Cuts, PartOrder::BackToFront> parts(
      this->layer, this->halves, this->lanes, densest);
    const Layer here = this->layer.rays.layer;
    const bool hasLeast = this->layer.fields.base != nullptr;
    const FloatLanes way = FloatLanes::Load(this->halves.way.of);
    FloatLanes unattenuated = 0.0f;
    for (int number = 0; number < parts.count; ++number)
    {
      const IntLanes there = parts.Has(number);
      PartOfLayer<FloatLanes> part = parts.At(number);
      part.first = this->sampler.At(part.begin + part.size * float(gaussPoints[0]));
      part.second = this->sampler.At(part.begin + part.size * float(gaussPoints[1]));
      for (int at = piecesOfPart; at-- > 0;)
      {
        const ChosenPiece<FloatLanes> chosen{ part.Piece(here, at) };
        const FloatLanes best =
          chosen.Best(chosen.Least(hasLeast), mostOf(chosen, chosen.piece.size * way), behind);
        behind = Select(there, best, behind);
        unattenuated = unattenuated + Select(there, chosen.piece.Unattenuated(), 0.0f);
      }
    }
    return unattenuated;
  }
};

/// Reads the values of a channel for rays, one per lane.
LIMPID_INLINE FloatLanes Read(const float* channel, const RaysInLanes& lanes)
{
  InMemory<float> values;
  for (int lane = 0; lane < laneCount; ++lane)
  {
    values.of[lane] = channel[lanes.column[lane]];
  }
  return FloatLanes::Load(values.of);
}

/// Writes them.
LIMPID_INLINE void Write(const FloatLanes& lanesOf, const RaysInLanes& lanes, float* channel)
{
  const InMemory<float> values(lanesOf);
  for (int lane = 0; lane < lanes.count; ++lane)
  {
    channel[lanes.column[lane]] = values.of[lane];
  }
}
}

template <Kept kept>
template <class Cuts>
void CeilingStep<kept>::Lanes(const RowBetweenSlices& layer, const RaysInLanes& lanes) const
{
  const HalvesInLanes halves(PackedRow(layer.rays, lanes.column));
  RunMultiversioned(
    [this, &layer, &lanes, &halves]() LIMPID_INLINE_LAMBDA
    {
      LaneSampler sampler(layer, lanes.column);
      const LayerInLanes<Cuts> here{ layer, halves, lanes, sampler };
      float* const ofBase =
        kept == Kept::Counted ? this->rays[RayChannel::KeptBehind] : this->rays[RayChannel::Behind];
      FloatLanes behind = Read(ofBase, lanes);
      const auto base = [](const ChosenPiece<FloatLanes>& chosen, const FloatLanes&)
                          LIMPID_INLINE_LAMBDA { return chosen.Base(); };
      const InMemory<float> unattenuated(here.Carry(lanes.sampled, base, behind));
      Write(behind, lanes, ofBase);
      for (int lane = 0; lane < lanes.count; ++lane)
      {
        // See ResolvedRay::Unattenuated.
        this->rays[RayChannel::Unattenuated][lanes.column[lane]] +=
          !Cuts::atFaces && IsWhole(halves.Inside(lane)) ? halves.unattenuated.of[lane]
                                                         : unattenuated.of[lane];
      }
      if (kept == Kept::Counted)
      {
        float* const ofMost = this->rays[RayChannel::Behind];
        behind = Read(ofMost, lanes);
        const auto dense = [this](const ChosenPiece<FloatLanes>& chosen, const FloatLanes& length)
                             LIMPID_INLINE_LAMBDA { return chosen.Most(this->most, length); };
        here.Carry(lanes.densest, dense, behind);
        Write(behind, lanes, ofMost);
      }
    });
}

template void CeilingStep<Kept::Counted>::Lanes<UsualCuts>(
  const RowBetweenSlices&, const RaysInLanes&) const;
template void CeilingStep<Kept::Counted>::Lanes<FineCuts>(
  const RowBetweenSlices&, const RaysInLanes&) const;
template void CeilingStep<Kept::Ignored>::Lanes<UsualCuts>(
  const RowBetweenSlices&, const RaysInLanes&) const;
template void CeilingStep<Kept::Ignored>::Lanes<FineCuts>(
  const RowBetweenSlices&, const RaysInLanes&) const;
}

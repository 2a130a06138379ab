// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/ResolvedRows.h"

#include "sweep/RowsInLanes.h"

namespace limpid
{
namespace
{
LIMPID_INLINE void TakeEffects(const LayerEffectOf<FloatLanes>& effects, RaysInLanes& lanes)
{
  const InMemory<float> front(effects.front);
  const InMemory<float> back(effects.back);
  for (int lane = 0; lane < lanes.count; ++lane)
  {
    lanes.effect[lane] = { front.of[lane], back.of[lane] };
  }
}

template <class Cuts>
LIMPID_INLINE void TakeLight(
  const HalvesInLanes& halves, const LightOfPieces<FloatLanes>& light, RaysInLanes& lanes)
{
  const InMemory<float> transmittance(light.transmittance);
  const InMemory<float> opticalDepth(light.opticalDepth);
  const InMemory<float> visible(light.visible);
  const InMemory<float> unattenuated(light.unattenuated);
  const InMemory<float> keptVisible(light.keptVisible);
  const InMemory<float> keptUnattenuated(light.keptUnattenuated);
  for (int lane = 0; lane < lanes.count; ++lane)
  {
    const LightOfPieces<float> one{ transmittance.of[lane], opticalDepth.of[lane], visible.of[lane],
      unattenuated.of[lane], keptVisible.of[lane], keptUnattenuated.of[lane] };
    lanes.light[lane] = LightOf<Cuts>(one, halves.At(lane), IsWhole(halves.Inside(lane)));
  }
}
}

template <class Cuts, Effects effects>
void RowBetweenSlices::FindLight(RaysInLanes& lanes) const
{
  const HalvesInLanes halves(PackedRow(this->rays, lanes.column));
  RunMultiversioned(
    [this, &lanes, &halves]() LIMPID_INLINE_LAMBDA
    {
      LaneSampler sampler(*this, lanes.column);
      const PartsInLanes<Cuts, PartOrder::FrontToBack> parts(*this, halves, lanes, lanes.densest);
      const Layer here = this->rays.layer;
      LightOfPieces<FloatLanes> light;
      EffectOfPieces<FloatLanes> found;
      for (int number = 0; number < parts.count; ++number)
      {
        const IntLanes there = parts.Has(number);
        if (!Cuts::atFaces && !AnyOf(And(there, light.IsLit())))
        {
          break;
        }
        PartOfLayer<FloatLanes> part = parts.At(number);
        part.first = sampler.At(part.begin + part.size * float(gaussPoints[0]));
        part.second = sampler.At(part.begin + part.size * float(gaussPoints[1]));
        for (int at = 0; at < piecesOfPart; ++at)
        {
          const RayPieceOf<FloatLanes> piece = part.Piece(here, at);
          if (effects == Effects::Found)
          {
            found.Add(piece, light.transmittance, And(there, light.IsLit()), here.thickness);
          }
          light.Add(piece, there);
        }
      }
      if (effects == Effects::Found)
      {
        const FloatLanes behind = FloatLanes::Load(lanes.behind);
        TakeEffects(found.With(behind * light.transmittance), lanes);
      }
      TakeLight<Cuts>(halves, light, lanes);
    });
}

void RowBetweenSlices::IncludeEnds(
  const Range<int>& columns, float* extinction, float* importance) const
{
  RowBetweenSlices layer = *this;
  layer.fields.base = nullptr; // no kept extinction
  RunMultiversioned(
    [&]() LIMPID_INLINE_LAMBDA
    {
      for (int begin = columns.begin; begin < columns.end; begin += laneCount)
      {
        const int end = begin + laneCount < columns.end ? begin + laneCount : columns.end;
        int lanes[laneCount];
        for (int lane = 0; lane < laneCount; ++lane)
        {
          lanes[lane] = begin + lane < end ? begin + lane : end - 1;
        }
        LaneSampler sampler(layer, lanes);
        for (const float share : { 0.0f, 1.0f })
        {
          const PointSampleOf<FloatLanes> found = sampler.At(share);
          const InMemory<float> dense(found.extinction);
          const InMemory<float> important(found.importance);
          for (int i = begin; i < end; ++i)
          {
            extinction[i] = AtLeast(dense.of[i - begin], extinction[i]);
            importance[i] = AtLeast(important.of[i - begin], importance[i]);
          }
        }
      }
    });
}

template void RowBetweenSlices::FindLight<UsualCuts, Effects::Ignored>(RaysInLanes&) const;
template void RowBetweenSlices::FindLight<UsualCuts, Effects::Found>(RaysInLanes&) const;
template void RowBetweenSlices::FindLight<FineCuts, Effects::Ignored>(RaysInLanes&) const;
}

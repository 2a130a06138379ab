// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The most that can be seen of each structure, back to front.

#ifndef limpid_energy_MostSeenRow_h
#define limpid_energy_MostSeenRow_h

#include "energy/CeilingKernel.h"
#include "energy/StructureRowSampler.h"
#include "sweep/RayHere.h"

namespace limpid
{
/// Back to front: the most that can be seen of the structure that a ray is in, times its number.
struct MostStep
{
  CeilingStep<Kept::Ignored> ceiling;
  const float* in;   ///< [column]: see LedgerRays
  float* isResolved; ///< [column]: whether the layer of a ray in several structures is resolved

  template <LayerCrossing passage>
  LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    this->ceiling(here, i);
  }

  template <class Sampler, class Cuts>
  LIMPID_INLINE void operator()(const ResolvedRay<Sampler, Cuts>& here, Index i) const
  {
    this->isResolved[i] = 1;
    if (this->in[i] > 0.0f)
    {
      this->ceiling(here, i);
    }
  }
};

/// A row of rays that finds the most that each can show of each structure.
template <class Cuts>
class MostSeenRow : public StructureRowSampler
{
public:
  MostSeenRow(const FaceFrustum& frustum, const RayStates& states, int row,
    const LedgerSweep& sweep, SumsByStructure& sums)
    : StructureRowSampler(frustum, states, row, sweep, sums)
    , Most{ 0, sweep.majorant }
  {
  }

  /// Carries back to front, through the layer behind slice `s`, the most that rays can show of each
  /// structure. Where nothing of a structure is, rays clear the layer.
  void Cross(int s)
  {
    if (!this->Enter(s, [this](int column, float next) { this->LeaveMost(column, next); }))
    {
      return;
    }
    const LedgerFields<SliceWindow*>& fields = this->Sweep.fields;
    this->SampleLeast(fields.bound);
    this->ForEachResolved({ fields.extinction, fields.rows, fields.bound },
      ResolveImportant<Cuts>{ this->Most },
      MostStep{ { this->States(), this->Most }, this->In, this->IsResolved });
    const RowsOfStructures four[2] = { this->RowsAt(0, fields.bound),
      this->RowsAt(1, fields.bound) };
    for (const int column : this->Several)
    {
      this->FindMostOfSeveral(column, four);
    }
  }

  /// After all layers: counts the most that each ray can show.
  void Finish()
  {
    this->ForRays(
      [this](int column)
      {
        this->LeaveMost(column, LedgerRays::several);
        for (const MetStructure& met : this->Remembered[column].met)
        {
          this->Sums.Add(this->Sums.most[met.row], this->Weights[column] * double(met.mostSeen));
        }
      });
  }

private:
  /// Keeps the most that can be seen of the structure that a ray was in; then it is in another one.
  void LeaveMost(int column, float next)
  {
    LedgerRay& ray = this->Remembered[column];
    float& behind = this->States()[RayChannel::Behind][column];
    if (this->Was[column] > 0)
    {
      ray.Meet(RowOf(this->Was[column])).mostSeen = behind / this->Was[column];
    }
    this->Was[column] = next;
    behind = next > 0 ? next * ray.Meet(RowOf(next)).mostSeen : 0.0f;
  }

  /// Cross for a ray that meets several structures in the layer.
  void FindMostOfSeveral(int column, const RowsOfStructures (&four)[2])
  {
    const bool isResolved = this->IsResolved[column] != 0.0f;
    StructuresHere here = StructuresAt(column, four);
    if (isResolved)
    {
      this->AddAllNear(column, here);
    }
    for (std::size_t k = 0; k < here.count; ++k)
    {
      if (const StructureRow wanted = RowOf(here.number[k]); wanted > 0)
      {
        MetStructure& met = this->Remembered[column].Meet(wanted);
        detail::RayHere alone;
        float& behind = *alone.States()[RayChannel::Behind];
        behind = met.mostSeen;
        RayInLayer<LayerCrossing::Clipped> ray = this->RayAt(column, here.share[k]);
        ray.kept[0] = here.bound[k][0];
        ray.kept[1] = here.bound[k][1];
        const CeilingStep<limpid::Kept::Ignored> step{ alone.States(), this->Most };
        const Membership shareOf{ wanted };
        if (isResolved)
        {
          this->Resolve(
            column, ray, RayOf{ *this, shareOf, true }, ResolveImportant<Cuts>{ this->Most }, step);
        }
        else
        {
          StepPlainly(ray, step);
        }
        met.mostSeen = behind;
      }
    }
  }

  MostExtinction<float> Most; ///< the base extinction
};
}

#endif

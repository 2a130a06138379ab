// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What light meets of each structure, front to back.

#ifndef limpid_energy_SeenRow_h
#define limpid_energy_SeenRow_h

#include "energy/StructureRowSampler.h"
#include "sweep/RayHere.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace limpid
{
/// Front to back: what a ray sees of the structure that it is in.
struct LedgerStep
{
  RayStates rays;
  float* hiddenPerDepth;   ///< [column]: integral of what is hidden over the optical depth there
  const float* in;         ///< [column]: see LedgerRays
  const float* importance; ///< [row]: of the structures
  // What rays in several structures find for an importance of 1: [half][column].
  float* visible[2];
  float* kept[2];
  float* depth[2];
  float* isResolved; ///< [column]: whether these are not set

  template <LayerCrossing passage>
  LIMPID_INLINE void operator()(const RayInLayer<passage>& here, Index i) const
  {
    RayInLayer<passage> whole = here;
    whole.importance[0] = whole.importance[1] = 1;
    const HalfLayer<float> front = whole.template Half<Cut::Both>(0);
    const HalfLayer<float> rear = whole.template Half<Cut::Both>(1);
    const float keptFront = here.KeptShare(0);
    const float keptRear = here.KeptShare(1);
    const float transmittance = Attenuate(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
    this->visible[0][i] = transmittance * front.visible * keptFront;
    this->visible[1][i] = transmittance * front.Passed() * rear.visible * keptRear;
    this->kept[0][i] = front.unattenuated * keptFront;
    this->kept[1][i] = rear.unattenuated * keptRear;
    this->depth[0][i] = here.template Half<Cut::Entry>(0).LimitedDepth();
    this->depth[1][i] = here.template Half<Cut::Entry>(1).LimitedDepth();
    this->Add(this->visible[0][i] + this->visible[1][i], this->kept[0][i] + this->kept[1][i],
      this->depth[0][i] + this->depth[1][i], i);
  }

  /// The importance of the layer is the number of the row.
  LIMPID_INLINE void operator()(const LitRay& here, Index i) const
  {
    const float number = this->in[i];
    this->isResolved[i] = 1;
    if (number > 0.0f)
    {
      // Resolved because of the structure, but not in a score of unimportant ones.
      const bool isScored = this->importance[RowOf(number)] > 0.0f;
      const LayerLight light = here.Light();
      const float transmittance = Attenuate(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
      this->Add(transmittance * light.keptVisible / number, light.keptUnattenuated / number,
        isScored ? light.opticalDepth : here.DepthFromEntry(), i);
    }
  }

private:
  LIMPID_INLINE void Add(float seen, float present, float thickness, Index i) const
  {
    const bool isPart = this->in[i] > 0.0f;
    const auto middle = static_cast<float>(this->rays[RayDepth::ToSlice][i]) + 0.5f * thickness;
    const float perDepth = middle > 0.0f ? Quotient(present - seen, middle) : 0.0f;
    this->rays[RayChannel::KeptVisible][i] += isPart ? seen : 0.0f;
    this->rays[RayChannel::KeptUnattenuated][i] += isPart ? present : 0.0f;
    this->hiddenPerDepth[i] += isPart ? perDepth : 0.0f;
    this->rays[RayDepth::ToSlice][i] += this->in[i] >= 0.0f ? thickness : 0.0f;
  }
};

/// A row of rays that counts what it sees of each structure, and what hides it.
template <class Cuts>
class SeenRow : public StructureRowSampler
{
public:
  SeenRow(const FaceFrustum& frustum, const RayStates& states, int row, const LedgerSweep& sweep,
    SumsByStructure& sums)
    : StructureRowSampler(frustum, states, row, sweep, sums)
    , HiddenPerDepth(sweep.rays.hiddenPerDepth.data() + frustum.RayAt(0, row))
  {
    for (float** values : { &this->Visible[0], &this->Visible[1], &this->Kept[0], &this->Kept[1],
           &this->Depth[0], &this->Depth[1] })
    {
      *values = this->Take(frustum.columns);
    }
  }

  /// Carries light front to back through the layer behind slice `s`.
  void Cross(int s)
  {
    if (!this->Enter(s, [this](int column, float next) { this->LeaveSeen(column, next); }))
    {
      return;
    }
    const LedgerFields<SliceWindow*>& fields = this->Sweep.fields;
    if (fields.bound)
    {
      this->SampleKept(fields.extinction, fields.bound);
    }
    const RayStates states = this->States();
    this->ForEachResolved({ fields.extinction, fields.rows, fields.bound },
      ResolveLit<Cuts>{ states[RayDepth::ToSlice] },
      LedgerStep{ states, this->HiddenPerDepth, this->In, this->Sweep.importance.data(),
        { this->Visible[0], this->Visible[1] }, { this->Kept[0], this->Kept[1] },
        { this->Depth[0], this->Depth[1] }, this->IsResolved });
    const RowsOfStructures four[2] = { this->RowsAt(0, nullptr), this->RowsAt(1, nullptr) };
    for (const int column : this->Several)
    {
      this->SeeSeveral(column, four);
    }
  }

  /// After all layers: counts what was seen of the structures that rays are in.
  void Finish()
  {
    this->ForRays([this](int column) { this->LeaveSeen(column, LedgerRays::several); });
  }

private:
  /// Counts what a ray has seen in the structure that it was in; then it is in another one.
  void LeaveSeen(int column, float next)
  {
    const RayStates states = this->States();
    LedgerRay& ray = this->Remembered[column];
    const double depth = states[RayDepth::ToSlice][column];
    float& visible = states[RayChannel::KeptVisible][column];
    float& kept = states[RayChannel::KeptUnattenuated][column];
    float& perDepth = this->HiddenPerDepth[column];
    const double weight = this->Weights[column];
    if (this->Was[column] >= 0 && weight > 0)
    {
      const StructureRow row = RowOf(this->Was[column]);
      if (row > 0)
      {
        this->Count(row, weight * double(visible), weight * double(kept));
      }
      if (this->Sums.TellsHiders())
      {
        ray.Meet(row).depth += depth - ray.since;
        this->Hide(ray, row, weight * (double(kept) - double(visible)), weight * double(perDepth));
      }
    }
    this->Was[column] = next;
    ray.since = depth;
    visible = kept = perDepth = 0;
  }

  void Count(StructureRow row, double visible, double kept)
  {
    this->Sums.Add(this->Sums.visible[row], visible);
    this->Sums.Add(this->Sums.kept[row], kept);
  }

  /// Divides what is hidden of a structure among those in front. `perDepth`: the integral of what
  /// is hidden, divided by the optical depth in front of it.
  void Hide(const LedgerRay& ray, StructureRow row, double hidden, double perDepth)
  {
    if (row == 0)
    {
      return;
    }
    double byItself = hidden;
    for (const MetStructure& by : ray.met)
    {
      if (by.row != row && by.depth > 0)
      {
        this->Sums.Add(this->Sums.HiddenBy(row, by.row), by.depth * perDepth);
        byItself -= by.depth * perDepth;
      }
    }
    this->Sums.Add(this->Sums.HiddenBy(row, row), byItself);
  }

  /// What light finds of a structure in a layer.
  struct OfLayer
  {
    double depth; ///< its part of the optical depth, up to a common factor
    double visible;
    double kept; ///< `visible` without attenuation
  };

  /// Lets light pass through a layer in which a ray meets several structures.
  void SeeSeveral(int column, const RowsOfStructures (&four)[2])
  {
    StructuresHere here = StructuresAt(column, four);
    std::array<OfLayer, StructuresHere::most> found;
    double thickness = 0;
    if (this->IsResolved[column] == 0.0f)
    {
      for (std::size_t k = 0; k < here.count; ++k)
      {
        const auto sum = [column, &share = here.share[k]](float* const values[2])
        { return double(share[0] * values[0][column] + share[1] * values[1][column]); };
        found[k] = { sum(this->Depth), sum(this->Visible), sum(this->Kept) };
      }
      thickness = double(this->Depth[0][column] + this->Depth[1][column]);
    }
    else
    {
      this->AddAllNear(column, here);
      thickness = this->SeeResolved(column, here, found);
    }
    this->Pass(column, here, found, thickness);
  }

  /// Lets light pass through a resolved layer: once with the importance of each structure, and with
  /// that of all. Returns the optical depth.
  double SeeResolved(
    int column, const StructuresHere& here, std::array<OfLayer, StructuresHere::most>& found) const
  {
    const auto see = [&](const auto& shareOf, const StructuresHere::AtGaussPoints& importance)
    {
      detail::RayHere alone;
      alone.toSlice = this->States()[RayDepth::ToSlice][column];
      RayInLayer<LayerCrossing::Clipped> ray = this->RayAt(column, importance);
      this->Resolve(column, ray, RayOf{ *this, shareOf, false }, ResolveLit<Cuts>{ &alone.toSlice },
        ScoreStep<limpid::Kept::Counted>{ alone.States() });
      return alone;
    };
    StructuresHere::AtGaussPoints important{};
    for (std::size_t k = 0; k < here.count; ++k)
    {
      const StructureRow wanted = RowOf(here.number[k]);
      detail::RayHere alone = see(Membership{ wanted }, here.share[k]);
      const RayStates states = alone.States();
      found[k] = { double(*states[RayChannel::Unattenuated]),
        double(*states[RayChannel::KeptVisible]), double(*states[RayChannel::KeptUnattenuated]) };
      for (std::size_t half = 0; half < 2; ++half)
      {
        important[half] += this->Sweep.importance[wanted] * here.share[k][half];
      }
    }
    const detail::RayHere all =
      see([this](StructureRow row) { return this->Sweep.importance[row]; }, important);
    return all.toSlice - this->States()[RayDepth::ToSlice][column];
  }

  /// Counts what light finds in a layer with several structures.
  void Pass(int column, const StructuresHere& here,
    const std::array<OfLayer, StructuresHere::most>& found, double thickness)
  {
    const double weight = this->Weights[column];
    for (std::size_t k = 0; k < here.count; ++k)
    {
      if (here.number[k] > 0)
      {
        this->Count(RowOf(here.number[k]), weight * found[k].visible, weight * found[k].kept);
      }
    }
    if (this->Sums.TellsHiders())
    {
      this->HideSeveral(this->Remembered[column], here, found, thickness, weight);
    }
    this->States()[RayDepth::ToSlice][column] += thickness;
  }

  /// Returns the part of a structure in a layer that is in its front half or its rear half.
  static double PartInHalf(const StructuresHere& here, std::size_t k, std::size_t half)
  {
    const double both = double(here.share[k][0]) + double(here.share[k][1]);
    return both > 0 ? double(here.share[k][half]) / both : 0.5;
  }

  /// Divides what is hidden among those in front of the middle of each half of the layer.
  void HideSeveral(LedgerRay& ray, const StructuresHere& here,
    const std::array<OfLayer, StructuresHere::most>& found, double thickness, double weight)
  {
    double before = 0;
    for (const MetStructure& met : ray.met)
    {
      before += std::max(met.depth, 0.0);
    }
    double all = 0;
    std::array<double, 2> deeper{};
    for (std::size_t k = 0; k < here.count; ++k)
    {
      all += found[k].depth;
      deeper[0] += found[k].depth * PartInHalf(here, k, 0);
      deeper[1] += found[k].depth * PartInHalf(here, k, 1);
    }
    const double perDepth = all > 0 ? thickness / all : 0.0;
    // Share of the light that is lost at the middle of each half.
    const std::array<double, 2> lost{ Stop(before + perDepth * 0.5 * deeper[0]),
      Stop(before + perDepth * (deeper[0] + 0.5 * deeper[1])) };
    for (std::size_t half = 0; half < 2; ++half)
    {
      const auto deepen = [&] // to the middle of the half, and to its end
      {
        for (std::size_t k = 0; k < here.count; ++k)
        {
          ray.Meet(RowOf(here.number[k])).depth +=
            0.5 * perDepth * found[k].depth * PartInHalf(here, k, half);
        }
      };
      deepen();
      double depth = 0;
      for (const MetStructure& met : ray.met)
      {
        depth += std::max(met.depth, 0.0);
      }
      for (std::size_t k = 0; k < here.count; ++k)
      {
        const double frontPart = PartInHalf(here, k, 0) * lost[0];
        const double both = frontPart + PartInHalf(here, k, 1) * lost[1];
        const double share = both > 0 ? PartInHalf(here, k, half) * lost[half] / both : 0.5;
        const double hidden = weight * share * (found[k].kept - found[k].visible);
        this->Hide(ray, RowOf(here.number[k]), hidden, depth > 0 ? hidden / depth : 0.0);
      }
      deepen();
    }
  }

  float* HiddenPerDepth; ///< see LedgerStep, like the following
  float* Visible[2];
  float* Kept[2];
  float* Depth[2];
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Resolved layers of rays side by side are those of each ray alone, bit by bit.

#include "PlanSweep.h"
#include "backend/HostDevice.h"
#include "energy/CeilingKernel.h"
#include "sweep/FrustumRays.h"
#include "sweep/RowSampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
/// What a step finds for one ray.
struct Found
{
  LayerLight light;
  LayerEffect effect{ 0, 0 };

  /// All numbers, for comparisons.
  std::vector<float> All() const
  {
    return { this->light.passed, this->light.visible, this->light.unattenuated,
      this->light.keptVisible, this->light.keptUnattenuated, this->light.opticalDepth,
      this->effect.front, this->effect.back };
  }
};

using FoundByColumn = std::map<Index, Found>;

/// Steps that record the light of resolved layers, of rays side by side and of each ray alone.
template <bool withEffects>
struct RecordTogether
{
  FoundByColumn* found;
  float behind;

  template <LayerCrossing passage>
  void operator()(const RayInLayer<passage>&, Index) const
  {
  }

  void operator()(const LitRay& here, Index i) const
  {
    Found& one = (*this->found)[i];
    one.light = withEffects ? here.Light(this->behind, one.effect) : here.Light();
  }
};

template <bool withEffects>
struct RecordAlone
{
  FoundByColumn* found;
  float behind;

  template <LayerCrossing passage>
  void operator()(const RayInLayer<passage>&, Index) const
  {
  }

  template <class Sampler, class Cuts>
  void operator()(const ResolvedRay<Sampler, Cuts>& here, Index i) const
  {
    Found& one = (*this->found)[i];
    one.light = withEffects ? here.Light(this->behind, one.effect) : here.Light();
  }
};

/// Moves each ray alone, and records those whose layers are resolved.
template <Kept kept>
struct CeilingAlone
{
  CeilingStep<kept> step;
  std::vector<Index>* resolved;

  template <LayerCrossing passage>
  void operator()(const RayInLayer<passage>& here, Index i) const
  {
    this->step(here, i);
  }

  template <class Sampler, class Cuts>
  void operator()(const ResolvedRay<Sampler, Cuts>& here, Index i) const
  {
    this->resolved->push_back(i);
    this->step(here, i);
  }
};
}

namespace limpid
{
template <>
constexpr bool findsEffects<RecordTogether<true>> = true;
}

namespace
{
/// Opaque, half-opaque and empty nodes at random, of which some are important.
struct RandomScene
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;
  std::vector<float> base;

  explicit RandomScene(unsigned int seed)
  {
    this->grid.nodes = { 19, 23, 17 };
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0, 1);
    for (Index i = 0; i < this->grid.NodeCount(); ++i)
    {
      this->extinction.push_back(share(random) < 0.3f ? 0.0f : std::pow(100.0f, share(random)));
      this->importance.push_back(share(random) < 0.5f ? 0.0f : share(random));
      this->base.push_back(20 * share(random));
    }
  }

  /// Compares all layers of all rays from a source. Returns the number of resolved layers.
  template <class Cuts, bool withEffects>
  int Compare(const RaySource& source, bool countsKept) const
  {
    return this->ForRows(source, countsKept, CompareRow<Cuts, withEffects>);
  }

  /// Compares ceilings likewise.
  template <class Cuts, Kept kept>
  int CompareCeilings(const RaySource& source, bool hasLeast) const
  {
    return this->ForRows(source, hasLeast, CompareCeilingsOfRow<Cuts, kept>);
  }

private:
  /// Calls compare(rays, fields, columns) for every row of rays in every layer, and returns the sum
  /// of what it returns. `hasBase`: whether fields have a base.
  template <class CompareRow>
  int ForRows(const RaySource& source, bool hasBase, const CompareRow& compare) const
  {
    const auto device = std::make_shared<HostDevice>();
    const Occupancy occupancy(this->grid, this->extinction.data(), this->importance.data(), true);
    int resolved = 0;
    for (const PlannedFrustum& frustum :
      PlanSweep(this->grid, occupancy, source, { 1, RayPlacement::ForIntegrals }))
    {
      RayImages<HostDevice> images(device, frustum.RayCount());
      const RayStates states = images.States();
      const BandDecomposition bands(frustum, *ThisProcess());
      const std::unique_ptr<FieldSlabs> slabs = FieldSlabs::Local(frustum, bands);
      FieldSlabs::Windows windows;
      for (const std::vector<float>* field : { &this->extinction, &this->importance, &this->base })
      {
        windows.push_back(slabs->Open(const_cast<float*>(field->data()), { 1 }));
      }
      slabs->Load({ 0, frustum.SliceCount() }, nullptr, windows);
      for (int row = 0; row < frustum.rows; ++row)
      {
        for (int s = 0; s < frustum.lastSlice; ++s)
        {
          RowSampler rays(frustum, states, row);
          if (rays.EnterLayer(s, true))
          {
            const RayFields<SliceWindow*> fields{ &windows[0], &windows[1],
              hasBase ? &windows[2] : nullptr };
            resolved += compare(rays, fields, frustum.columns);
          }
        }
      }
    }
    return resolved;
  }

  template <class Cuts, Kept kept>
  static int CompareCeilingsOfRow(
    RowSampler& rays, const RayFields<SliceWindow*>& fields, int columns)
  {
    const RayStates states = rays.States();
    rays.SampleExtinction(fields.extinction);
    rays.SampleImportance(fields.importance);
    rays.SampleLeast(fields.base);
    const MostExtinction<float> most{ 0.4f, 120.0f };
    const ResolveImportant<Cuts> resolve{ most };
    const auto stepBy = [&](const auto& step)
    {
      for (int i = 0; i < columns; ++i)
      {
        states[RayChannel::Behind][i] = 0.11f * static_cast<float>(i % 9);
        states[RayChannel::KeptBehind][i] = 0.07f * static_cast<float>(i % 11);
        states[RayChannel::Unattenuated][i] = 0.5f;
      }
      rays.ForEachResolved(fields, resolve, step);
      std::vector<std::array<float, 3>> found;
      found.reserve(static_cast<std::size_t>(columns));
      for (int i = 0; i < columns; ++i)
      {
        found.push_back({ states[RayChannel::Behind][i], states[RayChannel::KeptBehind][i],
          states[RayChannel::Unattenuated][i] });
      }
      return found;
    };
    std::vector<Index> resolved;
    const CeilingStep<kept> step{ states, most };
    const auto together = stepBy(step);
    const auto alone = stepBy(CeilingAlone<kept>{ step, &resolved });
    for (const Index column : resolved)
    {
      EXPECT_EQ(together[std::size_t(column)], alone[std::size_t(column)]) << "column " << column;
    }
    return static_cast<int>(resolved.size());
  }

  template <class Cuts, bool withEffects>
  static int CompareRow(RowSampler& rays, const RayFields<SliceWindow*>& fields, int columns)
  {
    const float behind = 0.3f;
    const RayStates states = rays.States();
    for (int i = 0; i < columns; ++i)
    {
      states[RayDepth::ToSlice][i] = i % 7 == 0 ? 20 : 0.1 * i; // some are in the dark
      states[RayChannel::Behind][i] = behind;
    }
    rays.SampleExtinction(fields.extinction);
    rays.SampleImportance(fields.importance);
    if (fields.base)
    {
      rays.SampleKept(fields.extinction, fields.base);
    }
    FoundByColumn together;
    FoundByColumn alone;
    const ResolveLit<Cuts> resolve{ states[RayDepth::ToSlice] };
    rays.ForEachResolved(fields, resolve, RecordTogether<withEffects>{ &together, behind });
    rays.ForEachResolved(fields, resolve, RecordAlone<withEffects>{ &alone, behind });
    EXPECT_EQ(together.size(), alone.size());
    for (const auto& [column, one] : alone)
    {
      EXPECT_EQ(together[column].All(), one.All()) << "column " << column;
    }
    return static_cast<int>(alone.size());
  }
};

RaySource EyeAt(double x, double y, double z)
{
  RaySource eye;
  eye.origin = { x, y, z };
  return eye;
}
}

TEST(ResolvedRows, AreThoseOfEachRayAloneWithTheirEffects)
{
  const RandomScene scene(1);

  for (const RaySource& eye : { EyeAt(-9, 12, 8), EyeAt(7, 40, 3), EyeAt(9, 9, -6) })
  {
    EXPECT_GT((scene.Compare<UsualCuts, true>(eye, true)), 1000);
    EXPECT_GT((scene.Compare<UsualCuts, true>(eye, false)), 1000);
  }
}

TEST(ResolvedRows, AreThoseOfEachRayAloneInScores)
{
  const RandomScene scene(2);

  for (const RaySource& eye : { EyeAt(-9, 12, 8), EyeAt(7, 40, 3), EyeAt(9, 9, -6) })
  {
    EXPECT_GT((scene.Compare<FineCuts, false>(eye, true)), 1000);
    EXPECT_GT((scene.Compare<UsualCuts, false>(eye, false)), 1000);
  }
}

TEST(ResolvedRows, AreThoseOfEachRayAloneInCeilings)
{
  const RandomScene scene(3);

  for (const RaySource& eye : { EyeAt(-9, 12, 8), EyeAt(7, 40, 3), EyeAt(9, 9, -6) })
  {
    for (const bool hasLeast : { false, true })
    {
      EXPECT_GT((scene.CompareCeilings<UsualCuts, Kept::Ignored>(eye, hasLeast)), 1000);
      EXPECT_GT((scene.CompareCeilings<UsualCuts, Kept::Counted>(eye, hasLeast)), 1000);
      EXPECT_GT((scene.CompareCeilings<FineCuts, Kept::Ignored>(eye, hasLeast)), 1000);
      EXPECT_GT((scene.CompareCeilings<FineCuts, Kept::Counted>(eye, hasLeast)), 1000);
    }
  }
}

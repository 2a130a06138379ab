// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An optimisation by one rank and by several, and whether the bits are the same.

#ifndef limpid_testing_SceneOnRanks_h
#define limpid_testing_SceneOnRanks_h

#include "ThreadRanks.h"

#include "optimize/Solver.h"
#include "scene/FieldView.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <mutex>
#include <vector>

namespace limpid
{
/// A scene, whole.
struct Whole
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;
  Camera camera;
  Light light;
  Settings settings;
  FieldPlaces places = FieldPlaces::Chosen;

  template <class Scene>
  explicit Whole(const Scene& scene)
    : grid(scene.grid)
    , extinction(scene.extinction)
    , importance(scene.importance)
    , camera(scene.camera)
    , light(scene.light)
    , settings(scene.settings)
  {
  }
};

/// What comes of an optimisation.
struct Found
{
  std::vector<float> extinction;
  std::vector<float> lightExtinction; ///< empty: none
  std::vector<float> transmittance;
  std::vector<float> lightTransmittance;
  std::vector<IterationRecord> history;
  Score base;
  Score best;
  Ceiling ceiling;
};

inline Found FoundBy(const Solver& solver)
{
  Found found{ solver.Extinction(), solver.LightExtinction(), {}, {}, solver.History(),
    solver.BaseScore(), solver.BestScore(), solver.FindCeiling() };
  found.transmittance.resize(found.extinction.size());
  found.lightTransmittance.resize(found.extinction.size());
  solver.Transmittance(found.transmittance.data());
  solver.LightTransmittance(found.lightTransmittance.data());
  return found;
}

inline Found Optimized(const SceneFields& fields, const Whole& scene)
{
  Solver solver(fields, scene.camera, scene.light, scene.settings);
  solver.Run();
  return FoundBy(solver);
}

/// What is found of a scene's fields, or of a rank's part of them.
using Find = std::function<Found(const SceneFields& fields, const Whole& scene)>;

inline Found ByOne(const Whole& scene, const Find& find)
{
  return find({ scene.grid, scene.extinction.data(), scene.importance.data() }, scene);
}

inline Found OptimizedAlone(const Whole& scene)
{
  return ByOne(scene, Optimized);
}

/// Where ranks may be told to have fields.
constexpr FieldPlaces placesOfFields[] = { FieldPlaces::BesideAllRays, FieldPlaces::BesideFirstRays,
  FieldPlaces::InSlabs };

/// The nodes of a rank.
using Pieces = std::function<NodeBox(int rank)>;

/// Slabs along an axis, one for each rank, but for `empty` of them which have none; with `more`
/// layers of their neighbours.
inline Pieces Slabs(const Int3& nodes, int axis, int ranks, int empty = 0, int more = 0)
{
  return [=](int rank)
  {
    NodeBox box = NodeBox::Of(nodes);
    const int parts = ranks - empty;
    const int part = rank - empty;
    const int count = nodes[axis];
    box.along[std::size_t(axis)] = part < 0
      ? Range<int>{}
      : Range<int>{ std::max(count * part / parts - more, 0),
          std::min(count * (part + 1) / parts + more, count) };
    return box;
  };
}

inline FieldView WholeOf(const std::vector<float>& field, const Int3& nodes)
{
  return FieldView::Whole(const_cast<float*>(field.data()), nodes);
}

inline FieldView PartOf(const std::vector<float>& field, const NodeBox& box)
{
  return FieldView::Part(const_cast<float*>(field.data()), box);
}

inline std::vector<float> Cut(
  const std::vector<float>& field, const Int3& nodes, const NodeBox& box)
{
  std::vector<float> values(std::size_t(box.Count()));
  CopyNodes(box, WholeOf(field, nodes), PartOf(values, box));
  return values;
}

/// Calls what(fields, box) with a rank's piece of a scene.
template <class What>
void OnPiece(const std::shared_ptr<const Communicator>& all, const Whole& scene,
  const Pieces& pieces, const What& what)
{
  const NodeBox box = pieces(all->Rank());
  const std::vector<float> extinction = Cut(scene.extinction, scene.grid.nodes, box);
  const std::vector<float> importance = Cut(scene.importance, scene.grid.nodes, box);
  SceneFields fields{ scene.grid, extinction.data(), importance.data() };
  auto piece = std::make_shared<ScenePiece>(all, scene.grid, box);
  piece->places = scene.places;
  fields.piece = std::move(piece);
  what(fields, box);
}

/// Calls what(fields, box) on every rank.
template <class What>
void OnRanks(int ranks, const Whole& scene, const Pieces& pieces, const What& what)
{
  ThreadRanks::Run(ranks,
    [&](const std::shared_ptr<const Communicator>& all) { OnPiece(all, scene, pieces, what); });
}

/// What ranks find together.
inline Found By(int ranks, const Whole& scene, const Pieces& pieces, const Find& find)
{
  Found found;
  for (std::vector<float>* field :
    { &found.extinction, &found.transmittance, &found.lightTransmittance, &found.lightExtinction })
  {
    field->assign(scene.extinction.size(), -1.0f);
  }
  std::mutex access;
  OnRanks(ranks, scene, pieces,
    [&](const SceneFields& fields, const NodeBox& box)
    {
      const Found here = find(fields, scene);
      const std::lock_guard<std::mutex> lock(access);
      const auto put = [&](const std::vector<float>& part, std::vector<float>& whole)
      { CopyNodes(box, PartOf(part, box), WholeOf(whole, scene.grid.nodes)); };
      put(here.extinction, found.extinction);
      put(here.transmittance, found.transmittance);
      put(here.lightTransmittance, found.lightTransmittance);
      here.lightExtinction.empty() && box.Count() > 0
        ? found.lightExtinction.clear()
        : put(here.lightExtinction, found.lightExtinction);
      found.history = here.history;
      found.base = here.base;
      found.best = here.best;
      found.ceiling = here.ceiling;
    });
  return found;
}

inline Found OptimizedBy(int ranks, const Whole& scene, const Pieces& pieces)
{
  return By(ranks, scene, pieces, Optimized);
}

inline void ExpectSame(const Score& one, const Score& other)
{
  EXPECT_EQ(one.visibility, other.visibility);
  EXPECT_EQ(one.fraction, other.fraction);
  EXPECT_EQ(one.sacrificed, other.sacrificed);
}

inline void ExpectSame(
  const std::vector<float>& one, const std::vector<float>& other, const char* what)
{
  ASSERT_EQ(one.size(), other.size()) << what;
  EXPECT_EQ(0, one.empty() ? 0 : std::memcmp(one.data(), other.data(), one.size() * sizeof(float)))
    << what;
}

inline void ExpectSame(const Found& one, const Found& other)
{
  ASSERT_EQ(one.history.size(), other.history.size());
  for (std::size_t i = 0; i < one.history.size(); ++i)
  {
    EXPECT_EQ(one.history[i].energy.Total(), other.history[i].energy.Total()) << "iteration " << i;
    EXPECT_EQ(one.history[i].meanChange, other.history[i].meanChange) << "iteration " << i;
    ExpectSame(one.history[i].score, other.history[i].score);
  }
  ExpectSame(one.base, other.base);
  ExpectSame(one.best, other.best);
  EXPECT_EQ(one.ceiling.visibility, other.ceiling.visibility);
  EXPECT_EQ(one.ceiling.fraction, other.ceiling.fraction);
  EXPECT_EQ(one.ceiling.lightVisibility, other.ceiling.lightVisibility);
  ExpectSame(one.extinction, other.extinction, "extinction");
  ExpectSame(one.lightExtinction, other.lightExtinction, "extinction for the light");
  ExpectSame(one.transmittance, other.transmittance, "transmittance");
  ExpectSame(one.lightTransmittance, other.lightTransmittance, "transmittance of the light");
}
}

#endif

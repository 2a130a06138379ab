// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A camera that moves and rests before a scene that ranks share: what is shown on the way is what
// one process shows, bit for bit.

#include "BoxScene.h"
#include "PretendedClock.h"
#include "SceneOnRanks.h"

#include "Resampled.h"
#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <ostream>
#include <vector>

using namespace limpid;

namespace
{
constexpr double coarseTime = 1e-9; ///< in which nobody gets far [s]

/// What is shown, of all nodes of its grid, or of a rank's piece.
struct ShownNow
{
  Grid grid;
  std::vector<float> base;
  std::vector<float> extinction;
  std::vector<float> ofLight;
  Score before;
  Score after;
  CarriedChange change;
};

ShownNow Now(const Progressive& progressive)
{
  const Grid& grid = progressive.ShownGrid();
  const auto all = [&](const float* field)
  { return std::vector<float>(field, field + grid.NodeCount()); };
  return { grid, all(progressive.BaseExtinction()), all(progressive.Extinction()),
    all(progressive.LightExtinction()), progressive.BaseScore(), progressive.BestScore(),
    progressive.Change() };
}

/// Goes round the scene a little, `step` times.
Camera Moved(const Whole& scene, int step)
{
  Camera camera = scene.camera;
  camera.position += 0.05 * step * scene.grid.Radius() * Vec3(1, -0.5, 0.2);
  return camera;
}

/// Moves, rests, moves on, and edits: calls show(step, progressive) after every one of these.
void GoRound(const SceneFields& fields, const Whole& scene,
  const std::function<void(int step, const Progressive&)>& show)
{
  int step = 0;
  Progressive first(fields, scene.settings);
  const int rank = fields.piece ? fields.piece->ranks->Rank() : 0;
  const PretendedClock clock(1e-6 / (1 + rank)); // ranks have different ones
  const auto moves = [&](Progressive& progressive, double seconds)
  {
    progressive.SetView(Moved(scene, step), scene.light, scene.settings);
    progressive.Preview(seconds);
    show(step++, progressive);
  };
  moves(first, coarseTime);
  moves(first, coarseTime);
  moves(first, 8e-3); // on a finer grid
  while (!first.Refine())
  {
  }
  show(step++, first);
  moves(first, coarseTime);
  Progressive second(fields, scene.settings);
  second.GoOnFrom(first.Change());
  second.SetView(Moved(scene, step), scene.light, scene.settings);
  show(step++, second);
  moves(second, coarseTime);
  second.Refine();
  second.Refine();
  show(step++, second);
}

void ExpectSame(const CarriedChange& alone, const CarriedChange& here, const Grid& whole)
{
  EXPECT_EQ(alone.likeness, here.likeness);
  if (here.piece->IsWhole())
  {
    EXPECT_EQ(here.grid.nodes, alone.grid.nodes);
    EXPECT_EQ(here.ofExtinction, alone.ofExtinction);
    EXPECT_EQ(here.ofLight, alone.ofLight);
    return;
  }
  const NodeBox& box = here.piece->nodes;
  const auto expectPart = [&](const std::vector<float>& all, const std::vector<float>& part)
  {
    const std::vector<float> fine = all.empty() ? all : Resampled(alone.grid, all.data(), whole);
    EXPECT_EQ(part, all.empty() ? all : Cut(fine, whole.nodes, box));
  };
  ASSERT_EQ(here.grid.nodes, whole.nodes);
  expectPart(alone.ofExtinction, here.ofExtinction);
  expectPart(alone.ofLight, here.ofLight);
}

void ExpectSame(
  const ShownNow& alone, const Progressive& progressive, const NodeBox& box, const Grid& whole)
{
  const ShownNow here = Now(progressive);
  const bool isPiece = progressive.ShowsPiece();
  const auto part = [&](const std::vector<float>& field)
  { return isPiece ? Cut(field, whole.nodes, box) : field; };
  EXPECT_EQ(isPiece, box.Size() != whole.nodes && alone.grid.nodes == whole.nodes);
  EXPECT_EQ(here.grid.nodes, isPiece ? box.Size() : alone.grid.nodes);
  EXPECT_EQ(here.base, part(alone.base));
  EXPECT_EQ(here.extinction, part(alone.extinction));
  EXPECT_EQ(here.ofLight, part(alone.ofLight));
  EXPECT_EQ(here.before.visibility, alone.before.visibility);
  EXPECT_EQ(here.after.visibility, alone.after.visibility);
  EXPECT_EQ(here.after.fraction, alone.after.fraction);
  ExpectSame(alone.change, here.change, whole);
}

struct Case
{
  const char* name;
  Mode mode;
  ImportanceSmoothing smoothing;
  double coherence;
};

std::ostream& operator<<(std::ostream& stream, const Case& some)
{
  return stream << some.name;
}

class PreviewsOnRanks : public ::testing::TestWithParam<Case>
{
};
}

TEST_P(PreviewsOnRanks, HaveTheBitsOfOneProcess)
{
  BoxScene made(Int3(35, 31, 38), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09));
  made.FillOnion();
  made.settings.mode = GetParam().mode;
  made.settings.importanceSmoothing = GetParam().smoothing;
  made.settings.temporalCoherence = GetParam().coherence;
  made.settings.maximumIterations = 4;
  const Whole scene(made);
  std::vector<ShownNow> alone;
  GoRound({ scene.grid, scene.extinction.data(), scene.importance.data() }, scene,
    [&](int, const Progressive& progressive) { alone.push_back(Now(progressive)); });
  ASSERT_LT(alone[0].grid.NodeCount(), scene.grid.NodeCount());
  ASSERT_LT(alone[0].grid.NodeCount(), alone[2].grid.NodeCount());
  ASSERT_NE(alone[0].extinction, alone[1].extinction);
  ASSERT_GT(alone[1].after.visibility, alone[1].before.visibility);
  for (const int ranks : { 1, 2, 3, 5 })
  {
    SCOPED_TRACE(ranks);
    // The rank without any piece comes first.
    OnRanks(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks, ranks == 3 ? 1 : 0, ranks / 2),
      [&](const SceneFields& fields, const NodeBox& box)
      {
        GoRound(fields, scene,
          [&](int step, const Progressive& progressive)
          {
            SCOPED_TRACE(step);
            ExpectSame(alone[std::size_t(step)], progressive, box, scene.grid);
          });
      });
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, PreviewsOnRanks,
  ::testing::Values(Case{ "Joint", Mode::Joint, ImportanceSmoothing::Off, 0 },
    Case{ "Separate", Mode::Separate, ImportanceSmoothing::Median, 0 },
    Case{ "Coherent", Mode::Joint, ImportanceSmoothing::Off, 1e-2 },
    Case{ "CoherentSeparate", Mode::Separate, ImportanceSmoothing::Off, 1e-2 }),
  ::testing::PrintToStringParamName());

// What every rank has all of is to be little beside its piece.
TEST(PreviewGrids, OfRanksAreSmallBesideTheirPieces)
{
  BoxScene made(Int3(160, 150, 140), Vec3(0), Vec3(0.01));
  made.FillOnion();
  const Whole scene(made);
  const int ranks = 3;
  OnRanks(ranks, scene, Slabs(scene.grid.nodes, 2, ranks),
    [&](const SceneFields& fields, const NodeBox&)
    {
      Progressive progressive(fields, scene.settings);
      progressive.SetView(scene.camera, scene.light, scene.settings);
      progressive.Preview(1e3); // all the time there is
      EXPECT_FALSE(progressive.ShowsPiece());
      EXPECT_LE(progressive.ShownGrid().NodeCount(), scene.grid.NodeCount() / (4 * ranks));
      EXPECT_GT(progressive.ShownGrid().NodeCount(), scene.grid.NodeCount() / 64);
    });
}

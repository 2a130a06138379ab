// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Targets of structures in real scenes, judged by the independent march.

#include "LoadedScene.h"
#include "Tolerance.h"

#include "CeilingMarch.h"
#include "RayMarch.h"
#include "optimize/Presets.h"
#include "optimize/TargetSearch.h"
#include "viewpoint/MeetTargets.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// What is important in a real scene, cut into three structures.
class Targets : public RealScene
{
protected:
  void SetUp() override
  {
    RealScene::SetUp();
    if (this->IsSkipped())
    {
      return;
    }
    this->Scene = std::make_unique<LoadedScene>(GetParam().name);
    Take(PresetNamed("Default"), this->Scene->settings);
    this->Scene->settings.importanceSmoothing = ImportanceSmoothing::Off;
    const Int3 nodes = this->Scene->grid.nodes;
    for (std::size_t node = 0; node < this->Scene->importance.size(); ++node)
    {
      const int i = static_cast<int>(node) % nodes.x;
      const int k = static_cast<int>(node) / (nodes.x * nodes.y);
      const int part = 2 * i < nodes.x ? 1 : 2 * k < nodes.z ? 2 : 3;
      this->Rows.push_back(
        static_cast<StructureRow>(this->Scene->importance[node] > 0.2f ? part : 0));
    }
  }

  struct Wish
  {
    double importance;
    std::optional<double> target;
  };

  TargetsFound Meet(const std::vector<Wish>& wishes)
  {
    std::vector<Structure> all;
    for (const Wish& wish : wishes)
    {
      all.push_back({ int(all.size()) + 1, "", wish.importance, wish.target });
    }
    const Structures structures(all);
    std::transform(this->Rows.begin(), this->Rows.end(), this->Scene->importance.begin(),
      [&structures](StructureRow row) { return static_cast<float>(structures.ImportanceOf(row)); });
    this->Solved = std::make_unique<Solver>(this->Scene->MakeSolver());
    this->Solved->Run();
    return MeetTargets(
      { this->Scene->Fields(), this->Scene->importance.data(), structures, this->Rows.data() }, {},
      {}, this->Solved);
  }

  /// What the march sees of a structure.
  double VisibleByMarch(StructureRow row) const
  {
    std::vector<float> membership(this->Rows.size());
    std::transform(this->Rows.begin(), this->Rows.end(), membership.begin(),
      [row](StructureRow here) { return here == row ? 1.0f : 0.0f; });
    truth::Sampling sampling;
    sampling.raysPerVoxel = 2;
    const truth::Volume<float> volume{ this->Scene->file.lattice, this->Solved->Extinction().data(),
      membership.data() };
    return truth::SharesOf(
      volume, this->Scene->extinction.data(), this->Scene->file.Eye(), sampling)
      .visible;
  }

  /// The most that the march could see of a structure.
  double CeilingByMarch(StructureRow row) const
  {
    const std::vector<float>& base = this->Scene->extinction;
    std::vector<float> membership(base.size());
    std::vector<float> least(base.size());
    for (std::size_t node = 0; node < base.size(); ++node)
    {
      membership[node] = this->Rows[node] == row ? 1.0f : 0.0f;
      least[node] = static_cast<float>(this->Scene->settings.protectImportance) *
        this->Scene->importance[node] * membership[node] * base[node];
    }
    truth::Sampling sampling;
    sampling.raysPerVoxel = 2;
    const truth::BoundedVolume bounded{ this->Scene->file.lattice, membership.data(), least.data(),
      base.data() };
    const truth::Volume<float> volume{ this->Scene->file.lattice, base.data(), membership.data() };
    return truth::CeilingOf(bounded, this->Scene->file.Eye(), sampling) /
      truth::ImportantExtinction(volume);
  }

  std::unique_ptr<LoadedScene> Scene;
  std::vector<StructureRow> Rows;
  std::unique_ptr<Solver> Solved;
};
}

TEST_P(Targets, AreMetWithinOnePercent)
{
  const std::vector<StructureShares> even = this->Meet({ { 1, {} }, { 1, {} }, { 1, {} } }).shares;
  const auto most = [&even](std::size_t i, double part) { return part * even[i].attainable; };
  const std::vector<std::vector<Wish>> contracts{
    { { 0.1, most(0, 0.92) }, { 1, {} }, { 1, {} } },
    { { 0, most(0, 0.5) }, { 0.3, most(1, 0.8) }, { 1, {} } },
    { { 1, most(0, 0.8) }, { 1, most(1, 0.8) }, { 0.2, most(2, 0.8) } },
    { { 1, {} }, { 0.05, most(1, 0.85) }, { 0.05, most(2, 0.7) } },
  };
  for (const std::vector<Wish>& contract : contracts)
  {
    const TargetsFound found = this->Meet(contract);
    SCOPED_TRACE(found.text);
    EXPECT_EQ(found.warning.find("Less is visible"), std::string::npos) << found.warning;
    EXPECT_LE(found.runs, TargetSearch::mostRuns);
    for (std::size_t i = 0; i < contract.size(); ++i)
    {
      const auto row = static_cast<StructureRow>(i + 1);
      if (contract[i].target)
      {
        EXPECT_GE(this->VisibleByMarch(row), *contract[i].target - 0.01);
      }
    }
  }
}

TEST_P(Targets, AreRefusedAboveTheCeilingOfTheMarch)
{
  const double most = this->Meet({ { 1, {} }, { 1, {} }, { 1, {} } }).shares[0].attainable;
  const TargetsFound found = this->Meet({ { 1, most + 0.01 }, { 0.2, 0.1 }, { 1, {} } });
  EXPECT_EQ(StateOf(found.structures.At(1), found.shares[0]), TargetState::Refused);
  EXPECT_EQ(StateOf(found.structures.At(2), found.shares[1]), TargetState::Met);
  EXPECT_NE(found.warning.find("The target of \"1\""), std::string::npos) << found.warning;
  EXPECT_EQ(found.warning.find("The target of \"2\""), std::string::npos) << found.warning;
  EXPECT_WITHIN(
    found.shares[0].attainable, this->CeilingByMarch(1), Relative(0.003, 1, "as the ledger"));
}

// All of them can be met alone. They are missed by as much.
TEST_P(Targets, AreMissedTogether)
{
  const std::vector<StructureShares> even = this->Meet({ { 1, {} }, { 1, {} }, { 1, {} } }).shares;
  const auto target = [&even](std::size_t i) { return 0.995 * even[i].attainable; };
  const TargetsFound found = this->Meet({ { 1, target(0) }, { 1, target(1) }, { 1, target(2) } });
  EXPECT_NE(found.warning.find("Less is visible of"), std::string::npos) << found.warning;
  EXPECT_LE(found.runs, TargetSearch::mostRuns);
}

INSTANTIATE_TEST_SUITE_P(Quick, Targets, ::testing::Values(Bars{ "carotid_mra", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });

INSTANTIATE_TEST_SUITE_P(Long, Targets,
  ::testing::Values(Bars{ "skull_phantom", 0, 0 }, Bars{ "engine", 0, 0 },
    Bars{ "thorax_ct", 0, 0 }, Bars{ "visible_male", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What all devices do, whatever runs on them.

#include "BoxScene.h"
#include "TestedDevice.h"

#include "backend/SumOnDevice.h"
#include "math/Number.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace limpid;

namespace
{
std::vector<float> Counted(std::size_t count)
{
  std::vector<float> values(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    values[n] = static_cast<float>(n);
  }
  return values;
}

/// The share of every number in every other one.
struct ShareOfPair
{
  const float* numbers;
  Index count;
  float* out;

  LIMPID_HD void operator()(Index pair) const
  {
    this->out[pair] =
      FractionOf(this->numbers[pair % this->count], this->numbers[pair / this->count]);
  }
};

/// The best extinction after some iterations, and their energies.
std::vector<float> Optimized(
  SolverBackend& backend, const Problem& problem, std::vector<double>& energies)
{
  const float* base = problem.baseExtinction;
  const auto run = backend.MakeMinimizer(
    problem, std::vector<float>(base, base + problem.grid.NodeCount()), false);
  energies.push_back(run->Start().energy.Total());
  for (int iteration = 0; iteration < 4; ++iteration)
  {
    energies.push_back(run->Iterate().energy.Total());
  }
  return run->TakeBest();
}
}

TEST(Device, FreesWhatItAllocates)
{
  const auto device = MakeTestedDevice();
  {
    DeviceArray<TestedDevice, float> one(device, 100, "a test");
    DeviceArray<TestedDevice, float> other = std::move(one);
    one = DeviceArray<TestedDevice, float>(device, 50, "a test");
    EXPECT_EQ(other.Size(), 100u);
  }
  EXPECT_EQ(device->PeakBytes(), 600u);
  EXPECT_EQ(device->Bytes(), 0u);
}

TEST(Device, KeepsWhatItIsGiven)
{
  const auto device = MakeTestedDevice();
  const std::vector<float> values = Counted(100003);
  const DeviceArray<TestedDevice, float> there(device, values, "a test");
  DeviceArray<TestedDevice, float> copy(device, values.size(), "a test");
  std::vector<float> back(values.size());

  copy.CopyFrom(there);
  copy.Download(back.data());
  EXPECT_EQ(back, values);

  copy.SetZero();
  copy.Download(back.data());
  EXPECT_EQ(back, std::vector<float>(values.size(), 0.0f));
}

TEST(Device, HasReadWhatItIsGiven)
{
  const auto device = MakeTestedDevice();
  const std::vector<float> values = Counted(10000019);
  std::vector<float> given = values;
  const DeviceArray<TestedDevice, float> there(device, given, "a test");
  std::fill(given.begin(), given.end(), 0.0f); // at once, while a copy could be under way
  std::vector<float> back(values.size());

  there.Download(back.data());

  EXPECT_EQ(back, values);
}

// Numbers below 2^-128 have no reciprocal.
TEST(Device, FindsSharesOfAnyNumbers)
{
  const auto device = MakeTestedDevice();
  const std::vector<float> wholes{ 0.0f, 1e-45f, 1e-40f, 2e-38f, 1.0f, 3e38f };
  const DeviceArray<TestedDevice, float> there(device, wholes, "a test");
  const auto count = static_cast<Index>(wholes.size());
  DeviceArray<TestedDevice, float> shares(device, wholes.size() * wholes.size(), "a test");
  std::vector<float> found(shares.Size());

  device->ForIndices("shares", count * count, ShareOfPair{ there.Data(), count, shares.Data() });
  shares.Download(found.data());

  for (Index n = 0; n < count * count; ++n)
  {
    const float part = wholes[static_cast<std::size_t>(n % count)];
    const float whole = wholes[static_cast<std::size_t>(n / count)];
    const float share = found[static_cast<std::size_t>(n)];
    EXPECT_GE(share, 0.0f) << part << " of " << whole;
    EXPECT_LE(share, 1.0f) << part << " of " << whole;
    EXPECT_TRUE(part > 0 || whole == 0 || share == 0.0f) << share << " of " << whole;
    EXPECT_TRUE(part < whole || share == 1.0f) << part << " of " << whole;
  }
}

TEST(Device, CopiesBorrowedValuesOnlyIfItCannotReadThem)
{
  const auto device = MakeTestedDevice();
  const std::vector<float> values = Counted(100);
  const std::vector<float> others(60, 3.0f);
  BorrowedArray<TestedDevice, float> borrowed(device, values.data(), values.size(), "a test");
  borrowed.Borrow(device, others.data(), others.size(), "a test");
  std::vector<float> back(others.size());

  device->Download(back.data(), borrowed.Data(), back.size() * sizeof(float));

  EXPECT_EQ(back, others);
  EXPECT_EQ(borrowed.Size(), others.size());
  EXPECT_NE(borrowed.Data() == others.data(), borrowed.isCopy);
  EXPECT_EQ(device->PeakBytes(), borrowed.isCopy ? 400u : 0u);
}

TEST(Device, TakesValuesWithoutASecondCopy)
{
  const auto device = MakeTestedDevice();
  std::vector<float> values = Counted(100);
  const float* given = values.data();
  BorrowedArray<TestedDevice, float> taken;
  std::vector<float> back(values.size());

  taken.Take(device, std::move(values), "a test");
  device->Download(back.data(), taken.Data(), back.size() * sizeof(float));

  EXPECT_EQ(back, Counted(100));
  EXPECT_NE(taken.Data() == given, taken.isCopy);
}

TEST(Device, WritesResultsToTheCaller)
{
  const auto device = MakeTestedDevice();
  std::vector<float> given = Counted(100);
  std::vector<float> overwritten(60);
  ResultArray<TestedDevice, float> changed(device, given.data(), given.size(), "a test");
  ResultArray<TestedDevice, float> filled(device, overwritten.data(), overwritten.size(), "a test");
  std::vector<float> expected = Counted(100);
  std::fill_n(expected.begin(), 60, 0.0f);

  changed.Upload();
  device->SetZero(filled.Data(), overwritten.size() * sizeof(float));
  device->Copy(changed.Data(), filled.Data(), overwritten.size() * sizeof(float));
  changed.Download();
  filled.Download();

  EXPECT_EQ(given, expected);
  EXPECT_EQ(overwritten, std::vector<float>(60, 0.0f));
  EXPECT_EQ(device->PeakBytes(), TestedDevice::readsHostMemory ? 0u : 640u);
}

TEST(Device, TimesWhatItIsToldTo)
{
  const auto device = MakeTestedDevice();
  const std::vector<float> values = Counted(1000);
  DeviceArray<TestedDevice, float> there(device, values, "a test");
  LaunchTimes times;

  device->Time(&times);
  there.SetZero();
  there.SetZero();
  there.Upload(values.data());
  device->Time(nullptr);
  there.SetZero();
  device->Wait();

  ASSERT_EQ(times.Entries().size(), 2u);
  EXPECT_EQ(times.Entries()[0].count, 2);
  EXPECT_EQ(times.Entries()[1].label, "upload");
  EXPECT_EQ(times.Entries()[1].count, 1);
  for (const LaunchTimes::Entry& entry : times.Entries())
  {
    EXPECT_GE(entry.seconds, 0) << entry.label;
    EXPECT_LT(entry.seconds, 60) << entry.label;
  }
}

class RunsOfDevice : public ::testing::TestWithParam<SolverKind>
{
protected:
  void SetUp() override
  {
    this->Scene.FillOnion();
    this->Scene.settings.solver = GetParam();
    this->Scene.settings.iterationsPerLevel = { { 1, 1, 2 } };
  }

  BoxScene Scene{ { 37, 30, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 } };
};

TEST_P(RunsOfDevice, GivesTheSameBitsTwice)
{
  PreparedScene prepared(this->Scene.Fields());
  const Problem problem =
    prepared.ProblemFor(this->Scene.camera, this->Scene.light, this->Scene.settings);
  const std::shared_ptr<SolverBackend> backend = MakeSolverBackend(MakeTestedDevice());
  std::vector<double> energies;
  const std::vector<float> once = Optimized(*backend, problem, energies);

  for (int run = 0; run < 5; ++run)
  {
    std::vector<double> others;
    EXPECT_EQ(Optimized(*backend, problem, others), once);
    EXPECT_EQ(others, energies);
  }
}

TEST_P(RunsOfDevice, LeavesNothingBehind)
{
  const auto device = MakeTestedDevice();
  {
    PreparedScene prepared(this->Scene.Fields());
    const Problem problem =
      prepared.ProblemFor(this->Scene.camera, this->Scene.light, this->Scene.settings);
    std::vector<double> energies;
    Optimized(*MakeSolverBackend(device), problem, energies);
    EXPECT_GT(device->Bytes(), 0u) << "the fields stay as long as the scene";
  }
  EXPECT_EQ(device->Bytes(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Solvers, RunsOfDevice,
  ::testing::Values(SolverKind::Policy, SolverKind::Adam),
  [](const ::testing::TestParamInfo<SolverKind>& solver)
  { return std::string(solver.param == SolverKind::Policy ? "Policy" : "Adam"); });

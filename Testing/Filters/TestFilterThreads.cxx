// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Filters in two threads at the same time: the bits of one after the other.

#include "PhantomFilters.h"

#include <gtest/gtest.h>

#include <functional>
#include <thread>

using namespace limpid;

namespace
{
using Outcome = std::vector<double>;
using FilterRun = std::function<Outcome()>;

template <class Filter>
Outcome RunOf(const Filter& filter)
{
  filter->Update();
  return OutcomeOf(filter);
}

void ExpectSameBits(const FilterRun& first, const FilterRun& second)
{
  const Outcome firstAlone = first();
  const Outcome secondAlone = second();
  for (int round = 0; round < 10; ++round)
  {
    Outcome firstBeside;
    Outcome secondBeside;
    std::thread beside([&] { secondBeside = second(); });
    firstBeside = first();
    beside.join();
    ASSERT_EQ(firstBeside, firstAlone);
    ASSERT_EQ(secondBeside, secondAlone);
  }
}
}

TEST(FilterThreads, TwoOptimizersOfDifferentImages)
{
  const auto one = Phantom(24, 0);
  const auto other = Phantom(20, 2);
  ExpectSameBits([&] { return RunOf(Optimizer(one)); }, [&] { return RunOf(Optimizer(other)); });
}

TEST(FilterThreads, TwoOptimizersOfOneImage)
{
  const auto image = Phantom(24, 0);
  const FilterRun run = [&] { return RunOf(Optimizer(image)); };
  ExpectSameBits(run, run);
}

TEST(FilterThreads, OptimizerAndSearchOfOneImage)
{
  const auto image = Phantom(20, 0);
  ExpectSameBits([&] { return RunOf(Optimizer(image)); }, [&] { return RunOf(Search(image)); });
}

TEST(FilterThreads, TwoPhantoms)
{
  const auto run = [](int scene)
  {
    vtkNew<vtkOcclusionPhantom> source;
    source->SetResolution(40);
    source->SetScene(scene);
    source->Update();
    return OutcomeOf(source);
  };
  ExpectSameBits([&] { return run(0); }, [&] { return run(1); });
}

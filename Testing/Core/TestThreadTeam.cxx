// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Loops shared by threads that stay awake: each index once, whatever the threads do.

#include "backend/ThreadTeam.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace limpid;

namespace
{
/// Long enough for other threads to come.
void Dawdle()
{
  volatile int steps = 0;
  while (steps < 300)
  {
    steps = steps + 1;
  }
}

/// How often a loop came to each index.
std::vector<int> VisitsOf(Index count, Index grain)
{
  std::vector<int> visits(static_cast<std::size_t>(count));
  ParallelFor(count, grain,
    [&](Index i)
    {
      Dawdle();
      ++visits[std::size_t(i)];
    });
  return visits;
}
}

TEST(ThreadTeam, VisitsEveryIndexOnce)
{
  for (const int threads : { 1, 2, 3, 5, 8 })
  {
    const ThreadLimit limit(threads);
    const ThreadTeam team;
    for (const Index count : { 1, 2, 3, 7, 64, 1000, 4711 })
    {
      for (const Index grain : { 1, 2, 8, 100 })
      {
        const std::vector<int> visits = VisitsOf(count, grain);
        EXPECT_EQ(visits, std::vector<int>(visits.size(), 1)) << threads << " threads, " << count;
      }
    }
  }
}

TEST(ThreadTeam, LoopsFollowEachOther)
{
  const ThreadLimit limit(4);
  const ThreadTeam team;
  std::vector<int> values(97);
  constexpr int loops = 2000;
  for (int loop = 0; loop < loops; ++loop)
  {
    // Reads what another thread may have written in the loop before.
    ParallelFor(Index(values.size()), 3,
      [&](Index i)
      {
        Dawdle();
        values[std::size_t(i)] = loop % 2 == 0 ? values[std::size_t(i)] + 1 : loop + 1;
      });
    ASSERT_EQ(std::accumulate(values.begin(), values.end(), 0),
      (loop + 1) * static_cast<int>(values.size()));
  }
}

TEST(ThreadTeam, ThrowsWhatABodyThrows)
{
  const ThreadLimit limit(3);
  const ThreadTeam team;
  const auto failing = [](Index i)
  {
    if (i == 77)
    {
      throw std::runtime_error("77");
    }
  };
  EXPECT_THROW(ParallelFor(100, failing), std::runtime_error);
  EXPECT_EQ(VisitsOf(50, 1), std::vector<int>(50, 1)) << "the team goes on";
}

TEST(ThreadTeam, LoopsInsideLoops)
{
  const ThreadLimit limit(4);
  const ThreadTeam team;
  std::atomic<int> sum{ 0 };
  ParallelFor(40,
    [&](Index)
    {
      const ThreadTeam inner; // is none
      ParallelFor(30,
        [&](Index)
        {
          Dawdle();
          ++sum;
        });
    });
  EXPECT_EQ(sum, 1200);
}

TEST(ThreadTeam, TeamsInsideLoopsAndBesideEachOther)
{
  const ThreadLimit limit(4);
  std::atomic<int> sum{ 0 };
  const auto teamwork = [&](Index)
  {
    const ThreadTeam team;
    for (int loop = 0; loop < 50; ++loop)
    {
      ParallelFor(20,
        [&](Index)
        {
          Dawdle();
          ++sum;
        });
    }
  };
  ParallelFor(8, teamwork);
  std::thread beside([&] { teamwork(0); });
  teamwork(1);
  beside.join();
  EXPECT_EQ(sum, 10 * 50 * 20);
}

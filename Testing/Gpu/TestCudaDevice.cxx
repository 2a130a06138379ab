// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What only a GPU can show: which one it is, that work for it runs on it, and what happens when its
// memory is full.

#include "BoxScene.h"
#include "TestedDevice.h"

#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace limpid;

namespace
{
using Bytes = DeviceArray<TestedDevice, unsigned char>;

/// Writes 2 index + 1.
struct OddNumber
{
  int* out;
  LIMPID_HD void operator()(Index index) const
  {
    this->out[index] = static_cast<int>(2 * index + 1);
  }
};

void ExpectItCounts(const std::shared_ptr<TestedDevice>& device)
{
  constexpr int count = 100003;
  DeviceArray<TestedDevice, int> numbers(device, count, "a test");
  device->ForIndices("odd numbers", count, OddNumber{ numbers.Data() });
  std::vector<int> found(count);
  numbers.Download(found.data());
  for (int n = 0; n < count; ++n)
  {
    ASSERT_EQ(found[std::size_t(n)], 2 * n + 1);
  }
}

/// A scene to optimise.
struct Onion
{
  BoxScene scene;
  PreparedScene prepared;
  Problem problem;

  explicit Onion(int nodes)
    : scene(Filled(nodes))
    , prepared(this->scene.Fields())
    , problem(
        this->prepared.ProblemFor(this->scene.camera, this->scene.light, this->scene.settings))
  {
  }

private:
  static BoxScene Filled(int nodes)
  {
    BoxScene scene = BoxScene::Cube(nodes);
    scene.FillOnion();
    return scene;
  }
};

std::string MessageOf(const std::shared_ptr<TestedDevice>& device, std::size_t bytes)
{
  try
  {
    const Bytes tooMuch(device, bytes, "a test");
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

/// All that can be had, in pieces down to a megabyte.
std::vector<Bytes> TakeAll(const std::shared_ptr<TestedDevice>& device)
{
  constexpr std::size_t least = 1 << 20;
  std::vector<Bytes> pieces;
  for (std::size_t piece = FreeCudaBytes(); piece >= least;)
  {
    try
    {
      pieces.emplace_back(device, piece, "a test");
    }
    catch (const Error&)
    {
      piece /= 2;
    }
  }
  return pieces;
}
}

TEST(CudaDevice, HasTheNameThatFindCudaGives)
{
  EXPECT_FALSE(FindCuda().name.empty());
  EXPECT_TRUE(FindCuda().reason.empty()) << FindCuda().reason;
  EXPECT_GT(FreeCudaBytes(), 0u);
  EXPECT_EQ(MakeTestedDevice()->Name(), "CUDA, " + FindCuda().name);
}

TEST(CudaDevice, RunsWhatItIsGiven)
{
  ExpectItCounts(MakeTestedDevice());
}

// Copies go through rooms of 4 MiB in turn: less than one, one, several and a part.
TEST(CudaDevice, CopiesAnyNumberOfBytes)
{
  const auto device = MakeTestedDevice();
  for (const std::size_t bytes : { 0, 1, 4 << 20, (4 << 20) + 1, (8 << 20) - 1, 25'000'003 })
  {
    std::vector<unsigned char> given(bytes);
    for (std::size_t n = 0; n < bytes; ++n)
    {
      given[n] = static_cast<unsigned char>((n * 2654435761u) >> 13);
    }
    const std::vector<unsigned char> kept = given;
    const Bytes there(device, given, "a test");
    given.assign(bytes, 0); // has been read
    std::vector<unsigned char> back(bytes, 1);
    there.Download(back.data());
    EXPECT_EQ(back, kept) << bytes;
  }
}

TEST(CudaDevice, WorksForSeveralThreads)
{
  const auto device = MakeTestedDevice();
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n)
  {
    threads.emplace_back([&] { ExpectItCounts(device); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(device->Bytes(), 0u);
}

TEST(CudaDevice, WorksBesideAnother)
{
  const auto one = MakeTestedDevice();
  const auto other = MakeTestedDevice();
  const DeviceArray<TestedDevice, float> kept(one, std::vector<float>(1000, 3.0f), "a test");

  ExpectItCounts(one);
  ExpectItCounts(other);

  std::vector<float> back(1000);
  kept.Download(back.data());
  EXPECT_EQ(back, std::vector<float>(1000, 3.0f));
}

TEST(CudaDevice, SaysWhatDoesNotFit)
{
  const auto device = MakeTestedDevice();
  const std::size_t tooMuch = std::size_t(1) << 42;

  const std::string message = MessageOf(device, tooMuch);

  EXPECT_NE(message.find(std::to_string(tooMuch / 1000000) + " MB"), std::string::npos) << message;
  EXPECT_NE(message.find("a test"), std::string::npos) << message;
  EXPECT_NE(message.find("MB are free"), std::string::npos) << message;
  EXPECT_EQ(device->Bytes(), 0u);
  ExpectItCounts(device);
}

TEST(CudaDevice, SurvivesAnOptimizationThatDoesNotFit)
{
  const Onion onion(96);
  const auto device = MakeTestedDevice();
  const std::unique_ptr<SolverBackend> backend = MakeSolverBackend(device);
  const auto begin = [&]
  {
    return backend->MakeMinimizer(onion.problem, std::vector<float>(onion.scene.extinction), false);
  };
  {
    const std::vector<Bytes> all = TakeAll(device);
    const std::size_t taken = device->Bytes();
    EXPECT_THROW(begin(), Error);
    EXPECT_EQ(device->Bytes(), taken) << "half an optimisation is left";
  }
  EXPECT_EQ(device->Bytes(), 0u);
  EXPECT_LT(begin()->Start().energy.Total(), 0) << "there is room again";
}

TEST(CudaDevice, GivesTheSameBitsEachTime)
{
  const Onion onion(48);
  const auto device = MakeTestedDevice();
  const std::unique_ptr<SolverBackend> backend = MakeSolverBackend(device);
  const auto run = [&]
  {
    const std::unique_ptr<Minimizer> minimizer = backend->MakeMinimizer(onion.problem, {}, false);
    minimizer->Start();
    for (int n = 0; n < 5; ++n)
    {
      minimizer->Iterate();
    }
    return minimizer->TakeBest();
  };
  const std::vector<float> first = run();
  for (int n = 1; n < 50; ++n)
  {
    ASSERT_EQ(run(), first) << "run " << n << ": threads do not wait for each other";
  }
}

// The device of a process stays until its end.
TEST(CudaDevice, GivesMemoryBackWhenNothingIsHeld)
{
  constexpr std::size_t much = std::size_t(1) << 28;
  const auto device = MakeTestedDevice();
  cudaMemPool_t pool{};
  ASSERT_EQ(cudaDeviceGetDefaultMemPool(&pool, FindCuda().device), cudaSuccess);
  const auto reserved = [&]
  {
    std::uint64_t bytes = 0;
    cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent, &bytes);
    return bytes;
  };
  {
    const Bytes some(device, 1, "a test");
    Bytes(device, much, "a test");
    EXPECT_GE(reserved(), much) << "it is kept for what comes next";
  }
  EXPECT_EQ(reserved(), 0u);
}

TEST(CudaDevice, GivesItsMemoryBack)
{
  constexpr std::size_t much = std::size_t(1) << 28;
  ExpectItCounts(MakeTestedDevice()); // whatever CUDA itself needs
  const std::size_t before = FreeCudaBytes();
  for (int n = 0; n < 3; ++n)
  {
    const Bytes used(MakeTestedDevice(), much, "a test");
  }
  EXPECT_NEAR(double(FreeCudaBytes()), double(before), double(much) / 4);
}

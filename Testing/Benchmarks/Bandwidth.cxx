// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Bandwidth.h"

#include "Timing.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>
#include <cstring>

namespace limpid::benchmark
{
namespace
{
constexpr std::size_t memorySize = std::size_t(384)
  << 20; // several times the largest cache [bytes]
const char* const inMemory = "memory";

/// In so many sums that no addition waits for the one before.
LIMPID_MULTIVERSION
float SumOf(const float* __restrict values, std::size_t count)
{
  constexpr std::size_t lanes = 128;
  float sums[lanes] = {};
  for (std::size_t i = 0; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      sums[lane] += values[i + lane];
    }
  }
  float total = 0;
  for (const float sum : sums)
  {
    total += sum;
  }
  return total;
}

/// `factor` is 1, but the compiler must not know: it would call the library.
LIMPID_MULTIVERSION
void CopyTo(float* __restrict out, const float* __restrict in, float factor, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    out[i] = factor * in[i];
  }
}

LIMPID_MULTIVERSION
void TriadTo(float* __restrict out, const float* __restrict first, const float* __restrict second,
  float factor, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    out[i] = first[i] + factor * second[i];
  }
}

int ArraysOf(Stream kind)
{
  switch (kind)
  {
    case Stream::Read:
      return 1;
    case Stream::Triad:
      return 3;
    default:
      return 2;
  }
}

/// The arrays of one thread.
class Lane
{
public:
  Lane(Stream kind, std::size_t bytes)
    : Kind(kind)
    , Count(bytes / sizeof(float) / std::size_t(ArraysOf(kind)))
    , Values(this->Count * std::size_t(ArraysOf(kind)), 1.0f)
  {
  }

  void Pass()
  {
    float* first = this->Values.data();
    float* second = first + this->Count;
    const float factor = this->Factor;
    switch (this->Kind)
    {
      case Stream::Read:
        this->Factor = SumOf(first, this->Count) > 0 ? factor : -factor; // lest it be left out
        break;
      case Stream::Copy:
        CopyTo(first, second, factor, this->Count);
        break;
      case Stream::Triad:
        TriadTo(first, second, second + this->Count, factor, this->Count);
        break;
      case Stream::Memcpy:
        std::memcpy(first, second, this->Count * sizeof(float));
        break;
    }
  }

  std::size_t Bytes() const { return this->Values.size() * sizeof(float); }

private:
  Stream Kind;
  std::size_t Count; ///< of floats in one array
  std::vector<float> Values;
  volatile float Factor = 1;
};

struct Place
{
  std::string name;
  std::size_t bytes; ///< of the arrays of one thread
};

/// Fastest of several.
StreamRate MeasureStream(Stream kind, const Place& place, int threads, bool quick)
{
  const ThreadLimit limit(threads);
  std::vector<Lane> lanes(std::size_t(threads), Lane(kind, place.bytes));
  StreamRate result{ kind, place.name, threads, 0, 0, 0 };
  for (const Lane& lane : lanes)
  {
    result.arrays += lane.Bytes();
  }
  const double bytesPerRound = quick ? 4e6 : 6e8; // enough for all threads to be at it together
  const auto passes = static_cast<int>(1 + bytesPerRound / double(place.bytes));
  const int rounds = quick ? 1 : 7;
  for (int round = 0; round <= rounds; ++round)
  {
    Stopwatch watch;
    ParallelFor(threads,
      [&](Index thread)
      {
        for (int pass = 0; pass < passes; ++pass)
        {
          lanes[std::size_t(thread)].Pass();
        }
      });
    const double seconds = watch.Lap() / passes;
    const bool warm = round > 0;
    result.seconds =
      warm && result.seconds > 0 ? std::min(result.seconds, seconds) : (warm ? seconds : 0);
  }
  result.rate = double(result.arrays) / result.seconds;
  return result;
}
}

std::string NameOf(Stream kind)
{
  switch (kind)
  {
    case Stream::Read:
      return "read";
    case Stream::Copy:
      return "copy";
    case Stream::Triad:
      return "triad";
    default:
      return "memcpy";
  }
}

std::vector<StreamRate> MeasureBandwidth(int allThreads, bool quick)
{
  std::vector<StreamRate> rates;
  for (int threads = 1; threads <= allThreads; threads *= 2)
  {
    const auto share = std::size_t(threads);
    const Place places[] = { { "L1", std::size_t(24) << 10 }, { "L2", std::size_t(512) << 10 },
      { "L3", (std::size_t(12) << 20) / share },
      { inMemory, (quick ? std::size_t(1) << 20 : memorySize) / share } };
    for (const Place& place : places)
    {
      for (const Stream kind : { Stream::Read, Stream::Copy, Stream::Triad, Stream::Memcpy })
      {
        rates.push_back(MeasureStream(kind, place, threads, quick));
      }
    }
  }
  return rates;
}

double MemoryRate(const std::vector<StreamRate>& rates, Stream kind, int threads)
{
  for (const StreamRate& rate : rates)
  {
    if (rate.kind == kind && rate.place == inMemory && rate.threads == threads)
    {
      return rate.rate;
    }
  }
  return 0;
}
}

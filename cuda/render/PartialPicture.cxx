// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/PartialPicture.h"

#include "backend/Backend.h"
#include "math/Range.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// The pixels that a rank puts together.
Range<Index> PixelsOf(const Communicator& ranks, int rank, Index count)
{
  return { count * rank / ranks.Size(), count * (rank + 1) / ranks.Size() };
}

/// Values of all ranks for some pixels, rank after rank.
template <class Value>
using OfRanks = std::vector<std::vector<Value>>;

/// From each rank what it has for each other.
template <class Value>
OfRanks<Value> Exchanged(const Communicator& ranks, OfRanks<Value>& sent, OfRanks<Value>&& room)
{
  std::vector<Communicator::Message> out;
  std::vector<Communicator::Message> in;
  const auto add =
    [](std::vector<Communicator::Message>& messages, int rank, std::vector<Value>& values)
  {
    if (!values.empty())
    {
      messages.push_back({ rank, values.data(), values.size() * sizeof(Value) });
    }
  };
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    const auto other = std::size_t(rank);
    if (rank == ranks.Rank())
    {
      room[other] = std::move(sent[other]);
      continue;
    }
    add(out, rank, sent[other]);
    add(in, rank, room[other]);
  }
  ranks.Exchange(out, in);
  return std::move(room);
}

/// Puts one pixel together. Returns the rank of the foremost part; -1: there is none.
int ComposeOne(const OfRanks<PartialPixel>& parts, std::size_t pixel, float opaqueBelow,
  std::vector<std::size_t>& order, Rgba& shown)
{
  order.clear();
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    if (parts[rank][pixel].transmittance < 1)
    {
      order.push_back(rank);
    }
  }
  if (order.empty())
  {
    return -1;
  }
  std::sort(order.begin(), order.end(),
    [&](std::size_t one, std::size_t other)
    { return parts[one][pixel].first < parts[other][pixel].first; });
  Pixel<FourFloats> received;
  for (const std::size_t rank : order)
  {
    const PartialPixel& part = parts[rank][pixel];
    if (received.transmittance > opaqueBelow)
    {
      const FourFloats light{ 0, part.light[0], part.light[1], part.light[2] };
      received.light = received.light + received.transmittance * light;
      received.transmittance *= part.transmittance;
    }
  }
  constexpr float uncolored[3] = { 1, 1, 1 };
  shown = received.Shown(uncolored);
  return static_cast<int>(order.front());
}
}

void Compose(const Communicator& ranks, const std::vector<PartialPixel>& parts, double opaqueBelow,
  std::vector<Rgba>& picture)
{
  const auto count = static_cast<Index>(parts.size());
  const auto size = static_cast<std::size_t>(ranks.Size());
  const Range<Index> own = PixelsOf(ranks, ranks.Rank(), count);
  OfRanks<PartialPixel> sent(size);
  OfRanks<PartialPixel> room(size);
  OfRanks<Rgba> composed(size);
  OfRanks<Rgba> shown(size);
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    const auto other = std::size_t(rank);
    const Range<Index> pixels = PixelsOf(ranks, rank, count);
    sent[other].assign(parts.begin() + pixels.begin, parts.begin() + pixels.end);
    room[other].resize(std::size_t(own.Length()));
    composed[other].assign(std::size_t(own.Length()), Rgba{});
    shown[other].resize(std::size_t(pixels.Length()));
  }
  const OfRanks<PartialPixel> there = Exchanged(ranks, sent, std::move(room));
  constexpr Index pixelsPerTask = 4096;
  const Index tasks = (own.Length() + pixelsPerTask - 1) / pixelsPerTask;
  ParallelFor(tasks,
    [&](Index task)
    {
      std::vector<std::size_t> order;
      const Index end = std::min((task + 1) * pixelsPerTask, own.Length());
      for (Index pixel = task * pixelsPerTask; pixel < end; ++pixel)
      {
        Rgba together{};
        const int foremost =
          ComposeOne(there, std::size_t(pixel), static_cast<float>(opaqueBelow), order, together);
        if (foremost >= 0)
        {
          composed[std::size_t(foremost)][std::size_t(pixel)] = together;
        }
      }
    });
  shown = Exchanged(ranks, composed, std::move(shown));
  picture.clear();
  picture.reserve(parts.size());
  for (const std::vector<Rgba>& some : shown)
  {
    picture.insert(picture.end(), some.begin(), some.end());
  }
}
}

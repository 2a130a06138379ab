// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/PartialPicture.h"

#include "backend/Backend.h"
#include "math/Range.h"
#include "render/Segment.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace limpid
{
namespace
{
/// Returns the range of pixels that a rank composes.
Range<Index> PixelsOf(const Communicator& ranks, int rank, Index count)
{
  return { count * rank / ranks.Size(), count * (rank + 1) / ranks.Size() };
}

/// Values of all ranks for a range of pixels, rank by rank.
template <class Value>
using OfRanks = std::vector<std::vector<Value>>;

/// Exchanges values: each rank sends a range to each other rank.
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

struct ComposedPixel
{
  Rgba color;
  std::int32_t foremost; ///< see Picture
};

ComposedPixel ComposeOne(const OfRanks<PartialPixel>& parts, std::size_t pixel, float opaqueBelow,
  std::vector<std::size_t>& order)
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
    return { {}, -1 };
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
  return { received.Shown(), static_cast<std::int32_t>(order.front()) };
}
}

void Compose(const DrawnPart& drawn, const std::vector<PartialPixel>& parts, double opaqueBelow,
  Picture& picture)
{
  const Communicator& ranks = *drawn.Piece()->ranks;
  const auto count = static_cast<Index>(parts.size());
  const auto size = static_cast<std::size_t>(ranks.Size());
  const Range<Index> own = PixelsOf(ranks, ranks.Rank(), count);
  OfRanks<PartialPixel> sent(size);
  OfRanks<PartialPixel> room(size);
  OfRanks<ComposedPixel> shown(size);
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    const auto other = std::size_t(rank);
    const Range<Index> pixels = PixelsOf(ranks, rank, count);
    sent[other].assign(parts.begin() + pixels.begin, parts.begin() + pixels.end);
    room[other].resize(std::size_t(own.Length()));
    shown[other].resize(std::size_t(pixels.Length()));
  }
  const OfRanks<PartialPixel> there = Exchanged(ranks, sent, std::move(room));
  std::vector<ComposedPixel> composed(std::size_t(own.Length()));
  constexpr Index pixelsPerTask = 4096;
  const Index tasks = (own.Length() + pixelsPerTask - 1) / pixelsPerTask;
  ParallelFor(tasks,
    [&](Index task)
    {
      std::vector<std::size_t> order;
      const Index end = std::min((task + 1) * pixelsPerTask, own.Length());
      for (Index pixel = task * pixelsPerTask; pixel < end; ++pixel)
      {
        composed[std::size_t(pixel)] =
          ComposeOne(there, std::size_t(pixel), static_cast<float>(opaqueBelow), order);
      }
    });
  OfRanks<ComposedPixel> forAll(size, composed);
  shown = Exchanged(ranks, forAll, std::move(shown));
  std::uint8_t* color = picture.rgba.data();
  std::int32_t* foremost = picture.foremost.data();
  for (const std::vector<ComposedPixel>& some : shown)
  {
    for (const ComposedPixel& pixel : some)
    {
      std::memcpy(color, &pixel.color, sizeof(Rgba));
      color += sizeof(Rgba);
      *foremost++ = pixel.foremost;
    }
  }
}
}

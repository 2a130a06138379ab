// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/PartialPicture.h"

#include "backend/Backend.h"
#include "distributed/PackedExchange.h"
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

/// Returns the sizes of messages with values, one for each other rank.
template <class Value, class CountFor>
std::vector<std::size_t> BytesOf(const Communicator& ranks, const CountFor& countFor)
{
  std::vector<std::size_t> bytes(std::size_t(ranks.Size()), 0);
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    const bool isOther = rank != ranks.Rank();
    bytes[std::size_t(rank)] = isOther ? std::size_t(countFor(rank)) * sizeof(Value) : 0;
  }
  return bytes;
}

/// The values of a range of pixels, rank by rank.
using PartsOfRanks = std::vector<const PartialPixel*>;

struct ComposedPixel
{
  Rgba color;
  std::int32_t foremost; ///< see Picture
};

ComposedPixel ComposeOne(
  const PartsOfRanks& parts, std::size_t pixel, float opaqueBelow, std::vector<std::size_t>& order)
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
  const auto pixelsOf = [&](int rank) { return PixelsOf(ranks, rank, Index(parts.size())); };
  const Range<Index> own = pixelsOf(ranks.Rank());
  const auto countOf = [&](int rank) { return pixelsOf(rank).Length(); };
  const auto ownCount = [&](int) { return own.Length(); };
  PartsOfRanks there(std::size_t(ranks.Size()), parts.data() + own.begin);
  ExchangeBuffers room;
  ExchangePacked(
    ranks, BytesOf<PartialPixel>(ranks, countOf), BytesOf<PartialPixel>(ranks, ownCount), room,
    [&](std::size_t rank, std::byte* buffer)
    {
      const Range<Index> pixels = pixelsOf(int(rank));
      std::memcpy(
        buffer, parts.data() + pixels.begin, std::size_t(pixels.Length()) * sizeof(PartialPixel));
    },
    [&](std::size_t rank, const std::byte* buffer)
    { there[rank] = reinterpret_cast<const PartialPixel*>(buffer); });

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

  const auto show = [&picture](const Range<Index>& pixels, const ComposedPixel* shown)
  {
    for (Index pixel = pixels.begin; pixel < pixels.end; ++pixel, ++shown)
    {
      std::memcpy(
        picture.rgba.data() + sizeof(Rgba) * std::size_t(pixel), &shown->color, sizeof(Rgba));
      picture.foremost[std::size_t(pixel)] = shown->foremost;
    }
  };
  show(own, composed.data());
  ExchangeBuffers roomForAll;
  ExchangePacked(
    ranks, BytesOf<ComposedPixel>(ranks, ownCount), BytesOf<ComposedPixel>(ranks, countOf),
    roomForAll,
    [&](std::size_t, std::byte* buffer)
    { std::memcpy(buffer, composed.data(), composed.size() * sizeof(ComposedPixel)); },
    [&](std::size_t rank, const std::byte* buffer)
    { show(pixelsOf(int(rank)), reinterpret_cast<const ComposedPixel*>(buffer)); });
}
}

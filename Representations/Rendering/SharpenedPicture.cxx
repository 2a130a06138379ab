// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharpenedPicture.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
// What is left of the coarse picture when it is over, and how much of it goes in one frame.
constexpr double LeastShare = 1.0 / 32;
constexpr double SmallestStep = 1.0 / 16;
constexpr double LargestStep = 1.0 / 4;

// Where a pixel of the sharp picture lies between two of the coarse one.
struct Between
{
  int first;
  int second;
  float fraction;
};

std::vector<Between> PlacesOf(
  std::size_t axis, const PictureFrame& sharp, const PictureFrame& coarse)
{
  std::vector<Between> places;
  const double shrink = double(coarse.whole[axis]) / sharp.whole[axis];
  const int last = coarse.size[axis] - 1;
  for (int pixel = 0; pixel < sharp.size[axis]; ++pixel)
  {
    const double middle = (sharp.origin[axis] + pixel + 0.5) * shrink;
    const double place = std::clamp(middle - coarse.origin[axis] - 0.5, 0.0, double(last));
    const int first = static_cast<int>(place);
    places.push_back({ first, std::min(first + 1, last), static_cast<float>(place - first) });
  }
  return places;
}
}

void SharpenedPicture::Begin(
  const Picture& coarse, const PictureFrame& frame, const ViewGeometry& geometry)
{
  this->Coarse = coarse;
  this->CoarseFrame = frame;
  this->Size = geometry.size;
  this->ClipToData = geometry.clipToData;
  this->Remaining = 1;
}

const Picture& SharpenedPicture::Advance(const Picture& sharp, const PictureFrame& frame,
  const ViewGeometry& geometry, double seconds, double easeTime)
{
  const bool sameView = geometry.size == this->Size && geometry.clipToData == this->ClipToData;
  const double share = easeTime > 0 ? 1 - std::exp(-seconds / easeTime) : 1.0;
  this->Remaining *=
    easeTime > 0 && sameView ? 1 - std::clamp(share, SmallestStep, LargestStep) : 0.0;
  if (this->Remaining < LeastShare)
  {
    this->Clear();
    return sharp;
  }
  const std::vector<Between> columns = PlacesOf(0, frame, this->CoarseFrame);
  const std::vector<Between> rows = PlacesOf(1, frame, this->CoarseFrame);
  this->Shown.width = sharp.width;
  this->Shown.height = sharp.height;
  this->Shown.rgba.resize(sharp.rgba.size());
  const auto coarseShare = static_cast<float>(this->Remaining);
  ParallelFor(sharp.height, 16,
    [&](Index row)
    {
      const Between& y = rows[std::size_t(row)];
      const std::size_t width = 4 * std::size_t(this->Coarse.width);
      const std::uint8_t* below = this->Coarse.rgba.data() + width * std::size_t(y.first);
      const std::uint8_t* above = this->Coarse.rgba.data() + width * std::size_t(y.second);
      const std::size_t first = 4 * std::size_t(row) * std::size_t(sharp.width);
      for (std::size_t pixel = 0; pixel < columns.size(); ++pixel)
      {
        const Between& x = columns[pixel];
        for (std::size_t channel = 0; channel < 4; ++channel)
        {
          const auto along = [&](const std::uint8_t* values)
          {
            const float left = values[4 * std::size_t(x.first) + channel];
            const float right = values[4 * std::size_t(x.second) + channel];
            return left + x.fraction * (right - left);
          };
          const float low = along(below);
          const float coarse = low + y.fraction * (along(above) - low);
          const std::size_t at = first + 4 * pixel + channel;
          const float fine = sharp.rgba[at];
          this->Shown.rgba[at] =
            static_cast<std::uint8_t>(fine + coarseShare * (coarse - fine) + 0.5f);
        }
      }
    });
  return this->Shown;
}

void SharpenedPicture::Clear()
{
  *this = SharpenedPicture();
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharpenedPicture.h"

#include "EnlargedPicture.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
// The share of the coarse picture at which the transition ends, and the range of the steps per
// frame.
constexpr double LeastShare = 1.0 / 32;
constexpr double SmallestStep = 1.0 / 16;
constexpr double LargestStep = 1.0 / 4;
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
  const EnlargedPicture enlarged(this->Coarse, this->CoarseFrame, frame);
  this->Shown = sharp;
  const auto coarseShare = static_cast<float>(this->Remaining);
  ParallelFor(sharp.height, 16,
    [&](Index row)
    {
      const auto y = static_cast<int>(row);
      for (int x = 0; x < sharp.width; ++x)
      {
        const std::size_t pixel = std::size_t(row) * std::size_t(sharp.width) + std::size_t(x);
        for (std::size_t channel = 0; channel < 4; ++channel)
        {
          std::uint8_t& shown = this->Shown.rgba[4 * pixel + channel];
          const float fine = shown;
          shown = static_cast<std::uint8_t>(
            fine + coarseShare * (enlarged.At(x, y, channel) - fine) + 0.5f);
        }
        if (!sharp.foremost.empty() && sharp.foremost[pixel] < 0)
        {
          this->Shown.foremost[pixel] = enlarged.ForemostAt(x, y);
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

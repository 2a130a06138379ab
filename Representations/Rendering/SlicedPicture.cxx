// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SlicedPicture.h"

#include "Frame.h"
#include "OpaqueDepth.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
// Of what VolumeView sets for a frame, but for depths.
bool AreSame(const View& a, const View& b)
{
  return a.width == b.width && a.height == b.height && a.clipToWorld == b.clipToWorld &&
    a.planes == b.planes && a.sampleDistance == b.sampleDistance && a.jitter == b.jitter;
}
}

void SlicedPicture::Begin(
  const View& view, std::vector<float> depth, std::uint64_t changes, int numberOfSlices)
{
  if (AreSame(view, this->Rays) && depth == this->Depth && changes == this->Changes)
  {
    return;
  }
  this->Rays = view;
  this->Depth = std::move(depth);
  this->Changes = changes;
  this->RowsOfSlice = std::max(1, (view.height + numberOfSlices - 1) / numberOfSlices);
  this->Rows = 0;
  this->Made.width = view.width;
  this->Made.height = view.height;
  this->Made.rgba.assign(4 * this->Depth.size(), 0);
}

bool SlicedPicture::Advance(double seconds, const Cast& cast)
{
  const auto start = FrameClock::SteadyClock::now();
  while (this->Rows < this->Rays.height)
  {
    const int end = std::min(this->Rows + this->RowsOfSlice, this->Rays.height);
    const auto first = std::ptrdiff_t(this->Rows) * this->Rays.width;
    const auto last = std::ptrdiff_t(end) * this->Rays.width;
    std::vector<float> depth(this->Depth.size(), noRay);
    std::copy(this->Depth.begin() + first, this->Depth.begin() + last, depth.begin() + first);
    View view = this->Rays;
    view.depth = depth.data();
    const Picture* slice = cast(view);
    if (!slice)
    {
      return false;
    }
    std::copy(slice->rgba.begin() + 4 * first, slice->rgba.begin() + 4 * last,
      this->Made.rgba.begin() + 4 * first);
    this->Rows = end;
    if (FrameClock::SecondsSince(start) > seconds)
    {
      break;
    }
  }
  return true;
}

void SlicedPicture::Clear()
{
  *this = SlicedPicture();
}
}

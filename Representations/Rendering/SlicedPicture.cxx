// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SlicedPicture.h"

#include "KeptPictures.h"

#include <algorithm>
#include <utility>

namespace limpid
{
bool SlicedPicture::Shows(const Wanted& wanted) const
{
  return AreSameRays(wanted.view, this->Goal.view) && wanted.depth == this->Goal.depth &&
    wanted.changes == this->Goal.changes;
}

void SlicedPicture::Begin(Wanted wanted, int numberOfSlices)
{
  this->Goal = std::move(wanted);
  const View& view = this->Goal.view;
  this->RowsOfSlice = std::max(1, (view.height + numberOfSlices - 1) / numberOfSlices);
  this->Rows = 0;
  this->Made.width = view.width;
  this->Made.height = view.height;
  this->Made.rgba.assign(4 * this->Goal.depth.size(), 0);
  this->Made.foremost.clear();
}

bool SlicedPicture::Advance(const std::function<bool()>& isOutOfTime, const Cast& cast)
{
  const View& rays = this->Goal.view;
  bool goOn = true;
  while (goOn && this->Rows < rays.height)
  {
    const int end = std::min(this->Rows + this->RowsOfSlice, rays.height);
    const auto first = std::ptrdiff_t(this->Rows) * rays.width;
    const auto last = std::ptrdiff_t(end) * rays.width;
    View view = rays;
    view.depth = this->Goal.depth.data();
    view.rows = { this->Rows, end };
    const Picture* slice = cast(view);
    if (!slice)
    {
      return false;
    }
    std::copy(slice->rgba.begin() + 4 * first, slice->rgba.begin() + 4 * last,
      this->Made.rgba.begin() + 4 * first);
    if (!slice->foremost.empty())
    {
      this->Made.foremost.resize(slice->foremost.size(), -1);
      std::copy(slice->foremost.begin() + first, slice->foremost.begin() + last,
        this->Made.foremost.begin() + first);
    }
    this->Rows = end;
    goOn = !isOutOfTime();
  }
  return true;
}

void SlicedPicture::Clear()
{
  *this = SlicedPicture();
}
}

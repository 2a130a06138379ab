// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "EnlargedPicture.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
std::vector<EnlargedPicture::Between> EnlargedPicture::PlacesOf(
  std::size_t axis, const PictureFrame& fine, const PictureFrame& coarse)
{
  std::vector<Between> places;
  const double shrink = double(coarse.whole[axis]) / fine.whole[axis];
  const int last = coarse.size[axis] - 1;
  for (int pixel = 0; pixel < fine.size[axis]; ++pixel)
  {
    const double middle = (fine.origin[axis] + pixel + 0.5) * shrink;
    const double place = std::clamp(middle - coarse.origin[axis] - 0.5, 0.0, double(last));
    const int first = static_cast<int>(place);
    places.push_back({ first, std::min(first + 1, last), static_cast<float>(place - first) });
  }
  return places;
}

EnlargedPicture::EnlargedPicture(
  const Picture& coarse, const PictureFrame& frame, const PictureFrame& fine)
  : Coarse(&coarse)
  , Places{ { PlacesOf(0, fine, frame), PlacesOf(1, fine, frame) } }
{
}

std::int32_t EnlargedPicture::ForemostAt(int column, int row) const
{
  const Between& x = this->Places[0][std::size_t(column)];
  const Between& y = this->Places[1][std::size_t(row)];
  const auto at = [&](int across, int up)
  {
    return this->Coarse
      ->foremost[std::size_t(up) * std::size_t(this->Coarse->width) + std::size_t(across)];
  };
  const bool right = x.fraction > 0.5F;
  const bool above = y.fraction > 0.5F;
  const int across[2] = { right ? x.second : x.first, right ? x.first : x.second };
  const int up[2] = { above ? y.second : y.first, above ? y.first : y.second };
  std::int32_t foremost = -1;
  for (int other = 0; other < 4 && foremost < 0; ++other) // nearest first
  {
    foremost = at(across[other & 1], up[other >> 1]);
  }
  return foremost;
}

Picture EnlargedPicture::Whole() const
{
  Picture whole;
  whole.width = static_cast<int>(this->Places[0].size());
  whole.height = static_cast<int>(this->Places[1].size());
  const std::size_t count = this->Places[0].size() * this->Places[1].size();
  whole.rgba.resize(4 * count);
  whole.foremost.resize(this->Coarse->foremost.empty() ? 0 : count);
  ParallelFor(whole.height, 16,
    [&](Index row)
    {
      const auto y = static_cast<int>(row);
      const std::size_t first = std::size_t(row) * this->Places[0].size();
      for (int x = 0; x < whole.width; ++x)
      {
        const std::size_t pixel = first + std::size_t(x);
        for (std::size_t channel = 0; channel < 4; ++channel)
        {
          whole.rgba[4 * pixel + channel] =
            static_cast<std::uint8_t>(this->At(x, y, channel) + 0.5F);
        }
        if (!whole.foremost.empty())
        {
          whole.foremost[pixel] = this->ForemostAt(x, y);
        }
      }
    });
  return whole;
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FrameBudget.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr double LargestPixelSize = 8;

// Rounds up to a multiple of a quarter, so that sizes repeat.
double RoundUp(double size)
{
  return std::ceil(4 * size) / 4;
}
}

double FrameBudget::PixelSize(double pixels, double seconds)
{
  const double rays = std::max(seconds, 1e-6) / this->SecondsPerRay;
  const double size = std::sqrt(std::max(pixels, 1.0) / rays);
  const bool tooSmall = size > 1.05 * this->LastPixelSize;
  const bool tooLarge = size < 0.75 * this->LastPixelSize;
  if (tooSmall || tooLarge)
  {
    this->LastPixelSize = RoundUp(std::min(std::max(size, 1.0), LargestPixelSize));
  }
  return this->LastPixelSize;
}

void FrameBudget::Record(double rays, double seconds)
{
  if (!(rays > 0 && seconds >= 0))
  {
    return;
  }
  const double now = std::max(seconds / rays, 1e-9);
  this->SecondsPerRay = this->Measured ? 0.5 * (this->SecondsPerRay + now) : now;
  this->Measured = true;
}
}

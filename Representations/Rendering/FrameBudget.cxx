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

double FrameBudget::Coarseness(double pixels, double seconds, double farthest)
{
  const double rays = std::max(seconds, 1e-6) / this->SecondsPerRay;
  const double size = std::sqrt(std::max(pixels, 1.0) / rays);
  const bool tooFine = size > 1.05 * this->LastCoarseness;
  const bool tooCoarse = size < 0.75 * this->LastCoarseness;
  if (tooFine || tooCoarse)
  {
    this->LastCoarseness = RoundUp(std::max(size, 1.0));
  }
  const double most = LargestPixelSize * std::sqrt(std::max(farthest, 1.0));
  this->LastCoarseness = std::min(this->LastCoarseness, most);
  return this->LastCoarseness;
}

double FrameBudget::PixelSizeOf(double coarseness)
{
  return std::min(coarseness, LargestPixelSize);
}

// A picture takes as long as it has samples.
double FrameBudget::StepOf(double coarseness)
{
  const double beyond = coarseness / PixelSizeOf(coarseness);
  return beyond * beyond;
}

void FrameBudget::Expect(double secondsPerRay)
{
  this->SecondsPerRay = this->Measured ? this->SecondsPerRay : secondsPerRay;
}

void FrameBudget::Record(double rays, double step, double seconds)
{
  if (!(rays > 0 && seconds >= 0))
  {
    return;
  }
  const double now = std::max(step * seconds / rays, 1e-9);
  this->SecondsPerRay = this->Measured ? 0.5 * (this->SecondsPerRay + now) : now;
  this->Measured = true;
}
}

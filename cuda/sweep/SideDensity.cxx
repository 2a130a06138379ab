// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SideDensity.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Rays per voxel where they leave the box, and per unit of slope and width of the box. With both,
/// the density is uniform if the box is at most twice as long as wide.
constexpr double raysPerVoxel = 2;
constexpr double raysPerWidth = 4;
}

int PartCount(double wanted, double fewest)
{
  constexpr double most = 1e6;
  constexpr double margin = 1e-9; // tolerance when rounding to integers
  const double parts = std::max(std::ceil(wanted - margin), std::floor(fewest + margin));
  return static_cast<int>(std::min(std::max(parts, 1.0), most));
}

SideDensity::SideDensity(const Range<double>& slopes, double side, double last, double rayDensity,
  double perUnit, double least)
  : Mirrored(slopes.end <= 0)
  , Slopes(this->Mirrored ? Range<double>{ -slopes.end, -slopes.begin } : slopes)
  , Most(perUnit)
  , Least(std::min(std::max(raysPerWidth * rayDensity * last, least), perUnit))
  , GradedFrom(raysPerVoxel * rayDensity * side / this->Most)
  , GradedTo(raysPerVoxel * rayDensity * side / this->Least)
  , Uniform(
      this->Slopes.begin < 0 || this->Least >= this->Most || this->Slopes.end <= this->GradedFrom)
{
}

/// Integral of the density from slope 0.
double SideDensity::CountUpTo(double slope) const
{
  const double graded = std::min(std::max(slope, this->GradedFrom), this->GradedTo);
  return this->Most *
    (std::min(slope, this->GradedFrom) + this->GradedFrom * std::log(graded / this->GradedFrom)) +
    this->Least * std::max(slope - this->GradedTo, 0.0);
}

/// The inverse of CountUpTo.
double SideDensity::SlopeAt(double count) const
{
  const double from = this->CountUpTo(this->GradedFrom);
  const double to = this->CountUpTo(this->GradedTo);
  if (count <= from)
  {
    return count / this->Most;
  }
  return count <= to ? this->GradedFrom * std::exp((count - from) / from)
                     : this->GradedTo + (count - to) / this->Least;
}

void SideDensity::Divide(double fewest, std::vector<double>& edges) const
{
  const double before = this->CountUpTo(this->Slopes.begin);
  const double all = this->CountUpTo(this->Slopes.end) - before;
  const int parts = PartCount(all, fewest);
  for (int part = 1; part < parts; ++part)
  {
    edges.push_back(this->Mirrored ? -this->SlopeAt(before + all * (parts - part) / parts)
                                   : this->SlopeAt(before + all * part / parts));
  }
  edges.push_back(this->Mirrored ? -this->Slopes.begin : this->Slopes.end);
}
}

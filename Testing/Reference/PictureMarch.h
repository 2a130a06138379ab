// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The independent truth for pictures: every ray in many small steps, double precision, straight
// from the formulas. Shares no code with cuda/.

#ifndef limpid_testing_PictureMarch_h
#define limpid_testing_PictureMarch_h

#include "Fields.h"
#include "Rays.h"
#include "Samples.h"
#include "Scattering.h"

#include <array>
#include <vector>

namespace truth
{
/// What is shown, and how it is lit.
struct Medium
{
  Field<double> scalars;
  Table<double> extinction; ///< mu-bar of a scalar [1/length]
  Table<Vector> color;      ///< c of a scalar [0, 1]

  /// What the optimisation changed; both without values: nothing. Of the extinction of the transfer
  /// function the share changed / base, at most 1, is kept - at nodes without base the mean share
  /// of those next to it that have some - and what exceeds base is added.
  Field<double> base;    ///< [1/length]
  Field<double> changed; ///< [1/length]

  Illumination light;

  /// Light that arrives at nodes, if it is not to be marched to them; Shadow::Interpolated only.
  Field<double> arrivingLight;
};

/// Where the light that arrives at a sample comes from.
enum class Shadow
{
  Interpolated, ///< marched to the nodes, trilinear between: what a shadow volume can know
  Marched       ///< marched to the very sample
};

struct Frame
{
  int width = 0;
  int height = 0;
  std::array<double, 16> clipToWorld{}; ///< column by column
  const float* depth = nullptr;         ///< clip z in [-1, 1], null: 1
};

struct Color
{
  std::array<double, 4> rgba{ { 0, 0, 0, 0 } }; ///< colours times alpha, not clamped

  double secondOrder = 0; ///< SecondOrderBound of the line of sight [1/length^2]
};

class PictureMarch
{
public:
  PictureMarch(const Medium& medium, Shadow shadow, int stepsPerVoxel);

  Color Pixel(const Frame& frame, int column, int row) const;

  /// All pixels, first row at the bottom.
  std::vector<Color> Picture(const Frame& frame) const;

  /// Length of the smallest spacing, the unit of sample distances.
  double Unit() const;

  double ExtinctionAt(const Vector& position) const;
  double ArrivingLightAt(const Vector& position) const;

private:
  struct Line;
  Line LineOf(const Frame& frame, int column, int row) const;
  std::vector<Sample> SamplesAlong(const Line& line) const;
  Sample SampleAt(const Vector& position, const Line& line) const;
  double SlopeAt(double scalar) const;
  const Field<double>& ShadowCaster() const;

  Medium Scene;
  Shadow Kind;
  int StepsPerVoxel;
  double Majorant = 0; ///< largest extinction of the transfer function
  Field<double> Kept;
  Field<double> Added;
  Field<double> BaseAtNodes;
  Field<Vector> Slopes; ///< gradient over its largest length
  Field<double> LightAtNodes;
};
}

#endif

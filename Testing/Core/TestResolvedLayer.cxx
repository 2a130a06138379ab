// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The pieces of a resolved layer against integrals in double precision.

#include "Tolerance.h"

#include "sweep/ResolvedLayer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace limpid;

namespace
{
/// A piece whose extinction goes from `first` to `second` times 1 / length.
RayPiece PieceOf(double first, double second, double front, double back)
{
  RayPiece piece{};
  piece.opticalDepth = static_cast<float>(0.5 * (first + second));
  piece.tilt = static_cast<float>((second - first) / 12);
  piece.front = static_cast<float>(front);
  piece.back = static_cast<float>(back);
  return piece;
}

/// The integral of g mu T over the piece: Simpson's rule.
double Visible(double first, double second, double front, double back)
{
  const int panels = 4000;
  const double h = 1.0 / panels;
  const auto value = [&](double t)
  {
    const double extinction = first + t * (second - first);
    const double depth = t * first + 0.5 * t * t * (second - first);
    return (front + t * (back - front)) * extinction * std::exp(-depth);
  };
  double sum = 0;
  for (int n = 0; n < panels; ++n)
  {
    sum += h / 6 * (value(n * h) + 4 * value((n + 0.5) * h) + value((n + 1) * h));
  }
  return sum;
}
}

TEST(RayPiece, ShowsWhatConstantExtinctionShows)
{
  for (const double x : { 1e-7, 1e-3, 0.05, 0.0999, 0.1001, 0.5, 2.0, 20.0 })
  {
    SCOPED_TRACE(x);
    const double expected = Visible(x, x, 0.2, 0.9);

    EXPECT_WITHIN(PieceOf(x, x, 0.2, 0.9).Visible(), expected,
      Relative(1e-5, expected, "1 - m and m - e^-x cancel to a tenth of m") +
        Roundoff<float>(4, std::min(x, 1.0)));
  }
}

TEST(RayPiece, ShowsWhatLinearExtinctionShows)
{
  for (const double x : { 1e-3, 0.05, 0.25, 0.5 })
  {
    for (const double share : { 0.0, 0.5, 1.0, 1.5, 2.0 })
    {
      SCOPED_TRACE(::testing::Message() << x << ", front " << share);
      const double first = share * x;
      const double second = (2 - share) * x;
      const double expected = Visible(first, second, 0.2, 0.9);

      // The products of slopes with x are left out: x (dx) / 24 of the slope of g.
      const double slopes = 0.7 * x * std::abs(second - first) / 12;
      EXPECT_WITHIN(PieceOf(first, second, 0.2, 0.9).Visible(), expected,
        (Tolerance{ slopes, "second order of the slope of the extinction" }) +
          Relative(1e-5, expected, "cancellation"));
    }
  }
}

TEST(RayPiece, DiffersAsItsSlopesSay)
{
  for (const double x : { 0.01, 0.0999, 0.11, 0.5, 2.0 })
  {
    SCOPED_TRACE(x);
    const RayPiece piece = PieceOf(0.6 * x, 1.4 * x, 0.8, 0.1);
    const float step = static_cast<float>(0.02 * x);
    RayPiece more = piece;
    RayPiece less = piece;
    more.opticalDepth += step;
    less.opticalDepth -= step;
    const double byDepth =
      (double(more.Visible()) - less.Visible()) / (double(more.opticalDepth) - less.opticalDepth);
    more = less = piece;
    more.tilt += step;
    less.tilt -= step;
    const double byTilt =
      (double(more.Visible()) - less.Visible()) / (double(more.tilt) - less.tilt);

    // Values of the size of x are off by some units in their last place.
    const Tolerance rounding = Roundoff<float>(16, std::min(x, 1.0) / (0.02 * x));
    EXPECT_WITHIN(
      piece.VisibleSlope(), byDepth, rounding + (Tolerance{ step * step, "central difference" }));
    EXPECT_WITHIN(piece.TiltSlope(), byTilt, rounding);
  }
}

namespace
{
/// A layer of unit thickness in segments of constant extinction and importance.
struct Segments
{
  std::vector<double> opticalDepth;
  std::vector<double> importance; ///< [0, 1]
  std::vector<double> place;      ///< [0, 1]
  double behind = 0;              ///< visible importance behind the layer [0, 1]

  std::size_t Count() const { return this->opticalDepth.size(); }
  double Size() const { return 1.0 / static_cast<double>(this->Count()); }

  LayerEffect Effect() const
  {
    LightOfPieces<float> light;
    EffectOfPieces<float> effect;
    for (std::size_t k = 0; k < this->Count(); ++k)
    {
      RayPiece piece = PieceOf(
        this->opticalDepth[k], this->opticalDepth[k], this->importance[k], this->importance[k]);
      piece.place = static_cast<float>(this->place[k]);
      piece.size = static_cast<float>(this->Size());
      effect.Add(piece, light.transmittance, light.IsLit(), 1.0f);
      light.Add(piece, true);
    }
    return effect.With(static_cast<float>(this->behind) * light.transmittance);
  }

  /// What is seen of segment k and everything behind it, for T = 1 at its front.
  double SeenFrom(std::size_t k) const
  {
    return k == this->Count() ? this->behind
                              : -std::expm1(-this->opticalDepth[k]) * this->importance[k] +
        std::exp(-this->opticalDepth[k]) * this->SeenFrom(k + 1);
  }

  /// The effect on a slice, sum of w size T (V - g); w: its weight in each segment. `absolute`:
  /// sums size T (V + g) instead, which bounds the terms.
  double Expected(bool ofBack, bool absolute) const
  {
    double sum = 0;
    double depth = 0;
    for (std::size_t k = 0; k < this->Count(); ++k)
    {
      depth += this->opticalDepth[k];
      const double weight = ofBack ? this->place[k] : 1 - this->place[k];
      const double own = absolute ? -this->importance[k] : this->importance[k];
      sum += weight * this->Size() * std::exp(-depth) * (this->SeenFrom(k + 1) - own);
    }
    return sum;
  }

  /// Rounding of 3 operations a segment for transmittances, 4 for the sums, 12 within a segment.
  Tolerance Rounding(bool ofBack) const
  {
    return Roundoff<float>(
      7 * static_cast<double>(this->Count()) + 12, this->Expected(ofBack, true));
  }

  void Add(double x, double g, double where)
  {
    this->opticalDepth.push_back(x);
    this->importance.push_back(g);
    this->place.push_back(where);
  }
};
}

TEST(EffectOfPieces, IsTheSumOverSegmentsOfWhatTheyHide)
{
  for (const double x : { 0.002, 0.05, 0.2, 1.0, 5.0 })
  {
    SCOPED_TRACE(x);
    Segments layer;
    layer.behind = 0.7;
    for (int k = 0; k < 8 && k * x < 8; ++k) // all are lit
    {
      layer.Add((k % 3 + 1) * x / 2, k % 4 / 4.0, (k + 0.5) / 8);
    }

    const LayerEffect effect = layer.Effect();

    EXPECT_WITHIN(effect.front, layer.Expected(false, false), layer.Rounding(false));
    EXPECT_WITHIN(effect.back, layer.Expected(true, false), layer.Rounding(true));
  }
}

// A surface at the front shows nearly all that is seen. Differences of what is seen from its front
// and of its own share would have an error of 1e-8 and more, a thousandth of the effect.
TEST(EffectOfPieces, IsAsExactBehindAnImportantSurface)
{
  Segments layer;
  layer.behind = 1;
  layer.Add(3, 1, 0);
  for (int k = 1; k < 16; ++k)
  {
    layer.Add(0.5, 0, (k + 0.5) / 16);
  }

  const LayerEffect effect = layer.Effect();

  EXPECT_WITHIN(effect.back, layer.Expected(true, false), layer.Rounding(true));
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The conservative quadrature of half a layer against its integrals in double precision.

#include "Tolerance.h"

#include "sweep/HalfLayer.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace limpid;

namespace
{
const std::vector<double> opticalDepths{ 0, 1e-30, 1e-6, 1e-3, 0.1, 0.24, 0.26, 0.49, 0.51, 1, 2, 5,
  20, 80, 1000, 1e6, 1e30 };

/// Integral over s in [0, 1] of x scale(s)^2 exp(-x s), the scale linear in s: Simpson's rule.
double StoppedArea(double x, double front, double back)
{
  const int panels = 2000;
  const double h = 1.0 / panels;
  const auto value = [&](double s)
  { return x * std::pow(front + s * (back - front), 2) * std::exp(-x * s); };
  double sum = 0;
  for (int n = 0; n < panels; ++n)
  {
    sum += h / 6 * (value(n * h) + 4 * value((n + 0.5) * h) + value((n + 1) * h));
  }
  return sum;
}
}

TEST(HalfLayer, StopsWhatBeersLawStops)
{
  for (const double x : opticalDepths)
  {
    SCOPED_TRACE(x);

    const HalfLayer<float> half(0.5f, static_cast<float>(2 * x), 0.7f, 1.0f, 1.0f);

    const double stopped = -std::expm1(-x);
    const Tolerance tolerance = Roundoff<float>(12, stopped); // Stop's 2, and those of its argument
    EXPECT_WITHIN(half.stopped, stopped, tolerance);
    EXPECT_WITHIN(half.Passed(), 1 - stopped, tolerance + Roundoff<float>(1, 1.0));
    EXPECT_WITHIN(half.visible, 0.7 * stopped, tolerance + Roundoff<float>(8, 0.7 * stopped));
    EXPECT_WITHIN(half.unattenuated, 0.7 * x, Roundoff<float>(12, 0.7 * x));
  }
}

TEST(HalfLayer, NeverShowsMoreThanThereIs)
{
  for (const double x : opticalDepths)
  {
    for (const float back : { 1.0f, 1.1f, 1.9f })
    {
      SCOPED_TRACE(::testing::Message() << x << ", scale " << back);

      const HalfLayer<float> half(1.0f, static_cast<float>(x), 1.0f, 1.0f, back);

      EXPECT_GE(half.stopped, 0.0f);
      EXPECT_LE(half.stopped, 1.0f);
      EXPECT_GE(half.visible, half.stopped);
      EXPECT_LE(half.visible, half.stopped * back * back * (1 + 1e-6f));
      EXPECT_LE(half.visible, half.unattenuated * (1 + 1e-6f));
      EXPECT_LE(half.LimitedDepth(), 1e4f);
    }
  }
}

TEST(HalfLayer, CountsTheWideningOfRaysWhereLightIsStopped)
{
  const double front = 0.8;
  const double back = 0.85;
  for (const double x : { 1e-4, 0.01, 0.1, 0.5, 0.9 })
  {
    SCOPED_TRACE(x);

    const HalfLayer<double> half(1.0, x, 1.0, front, back);

    const double truth = StoppedArea(x, front, back);
    // The mean depth is right to 1e-3 of itself, which is at most 1/2; it moves the area by
    // 2 front widening; the series of exp is that of float.
    const double widening = 2 * back * (back - front) * 0.5e-3;
    const Tolerance tolerance = Tolerance{ widening * x, "mean depth where light is stopped" } +
      Relative(3e-7, truth, "exponential of float quality");
    EXPECT_WITHIN(half.visible, truth, tolerance);
    const double meanArea = (front * front + front * back + back * back) / 3;
    EXPECT_WITHIN(half.unattenuated, x * meanArea, Roundoff<double>(20, x));
  }
}

TEST(HalfLayer, IntegratesCubicProductsInThinMediaExactly)
{
  // mu and g linear along the layer: g mu is quadratic, and two Gauss points see a cubic exactly.
  const double thickness = 0.37;
  const double length = 1.2;
  const Layer layer{ 2.0f, static_cast<float>(thickness), 1.0f, 1.0f };
  const auto extinctionAt = [](double s) { return 1e-9 * (1 + 2 * s); };
  const auto importanceAt = [](double s) { return 0.9 - 0.7 * s; };

  double visible = 0;
  double opticalDepth = 0;
  for (int half = 0; half < 2; ++half)
  {
    const HalfLayer<double> part = WholeHalf<double>(layer, RangeOfHalf(half), length,
      extinctionAt(gaussPoints[half]), importanceAt(gaussPoints[half]));
    visible += part.visible;
    opticalDepth += part.opticalDepth;
  }

  // Integral of (1 + 2 s)(0.9 - 0.7 s) over [0, 1].
  const double truth = 1e-9 * length * thickness * (0.9 + 1.1 / 2 - 1.4 / 3);
  const Tolerance thin = Relative(1e-7, truth, "thickness in float, attenuation of 1e-9");
  EXPECT_WITHIN(visible, truth, thin);
  EXPECT_WITHIN(opticalDepth, 1e-9 * length * thickness * 2, thin + Relative(1e-7, 1e-9, "float"));
}

TEST(HalfLayer, ClippedHalvesAddUpToTheWayInside)
{
  const Layer layer{ 10.0f, 1.0f, 1.0f, 1.2f };
  const std::vector<Range<float>> clips{ { -1e30f, 1e30f }, { 10.2f, 1e30f }, { -1e30f, 10.7f },
    { 10.3f, 10.4f }, { 10.6f, 10.9f }, { 10.4f, 10.6f }, { 10.5f, 10.5f }, { 10.8f, 10.2f },
    { 11.5f, 12.0f }, { 3.0f, 9.0f } };
  for (const Range<float>& column : clips)
  {
    for (const Range<float>& row : clips)
    {
      SCOPED_TRACE(::testing::Message()
        << column.begin << ' ' << column.end << ' ' << row.begin << ' ' << row.end);
      double opticalDepth = 0;
      for (const int half : { 0, 1 })
      {
        const Range<float> part = ClippedRange(layer, RangeOfHalf(half), column, row);
        opticalDepth += ClippedHalf<double>(layer, part, 2.0, 0.5, 1.0).opticalDepth;
      }

      const double entry = std::max({ 10.0, double(column.begin), double(row.begin) });
      const double exit = std::min({ 11.0, double(column.end), double(row.end) });
      EXPECT_WITHIN(opticalDepth, std::max(0.0, exit - entry), Roundoff<float>(8, 1.0));
    }
  }
}

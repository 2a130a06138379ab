// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace truth
{
namespace
{
double Largest(const std::array<double, 3>& color)
{
  return std::max({ color[0], color[1], color[2] });
}

/// First and second differences around a sample; their largest over the channels for the colour.
struct Differences
{
  double extinctionStep = 0;
  double extinctionBend = 0;
  double colorStep = 0;
  double colorBend = 0;

  Differences(const Sample& before, const Sample& here, const Sample& after)
    : extinctionStep(std::abs(after.extinction - here.extinction))
    , extinctionBend(std::abs(before.extinction - 2 * here.extinction + after.extinction) +
        here.slope * std::abs(before.scalar - 2 * here.scalar + after.scalar))
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const double step = after.color[channel] - here.color[channel];
      const double lastStep = here.color[channel] - before.color[channel];
      this->colorStep = std::max(this->colorStep, std::abs(step));
      this->colorBend = std::max(this->colorBend, std::abs(step - lastStep));
    }
  }
};
}

std::array<double, 4> Compose(const std::vector<Sample>& samples, double step)
{
  std::array<double, 4> rgba{};
  double depth = 0;
  for (const Sample& sample : samples)
  {
    const double stopped = std::exp(-depth) * -std::expm1(-sample.extinction * step);
    for (int channel = 0; channel < 3; ++channel)
    {
      rgba[channel] += stopped * sample.color[channel];
    }
    depth += sample.extinction * step;
  }
  rgba[3] = -std::expm1(-depth);
  return rgba;
}

double SecondOrderBound(const std::vector<Sample>& samples, double step)
{
  double depth = 0;        // optical depth in front of the sample
  double depthError = 0;   // its bound
  double opacityError = 0; // of 1 - T
  double radianceError = 0;
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const Sample& here = samples[k];
    const Differences d(
      samples[k > 0 ? k - 1 : 0], here, samples[std::min(k + 1, samples.size() - 1)]);
    const double transmittance = std::exp(-depth);
    const double color = Largest(here.color);
    const double mu = here.extinction;
    depthError += d.extinctionBend / step / 8;
    radianceError += transmittance *
      (color * d.extinctionBend / step / 8 + mu * d.colorBend / step / 8 +
        d.extinctionStep * d.colorStep / step / 4 +
        mu * (d.extinctionStep * color + mu * d.colorStep) / 4 +
        mu * step * color * (depthError + d.extinctionStep / step / 8));
    depth += mu * step;
    opacityError = std::max(opacityError, std::exp(-depth) * depthError);
  }
  return std::max(radianceError, opacityError);
}
}

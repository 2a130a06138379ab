// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Classification.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
void Require(const TransferFunctions& functions)
{
  const std::size_t count = functions.extinction.size();
  LIMPID_REQUIRE(count >= 2 && functions.color.size() == count,
    "The transfer functions have " << count << " extinctions and " << functions.color.size()
                                   << " colours (every scalar needs both). Give two or more, as "
                                      "many of one as of the other.");
  LIMPID_REQUIRE(
    std::isfinite(functions.low) && functions.high > functions.low && std::isfinite(functions.high),
    "The transfer functions reach from " << functions.low << " to " << functions.high
                                         << " (no scalar is between). Give an ascending range.");
  for (const float value : functions.extinction)
  {
    LIMPID_REQUIRE(value >= 0 && std::isfinite(value),
      "The transfer function has the extinction "
        << value
        << " (light can neither grow nor vanish at once). Keep it finite and not "
           "negative.");
  }
  for (const std::array<float, 3>& color : functions.color)
  {
    LIMPID_REQUIRE(std::isfinite(color[0]) && std::isfinite(color[1]) && std::isfinite(color[2]),
      "The transfer function has the colour (" << color[0] << ", " << color[1] << ", " << color[2]
                                               << ") (no pixel can show it). Keep it finite.");
  }
}
}

Classification::Classification(const TransferFunctions& functions)
{
  Require(functions);
  const std::size_t count = functions.extinction.size();
  this->Last = static_cast<int>(count) - 1;
  this->LastPosition = static_cast<float>(this->Last);
  this->Low = static_cast<float>(functions.low);
  this->Scale = static_cast<float>(this->Last / (functions.high - functions.low));
  this->LargestExtinction =
    *std::max_element(functions.extinction.begin(), functions.extinction.end());
  const float unit = this->LargestExtinction > 0 ? 1 / this->LargestExtinction : 0.0f;

  this->Values.resize(count);
  this->Integrals.resize(count);
  double sum[4] = { 0, 0, 0, 0 };
  for (std::size_t entry = 0; entry < count; ++entry)
  {
    const std::array<float, 3>& color = functions.color[entry];
    this->Values[entry] =
      Optical{ functions.extinction[entry] * unit, color[0], color[1], color[2] };
    const Optical weighted = this->Weigh(this->Values[entry]);
    const Optical before = entry > 0 ? this->Weigh(this->Values[entry - 1]) : weighted;
    for (int channel = 0; channel < 4; ++channel)
    {
      sum[channel] += entry > 0 ? 0.5 * (double(weighted[channel]) + before[channel]) : 0.0;
      this->Integrals[entry][channel] = static_cast<float>(sum[channel]);
    }
  }

  std::vector<float> level(count);
  std::transform(this->Values.begin(), this->Values.end(), level.begin(),
    [](const Optical& value) { return value[0]; });
  this->Maxima.push_back(level);
  for (std::size_t span = 1; 2 * span <= count; span *= 2)
  {
    std::vector<float> wider(count - 2 * span + 1);
    for (std::size_t i = 0; i < wider.size(); ++i)
    {
      wider[i] = std::max(this->Maxima.back()[i], this->Maxima.back()[i + span]);
    }
    this->Maxima.push_back(std::move(wider));
  }
}

float Classification::LargestBetween(float from, float to) const
{
  const int first = static_cast<int>(this->Inside(from));
  const int last = static_cast<int>(std::ceil(this->Inside(to)));
  const int count = last - first + 1;
  std::size_t level = 0;
  while ((2 << level) <= count)
  {
    ++level;
  }
  const std::vector<float>& maxima = this->Maxima[level];
  return std::max(
    maxima[std::size_t(first)], maxima[std::size_t(last + 1 - (1 << static_cast<int>(level)))]);
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Classification.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace limpid
{
namespace
{
void Require(const TransferFunctions& functions)
{
  const std::size_t count = functions.extinction.size();
  LIMPID_REQUIRE(count >= 2 && functions.color.size() == count,
    "The transfer functions have "
      << count << " extinctions and " << functions.color.size()
      << " colours (each entry needs both). Give two or more entries of each, in equal numbers.");
  LIMPID_REQUIRE(
    std::isfinite(functions.low) && functions.high > functions.low && std::isfinite(functions.high),
    "The transfer functions range from "
      << functions.low << " to " << functions.high
      << " (no scalar lies in this range). Give an ascending range.");
  for (const float value : functions.extinction)
  {
    LIMPID_REQUIRE(value >= 0 && std::isfinite(value),
      "The transfer function has the extinction "
        << value
        << " (the transmittance would be undefined or exceed 1). Keep it finite and not negative.");
  }
  for (const std::array<float, 3>& color : functions.color)
  {
    LIMPID_REQUIRE(std::isfinite(color[0]) && std::isfinite(color[1]) && std::isfinite(color[2]),
      "The transfer function has the colour (" << color[0] << ", " << color[1] << ", " << color[2]
                                               << ") (it cannot be displayed). Keep it finite.");
  }
}

/// Resamples functions to so many entries that differences within a few of them do not matter.
TransferFunctions Refined(const TransferFunctions& functions)
{
  constexpr std::size_t least = 1024;
  const std::size_t last = functions.extinction.size() - 1;
  const std::size_t parts = (least + last - 1) / last;
  if (parts == 1)
  {
    return functions;
  }
  TransferFunctions refined;
  refined.low = functions.low;
  refined.high = functions.high;
  for (std::size_t entry = 0; entry <= last * parts; ++entry)
  {
    const std::size_t before = std::min(entry / parts, last - 1);
    const float share = float(entry - before * parts) / float(parts);
    const auto at = [=](float here, float next) { return here + share * (next - here); };
    refined.extinction.push_back(
      at(functions.extinction[before], functions.extinction[before + 1]));
    const std::array<float, 3>& here = functions.color[before];
    const std::array<float, 3>& next = functions.color[before + 1];
    refined.color.push_back(
      { { at(here[0], next[0]), at(here[1], next[1]), at(here[2], next[2]) } });
  }
  return refined;
}
}

Classification::Classification(const TransferFunctions& given)
{
  Require(given);
  const TransferFunctions functions = Refined(given);
  const std::size_t count = functions.extinction.size();
  this->Axis = TableAxis(functions.low, functions.high, count);
  this->LargestExtinction =
    *std::max_element(functions.extinction.begin(), functions.extinction.end());
  this->HasOneExtinction = std::all_of(functions.extinction.begin(), functions.extinction.end(),
    [this](float value) { return value == this->LargestExtinction; });
  const float unit = this->LargestExtinction > 0 ? 1 / this->LargestExtinction : 0.0f;

  this->All.resize(count);
  double sum[4] = { 0, 0, 0, 0 };
  for (std::size_t entry = 0; entry < count; ++entry)
  {
    const std::array<float, 3>& color = functions.color[entry];
    OpticalEntry& here = this->All[entry];
    here.value = { { functions.extinction[entry] * unit, color[0], color[1], color[2] } };
    const FourFloats weighted = OpticalTable::Weighed(here.value);
    const FourFloats before =
      entry > 0 ? OpticalTable::Weighed(this->All[entry - 1].value) : weighted;
    for (int channel = 0; channel < 4; ++channel)
    {
      sum[channel] += entry > 0 ? 0.5 * (double(weighted[channel]) + before[channel]) : 0.0;
      here.integral[channel] = static_cast<float>(sum[channel]);
    }
  }

  std::transform(this->All.begin(), this->All.end(), std::back_inserter(this->Maxima),
    [](const OpticalEntry& entry) { return entry.value[0]; });
  for (std::size_t span = 1; 2 * span <= count; span *= 2)
  {
    const std::size_t level = this->Maxima.size() - count;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t other = std::min(i + span, count - 1);
      this->Maxima.push_back(std::max(this->Maxima[level + i], this->Maxima[level + other]));
    }
  }
}

OpticalTable Classification::Table() const
{
  OpticalTable table;
  table.axis = this->Axis;
  table.entries = this->All.data();
  table.maxima = this->Maxima.data();
  return table;
}
}

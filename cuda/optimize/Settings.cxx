// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Settings.h"

#include "math/Require.h"
#include "optimize/SettingsTable.h"

#include <cmath>

namespace limpid
{
namespace
{
/// Calls visit(number) for a value, or for each of several.
template <class Value, class Visitor>
void ForEachNumber(const Value& value, Visitor&& visit)
{
  visit(static_cast<double>(value));
}

template <class Value, std::size_t Count, class Visitor>
void ForEachNumber(const std::array<Value, Count>& values, Visitor&& visit)
{
  for (const Value value : values)
  {
    visit(static_cast<double>(value));
  }
}
}

void Settings::Require() const
{
  const auto require = [](const Valid& valid, double value)
  {
    LIMPID_REQUIRE(valid(value),
      "The " << valid.name << " is " << value << valid.unit << " ("
             << (std::isfinite(value) ? valid.why : "it is not a finite number") << "). "
             << valid.advice);
  };
  ForEachSetting([&](const Valid& valid, auto&& member)
    { ForEachNumber(member(*this), [&](double value) { require(valid, value); }); });
  LIMPID_REQUIRE(this->otherCameras.empty() || InfoOf(this->method).iterates,
    "Several cameras were given to "
      << InfoOf(this->method).name
      << " (this method supports one camera only). Use the method Optimized or one camera.");
}

std::vector<double> NumbersOf(const Settings& settings)
{
  std::vector<double> numbers;
  ForEachSetting([&](const Valid&, auto&& member)
    { ForEachNumber(member(settings), [&](double number) { numbers.push_back(number); }); });
  numbers.push_back(settings.scoreIterations);
  return numbers;
}

bool SeesWhatScoresAreOf(const Settings& settings)
{
  return InfoOf(settings.method).iterates && settings.weights.view > 0 &&
    settings.importanceSmoothing == ImportanceSmoothing::Off;
}

Settings ForCameras(Settings settings, const std::vector<Camera>& cameras)
{
  settings.otherCameras.assign(cameras.begin() + 1, cameras.end());
  return settings;
}

Progress PartOf(const Progress& all, double begin, double end)
{
  if (!all)
  {
    return {};
  }
  return [all, begin, end](double share, const std::string& text)
  { return all(begin + (end - begin) * share, text); };
}

bool operator==(const Settings& one, const Settings& other)
{
  return NumbersOf(one) == NumbersOf(other) && one.otherCameras == other.otherCameras;
}
}

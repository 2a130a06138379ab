// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the core makes from the table of settings holds for every one of them.

#include "optimize/SettingsTable.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <type_traits>

using namespace limpid;

namespace
{
/// Gives a setting a value; of several, to the last.
template <class Value>
void Assign(Value& setting, double value)
{
  setting = static_cast<Value>(value);
}

template <class Value, std::size_t Count>
void Assign(std::array<Value, Count>& setting, double value)
{
  setting.back() = static_cast<Value>(value);
}

template <class Value>
double NumberOf(const Value& setting)
{
  return static_cast<double>(setting);
}

template <class Value, std::size_t Count>
double NumberOf(const std::array<Value, Count>& setting)
{
  return setting.back();
}

/// The nearest number beyond an end that the setting can have.
template <class Value>
double Beyond(const Value&, double end, double direction)
{
  return std::nextafter(end, direction * Valid::infinity);
}

double Beyond(const int&, double end, double direction)
{
  return end + direction;
}

double Beyond(const std::array<int, 3>&, double end, double direction)
{
  return end + direction;
}

template <class Member>
std::string MessageFor(Member&& member, double value)
{
  Settings settings;
  Assign(member(settings), value);
  try
  {
    settings.Require();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}
}

TEST(SettingsTable, EverySettingMakesADifference)
{
  int count = 0;
  ForEachSetting(
    [&](const Valid&, auto&& member)
    {
      Settings settings;
      EXPECT_TRUE(settings == Settings());

      Assign(member(settings), NumberOf(member(settings)) == 0 ? 1 : 0);

      EXPECT_FALSE(settings == Settings()) << count;
      EXPECT_NE(NumbersOf(settings), NumbersOf(Settings())) << count;
      ++count;
    });

  EXPECT_GT(count, 25);
}

TEST(SettingsTable, WhatIsNoPropertyMakesADifferenceToo)
{
  Settings settings;
  settings.scoreIterations = true;
  EXPECT_FALSE(settings == Settings());
  EXPECT_NE(NumbersOf(settings), NumbersOf(Settings()));

  settings = ForCameras(Settings(), { Camera(), Camera() });
  EXPECT_FALSE(settings == Settings());
}

TEST(SettingsTable, EndsAreValidAsTheTableSays)
{
  const Settings settings;
  int count = 0;
  ForEachSetting(
    [&](const Valid& valid, auto&& member)
    {
      const auto check = [&](double end, bool has, double direction)
      {
        if (std::isfinite(end))
        {
          const double beyond = Beyond(member(settings), end, direction);
          EXPECT_EQ(MessageFor(member, end).empty(), has) << valid.name << " at " << end;
          EXPECT_NE(MessageFor(member, beyond), "") << valid.name << " beyond " << end;
          ++count;
        }
      };
      check(valid.least, valid.hasLeast, -1);
      check(valid.most, valid.hasMost, 1);
    });

  EXPECT_GT(count, 20);
}

TEST(SettingsTable, NumbersThatAreNoneAreInvalid)
{
  Settings settings;
  ForEachSetting(
    [&](const Valid& valid, auto&& member)
    {
      if (std::is_same_v<std::decay_t<decltype(member(settings))>, double>)
      {
        for (const double none : { std::nan(""), Valid::infinity, -Valid::infinity })
        {
          EXPECT_NE(MessageFor(member, none).find("it is not a finite number"), std::string::npos)
            << valid.name;
        }
      }
    });
}

TEST(SettingsTable, MessagesAreSentences)
{
  const auto rate = [](auto& settings) -> auto&
  {
    return settings.learningRate;
  };

  EXPECT_EQ(MessageFor(rate, 2),
    "The learning rate is 2 of the largest extinction (steps would leave the valid range or change "
    "nothing). Set it above 0 and at most 1.");
}

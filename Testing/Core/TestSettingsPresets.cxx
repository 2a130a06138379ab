// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Presets.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <string>

using namespace limpid;

TEST(SettingsPresets, PaperIsWhatTheCoreStartsWith)
{
  Settings paper;
  Take(PresetNamed("Keep Context"), paper);
  Take(PresetNamed("Paper"), paper);

  EXPECT_TRUE(paper == Settings());
}

TEST(SettingsPresets, AreValidAndDifferFromEachOther)
{
  for (const SettingsPreset& one : settingsPresets)
  {
    Settings settings;
    Take(one, settings);
    EXPECT_NO_THROW(settings.Require()) << one.name;
    for (const SettingsPreset& other : settingsPresets)
    {
      Settings others;
      Take(other, others);
      EXPECT_EQ(settings == others, &one == &other) << one.name << ", " << other.name;
    }
  }
}

TEST(SettingsPresets, AreFoundByNameInCapitalLettersOrNot)
{
  EXPECT_EQ(&PresetNamed("strong reveal"), &PresetNamed("Strong Reveal"));
  EXPECT_EQ(&PresetNamed("DEFAULT"), &defaultPreset);
}

TEST(SettingsPresets, AnUnknownNameIsAnsweredWithAllOfThem)
{
  try
  {
    PresetNamed("Nonsense");
    FAIL();
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find("\"Nonsense\""), std::string::npos) << message;
    EXPECT_NE(message.find("Default, Keep Context, Strong Reveal, Paper."), std::string::npos);
  }
}

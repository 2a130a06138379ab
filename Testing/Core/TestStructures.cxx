// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "math/Require.h"
#include "scene/Structures.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace limpid;

namespace
{
std::string MessageFor(const std::vector<Structure>& all)
{
  try
  {
    const Structures structures(all);
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

std::string MessageFor(const char* label, const char* importance, const char* target)
{
  try
  {
    ParseStructure(label, "name", importance, target);
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

void ExpectIn(const std::string& words, const std::string& message)
{
  EXPECT_NE(message.find(words), std::string::npos) << message;
}
}

TEST(Structures, AreFoundByTheirLabels)
{
  const Structures structures(
    { { 3, "tumour", 1, 0.95 }, { 65535, "vessels", 0.25, {} }, { -7, "", 0.5, {} } });

  EXPECT_EQ(structures.Count(), 3u);
  EXPECT_EQ(structures.RowOf(3), 1);
  EXPECT_EQ(structures.RowOf(65535), 2);
  EXPECT_EQ(structures.RowOf(-7), 3);
  for (const int other : { 0, 1, 2, 4, 1034 })
  {
    EXPECT_EQ(structures.RowOf(other), 0) << other;
  }
  EXPECT_EQ(structures.ImportanceOf(0), 0.0);
  EXPECT_EQ(structures.ImportanceOf(2), 0.25);
  EXPECT_EQ(structures.At(3).NameOrLabel(), "-7");
}

TEST(Structures, OfAnyLabelAreAllButZero)
{
  const Structures structures = Structures::AnyLabel();

  EXPECT_EQ(structures.RowOf(0), 0);
  for (const int label : { -1, 1, 104, 65536 })
  {
    EXPECT_EQ(structures.ImportanceOf(structures.RowOf(label)), 1.0) << label;
  }
}

TEST(Structures, AreRefusedIfTheyCannotBeToldApart)
{
  ExpectIn("Two structures have the label 3", MessageFor({ { 3, "a", 1, {} }, { 3, "b", 1, {} } }));
  ExpectIn(
    "Two structures have the name \"a\"", MessageFor({ { 3, "a", 1, {} }, { 4, "a", 1, {} } }));
  ExpectIn(
    "Two structures have the name \"4\"", MessageFor({ { 3, "4", 1, {} }, { 4, "", 1, {} } }));
}

TEST(Structures, HaveShares)
{
  ExpectIn("The importance of the structure \"a\" is 1.5", MessageFor({ { 3, "a", 1.5, {} } }));
  ExpectIn("The target of the structure \"a\" is -0.5", MessageFor({ { 3, "a", 1, -0.5 } }));
  EXPECT_EQ(MessageFor({ { 3, "a", 0, 1.0 } }), "");
}

TEST(Structures, AreReadFromTexts)
{
  const Structure structure = ParseStructure(" 1034", "ctx-lh", "0.25", "9e-1 ");

  EXPECT_EQ(structure.label, 1034);
  EXPECT_EQ(structure.name, "ctx-lh");
  EXPECT_EQ(structure.importance, 0.25);
  EXPECT_EQ(structure.target, 0.9);
  EXPECT_FALSE(ParseStructure("-1", "", "1", " ").target.has_value());
}

TEST(Structures, AreRefusedIfTextsAreNoNumbers)
{
  for (const char* label : { "", "liver", "1.5", "1 2", "99999999999999999999" })
  {
    ExpectIn("has the label \"" + std::string(label) + "\"", MessageFor(label, "1", ""));
  }
  ExpectIn("The importance of the structure \"name\" is \"high\"", MessageFor("1", "high", ""));
  ExpectIn("The importance of the structure \"name\" is \"\"", MessageFor("1", "", ""));
  ExpectIn("The target of the structure \"name\" is \"95 %\"", MessageFor("1", "1", "95 %"));
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MethodScenes.h"

#include "methods/RayObject.h"

#include <gtest/gtest.h>

using namespace limpid;

TEST(Viola2004, ClearsWhatIsInFrontOfTheObjectAndNothingElse)
{
  BoxScene scene = TwoSlabs(32);

  const Shown shown = ShownBy(Method::Viola2004, scene);

  scene.ForEachNode(
    [&](std::size_t node, int, int, int k)
    {
      const double z = -1 + k / 16.0;
      if (z < 0.1)
      {
        EXPECT_EQ(shown.extinction[node], 0.0f);
      }
      else if (z > 0.4)
      {
        EXPECT_EQ(shown.extinction[node], scene.extinction[node]);
      }
    });
}

TEST(Viola2004, ClipsNothingWhereThereIsNoObject)
{
  BoxScene scene = TwoSlabs(32);
  for (float& value : scene.importance)
  {
    value *= 0.49f;
  }

  EXPECT_EQ(ShownBy(Method::Viola2004, scene).extinction, scene.extinction);
}

TEST(RayObject, IsTheMostImportantOneFromItsBorderOn)
{
  RayObject object;
  const float importance[] = { 0, 0.6f, 0.2f, 0.25f, 0.75f, 1.0f, 0, 0.9f };
  for (int i = 0; i < 8; ++i)
  {
    object.Meet(static_cast<float>(i), importance[i]);
  }

  EXPECT_EQ(object.most, 1.0f);
  EXPECT_EQ(object.begin, 3.5f); // half way from 0.25 to 0.75
}

TEST(RayObject, IsTheForemostOfEqualOnes)
{
  RayObject object;
  for (const float at : { 0.0f, 1.0f, 2.0f, 3.0f, 4.0f })
  {
    object.Meet(at, static_cast<int>(at) % 2 == 1 ? 0.8f : 0.2f);
  }

  EXPECT_EQ(object.begin, 0.5f);
}

TEST(RayObject, ClipsNothingWhereTheRayBeginsInsideIt)
{
  RayObject object;
  object.Meet(2, 0.9f);
  object.Meet(3, 0.1f);

  EXPECT_EQ(object.begin, RayObject::everything);
}

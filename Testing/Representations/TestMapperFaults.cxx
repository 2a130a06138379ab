// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every allocation of a field that the mapper's own code makes fails once: no exception leaves the
// renderer, there is one error at most, and the next frame is right.

#include "FailingAllocations.h"
#include "OneOf.h"
#include "SmallWindow.h"

#include "vtkAutoInit.h"

#include <gtest/gtest.h>

#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

using namespace limpid;

namespace
{
/// VTK's small objects may end up half made where their memory fails.
constexpr FailingAllocations::Scope ownFields{ "vtkLimpidRendering", 1024 };

void ExpectToSurvive(SmallWindow& scene)
{
  const std::vector<unsigned char> expected = scene.Picture();
  ASSERT_GT(scene.mapper->GetVisibilityScore(), 0);
  ASSERT_EQ(scene.errors, 0);
  int failures = 0;
  bool failed = true;
  for (std::int64_t number = 1; failed; number += OneOf())
  {
    scene.Forget();
    {
      const FailingAllocations failing(number, FailingAllocations::Which::One, ownFields);
      ASSERT_NO_THROW(scene.window->Render());
      failed = failing.Failed();
    }
    ASSERT_LE(scene.errors, failed ? 1 : 0) << "allocation " << number;
    failures += failed ? 1 : 0;
    scene.Forget();
    ASSERT_EQ(scene.Picture(), expected) << "after allocation " << number;
    ASSERT_EQ(scene.errors, 0) << "after allocation " << number;
  }
  EXPECT_GT(failures * OneOf(), 20);
}
}

TEST(MapperFaults, OfAFrame)
{
  SmallWindow scene;
  ExpectToSurvive(scene);
}

TEST(MapperFaults, OfAFrameThatIsPeeled)
{
  SmallWindow scene;
  scene.Peel();
  ExpectToSurvive(scene);
}

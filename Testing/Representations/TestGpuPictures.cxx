// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A GPU that fails at each thing that it is told to do while the mapper draws: a pretended one.

#include "SmallWindow.h"

#include "FailingGpu.h"

#include "vtkAutoInit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

using namespace limpid;

namespace
{
void Take(SmallWindow& scene, int backend)
{
  scene.mapper->GetVisibilitySettings()->SetBackend(backend);
  scene.Forget();
}

/// The largest difference of two pictures, in steps of 255.
int Difference(const std::vector<unsigned char>& one, const std::vector<unsigned char>& other)
{
  int largest = 0;
  for (std::size_t n = 0; n < one.size(); ++n)
  {
    largest = std::max(largest, std::abs(int(one[n]) - int(other[n])));
  }
  return largest;
}

// Sums of the solvers are added in another order on a GPU, and pictures are rounded.
constexpr int oneStep = 1;

/// How the GPU fails.
struct Failing
{
  Index oneIn; ///< of what it is told to do is tried to fail
  bool forGood;
};

void ExpectTheProcessorsPicture(SmallWindow& scene, const Failing& how)
{
  Take(scene, vtkVisibilitySettings::CPU);
  const std::vector<unsigned char> truth = scene.Picture();
  ASSERT_GT(scene.mapper->GetVisibilityScore(), 0);
  bool failed = true;
  int withWarning = 0;
  for (Index operation = 0; failed; operation += how.oneIn)
  {
    Take(scene, vtkVisibilitySettings::CPU); // after that, what has failed may be tried again
    scene.Picture();
    Take(scene, vtkVisibilitySettings::AUTO);
    const std::size_t before = Gpu().Bytes();
    {
      const FailingGpu failing(operation, how.forGood);
      ASSERT_LE(Difference(scene.Picture(), truth), oneStep) << "operation " << operation;
      failed = Gpu().HasFailed();
    }
    scene.mapper->Reset(); // else the picture that is kept would be shown
    ASSERT_LE(Difference(scene.Picture(), truth), oneStep) << "after operation " << operation;
    EXPECT_EQ(scene.errors, 0) << "operation " << operation;
    ASSERT_LE(scene.warnings.size(), failed ? 1u : 0u) << scene.warnings.back();
    if (!scene.warnings.empty())
    {
      EXPECT_NE(scene.warnings[0].find("The simulated GPU fails"), std::string::npos);
      EXPECT_NE(scene.warnings[0].find("the CPU draws the volume"), std::string::npos);
      ++withWarning;
    }
    scene.mapper->ReleaseMemory();
    ASSERT_EQ(Gpu().Bytes(), before) << "something is left after operation " << operation;
  }
  EXPECT_GT(withWarning * how.oneIn, 5); // of all operations, by those that were tried
}
}

class GpuPictures : public ::testing::TestWithParam<Failing>
{
};

TEST_P(GpuPictures, AreThoseOfTheProcessorWhereItFails)
{
  SmallWindow scene;
  ExpectTheProcessorsPicture(scene, GetParam());
}

TEST_P(GpuPictures, AreThoseOfTheProcessorWhereItFailsInParts)
{
  SmallWindow scene;
  scene.Peel();
  ExpectTheProcessorsPicture(scene, GetParam());
}

// It is asked for by name: the error is told, and there is a picture.
TEST_P(GpuPictures, AreMadeWhereCudaWasAskedFor)
{
  SmallWindow scene;
  for (const Index operation : { 0, 9, 40, 90 })
  {
    Take(scene, vtkVisibilitySettings::CPU);
    scene.Picture();
    Take(scene, vtkVisibilitySettings::CUDA);
    const FailingGpu failing(operation, GetParam().forGood);
    scene.Picture();
    ASSERT_TRUE(Gpu().HasFailed());
    EXPECT_GE(scene.errors + int(scene.warnings.size()), 1) << "operation " << operation;
  }
}

const auto nameOf = [](const auto& how) { return how.param.forGood ? "ForGood" : "Once"; };
INSTANTIATE_TEST_SUITE_P(
  Quick, GpuPictures, ::testing::Values(Failing{ 47, false }, Failing{ 47, true }), nameOf);
INSTANTIATE_TEST_SUITE_P(
  Long, GpuPictures, ::testing::Values(Failing{ 1, false }, Failing{ 1, true }), nameOf);

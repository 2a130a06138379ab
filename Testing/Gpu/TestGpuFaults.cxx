// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A GPU that fails at each thing that it is told to do, in turn: a pretended one.

#include "BoxScene.h"
#include "FailingGpu.h"

#include "math/Require.h"
#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace limpid;

namespace
{
BoxScene SmallScene(BackendKind backend)
{
  BoxScene scene = BoxScene::Cube(12);
  scene.FillOnion();
  scene.settings.maximumIterations = 3; // the others do the same operations again
  scene.settings.backend = backend;
  return scene;
}

/// What a user asks a solver for.
struct Outcome
{
  std::vector<float> extinction;
  std::vector<float> transmittance;
  Score base;
  Score best;
  int iterations = 0;
  std::string backend;

  explicit Outcome(const BoxScene& scene)
    : transmittance(scene.extinction.size())
  {
    Solver solver(scene.Fields(), scene.camera, scene.light, scene.settings);
    solver.Run();
    this->base = solver.BaseScore();
    this->best = solver.BestScore();
    solver.Transmittance(this->transmittance.data());
    this->extinction = solver.Extinction();
    this->iterations = solver.Iterations();
    this->backend = solver.BackendName();
  }
};
}

class GpuFaults : public ::testing::TestWithParam<bool>
{
};

TEST_P(GpuFaults, LeaveTheProcessorItsOwnResult)
{
  const Outcome truth(SmallScene(BackendKind::Cpu));
  const std::size_t before = Gpu().Bytes();
  bool failed = true;
  int operations = 0;
  for (Index operation = 0; failed; operation += operation < 100 ? 1 : 23) // steps are alike
  {
    const FailingGpu gpu(operation, GetParam());
    const Outcome found(SmallScene(BackendKind::Auto));
    failed = Gpu().HasFailed();
    if (failed)
    {
      ++operations;
      ASSERT_EQ(found.extinction, truth.extinction) << "operation " << operation;
      ASSERT_EQ(found.transmittance, truth.transmittance) << "operation " << operation;
      // It may have been told before the failure, by sums in another order.
      ASSERT_NEAR(found.best.visibility, truth.best.visibility, 1e-5 * truth.best.visibility);
      ASSERT_EQ(found.iterations, truth.iterations);
      ASSERT_NE(found.backend.find("no CUDA: The simulated GPU fails"), std::string::npos)
        << found.backend;
      ASSERT_EQ(found.backend.find('\n'), std::string::npos);
    }
    ASSERT_EQ(Gpu().Bytes(), before) << "something is left after operation " << operation;
  }
  EXPECT_GT(operations, 50);
}

TEST_P(GpuFaults, AreToldWhereCudaWasAskedFor)
{
  const std::size_t before = Gpu().Bytes();
  for (const Index operation : { 0, 3, 17, 40, 60 })
  {
    const FailingGpu gpu(operation, GetParam());
    EXPECT_THROW(Outcome(SmallScene(BackendKind::Cuda)), DeviceError) << operation;
    EXPECT_EQ(Gpu().Bytes(), before) << operation;
  }
  EXPECT_FALSE(Outcome(SmallScene(BackendKind::Cuda)).extinction.empty()) << "it works again";
}

TEST_P(GpuFaults, LeavePreviewsAndWhatIsShown)
{
  const auto show = [](BackendKind backend)
  {
    const BoxScene scene = SmallScene(backend);
    Progressive progressive(scene.Fields(), scene.settings);
    progressive.SetView(scene.camera, scene.light, scene.settings);
    progressive.Preview(10);
    std::vector<double> shown{ progressive.BaseScore().visibility,
      progressive.BestScore().visibility };
    while (!progressive.Refine())
    {
    }
    shown.push_back(progressive.BestScore().visibility);
    Camera other = scene.camera;
    other.position = other.position + Vec3(0.1, 0.2, 0.0);
    shown.push_back(progressive.ScoresFrom(other).best.visibility);
    shown.insert(shown.end(), progressive.Extinction(),
      progressive.Extinction() + progressive.ShownGrid().NodeCount());
    return shown;
  };
  const std::vector<double> truth = show(BackendKind::Cpu);
  bool failed = true;
  for (Index operation = 0; failed; operation += operation < 100 ? 7 : 61)
  {
    const FailingGpu gpu(operation, GetParam());
    const std::vector<double> found = show(BackendKind::Auto);
    failed = Gpu().HasFailed();
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t n = 0; n < truth.size(); ++n)
    {
      ASSERT_NEAR(found[n], truth[n], 1e-3 * std::abs(truth[n])) << operation;
    }
  }
}

// A reference that only the GPU had may be lost, but not the next frame.
TEST_P(GpuFaults, LeaveTheNextFrame)
{
  BoxScene scene = SmallScene(BackendKind::Auto);
  scene.settings.temporalCoherence = 0.2;
  const auto show = [&scene](Progressive& progressive)
  {
    progressive.SetView(scene.camera, scene.light, scene.settings);
    while (!progressive.Refine())
    {
    }
    return progressive.BestScore().visibility;
  };
  const auto move = [&scene](double by) { scene.camera.position.x += by; };
  double truth = 0;
  bool failed = true;
  for (Index operation = -1; failed || operation < 1; operation += operation < 100 ? 3 : 41)
  {
    Progressive progressive(scene.Fields(), scene.settings);
    show(progressive);
    move(0.1);
    const FailingGpu gpu(operation, GetParam());
    const double visibility = show(progressive);
    move(-0.1);
    failed = Gpu().HasFailed();
    truth = operation < 0 ? visibility : truth;
    ASSERT_NEAR(visibility, truth, 0.02 * truth) << "operation " << operation;
    const float* extinction = progressive.Extinction();
    for (Index node = 0; node < scene.grid.NodeCount(); ++node)
    {
      ASSERT_GE(extinction[node], 0) << "operation " << operation;
    }
  }
  EXPECT_GT(truth, 0);
}

INSTANTIATE_TEST_SUITE_P(OnceAndForGood, GpuFaults, ::testing::Values(false, true),
  [](const auto& forGood) { return forGood.param ? "ForGood" : "Once"; });

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What frames of the display bring from a GPU to the host: sums, but no field. The processor
// pretends to be the GPU.

#include "BoxScene.h"
#include "FailingGpu.h"

#include "backend/LaunchTimes.h"
#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

using namespace limpid;

namespace
{
/// A scene of the display.
struct DisplayedScene
{
  const char* name;
  int nodes;           ///< along each axis
  double opticalDepth; ///< see BoxScene::FillOnion
  Method method = Method::Optimized;
  double coherence = 0; ///< Settings::temporalCoherence
};

void PrintTo(const DisplayedScene& scene, std::ostream* stream)
{
  *stream << scene.name;
}

/// Returns how many bytes are copied meanwhile. `label`: "download" or "upload".
double BytesDuring(const char* label, const std::function<void()>& work)
{
  LaunchTimes times;
  Gpu().Time(&times);
  work();
  Gpu().Time(nullptr);
  double bytes = 0;
  for (const LaunchTimes::Entry& entry : times.Entries())
  {
    bytes += entry.label == label ? entry.bytes : 0.0;
  }
  return bytes;
}

class FramesOnGpu : public ::testing::TestWithParam<DisplayedScene>
{
public:
  FramesOnGpu()
    : Scene(BoxScene::Cube(GetParam().nodes))
  {
    this->Scene.FillOnion(GetParam().opticalDepth);
    this->Scene.settings.method = GetParam().method;
    this->Scene.settings.temporalCoherence = GetParam().coherence;
    this->Scene.settings.backend = BackendKind::Cuda;
  }

protected:
  /// An iteration and its score bring sums, less than a kilobyte. The first and last scores of a
  /// frame take less than four.
  static double MostBytes(const Progressive& progressive)
  {
    return 1024.0 * (progressive.Iterations() + 4);
  }

  double FieldBytes() const { return 4.0 * double(this->Scene.grid.NodeCount()); }

  /// Shows the next frame after the camera has moved: refines until that is done.
  void Show(Progressive& progressive)
  {
    this->Scene.camera.position.x += 0.1;
    progressive.SetView(this->Scene.camera, this->Scene.light, this->Scene.settings);
    progressive.ShowNoLessThanBase();
    while (!progressive.Refine())
    {
      progressive.ShowNoLessThanBase();
    }
    progressive.ShowNoLessThanBase();
    EXPECT_NE(progressive.OnDevice().light, nullptr);
    EXPECT_GT(progressive.BestScore().visibility, 0);
  }

  BoxScene Scene;
};
}

TEST_P(FramesOnGpu, BringNoFieldToTheHost)
{
  Progressive progressive(this->Scene.Fields(), this->Scene.settings);
  this->Show(progressive); // allocates

  const double down = BytesDuring("download", [&] { this->Show(progressive); });

  EXPECT_LT(down, this->MostBytes(progressive));
  EXPECT_LT(this->MostBytes(progressive), 0.5 * this->FieldBytes())
    << "one field would not be noticed";
}

// What goes there are outlines of plans (PlanOutline.h), which grow with the length of an edge.
TEST_P(FramesOnGpu, SendNoFieldToTheGpu)
{
  Progressive progressive(this->Scene.Fields(), this->Scene.settings);
  this->Show(progressive); // allocates

  EXPECT_LT(BytesDuring("upload", [&] { this->Show(progressive); }), 0.5 * this->FieldBytes());
}

INSTANTIATE_TEST_SUITE_P(Scenes, FramesOnGpu,
  ::testing::Values(DisplayedScene{ "Thin", 64, 10 }, DisplayedScene{ "ThinAndSmall", 40, 4 },
    DisplayedScene{ "Thick", 48, 100 }, DisplayedScene{ "ThickAndSmall", 32, 200 },
    DisplayedScene{ "Coherent", 64, 10, Method::Optimized, 0.2 },
    DisplayedScene{ "Viola2004", 48, 20, Method::Viola2004 },
    DisplayedScene{ "Ament2017", 48, 20, Method::Ament2017 }),
  [](const auto& tested) { return std::string(tested.param.name); });

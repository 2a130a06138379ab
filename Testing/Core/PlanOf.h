// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_test_PlanOf_h
#define limpid_test_PlanOf_h

#include "PlanSweep.h"
#include "RaySources.h"
#include "SimulatedDevice.h"

#include "sweep/FrustumRays.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace limpid
{
/// Some boxes of extinction in the air, some of them important.
struct Boxes
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;

  explicit Boxes(const Int3& nodes)
  {
    this->grid.nodes = nodes;
    this->extinction.assign(std::size_t(this->grid.NodeCount()), 0.0f);
    this->importance.assign(std::size_t(this->grid.NodeCount()), 0.0f);
    std::size_t node = 0;
    for (int k = 0; k < nodes.z; ++k)
    {
      for (int j = 0; j < nodes.y; ++j)
      {
        for (int i = 0; i < nodes.x; ++i, ++node)
        {
          const bool box = i % 9 < 2 && (j + i) % 11 < 3 && k % 7 < 2;
          this->extinction[node] = box ? 1.0f : 0.0f;
          this->importance[node] = box && i > nodes.x / 2 && k % 14 < 7 ? 1.0f : 0.0f;
        }
      }
    }
  }

  Occupancy MakeOccupancy() const
  {
    return Occupancy(this->grid, this->extinction.data(), this->importance.data(), true);
  }
};

struct Viewing
{
  const char* name;
  RaySource eye;
  double rayDensity = 1;
  RayPlacement placement = RayPlacement::ForIntegrals;
};

inline std::ostream& operator<<(std::ostream& stream, const Viewing& viewing)
{
  return stream << viewing.name;
}

inline const Int3 planNodes(31, 24, 27);

inline const Viewing viewings[] = {
  { "Oblique", PointAt(Vec3(60, -35, -50)) },
  { "OnTheAxis", PointAt(Vec3(15, 11.5, -40)) },
  { "InFrontOfAFace", PointAt(Vec3(9.3, 8.1, -0.3)), 2.3 },
  { "OnAFace", PointAt(Vec3(0, 8.1, 11)) },
  { "Inside", PointAt(Vec3(9.3, 11.9, 14.2)), 1.7 },
  { "OnAVoxel", PointAt(Vec3(9, 11, 14)), 1, RayPlacement::ForNodes },
  { "FarAway", PointAt(Vec3(3e7, 2e7, -4e7)) },
  { "FewRays", PointAt(Vec3(-30, 60, 13)), 0.2 },
  { "Parallel", Parallel(Vec3(0.4, -0.3, 0.9)) },
  { "ParallelAlongTheAxis", Parallel(Vec3(0, 1, 0)), 1, RayPlacement::ForNodes },
  { "ParallelAlongTheDiagonal", Parallel(Vec3(-1, 1, -1)), 3, RayPlacement::ForNodes },
};

/// Plans of a sparse scene from many places; instantiated in TestPlanSweep.cxx.
class PlanOf : public ::testing::TestWithParam<Viewing>
{
protected:
  PlanOf()
    : scene(planNodes)
    , frusta(PlanSweep(this->scene.grid, this->scene.MakeOccupancy(), GetParam().eye,
        { GetParam().rayDensity, GetParam().placement }))
  {
  }

  std::vector<FrustumRays<SimulatedDevice>> MoveToDevice() const
  {
    return PlanRays(SimulatedDevice::Shared(), this->scene.grid, this->scene.MakeOccupancy(),
      GetParam().eye, { GetParam().rayDensity, GetParam().placement });
  }

  Boxes scene;
  std::vector<PlannedFrustum> frusta;
};

}

#endif

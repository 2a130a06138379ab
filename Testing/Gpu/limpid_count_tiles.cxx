// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which tiles the sweeps of a GPU visit, which of them have work, and what shadows write.
//
//   limpid_count_tiles [--sizes 256] [--scenes onion] [--files A.scene.json,B.scene.json]
//     [--output FILE.json]
//
// The lists are those that a GPU would read, made with the processor in the role of a GPU.

#include "SimulatedDevice.h"

#include "Program.h"
#include "SceneForSolver.h"
#include "Volume.h"

#include "backend/ComputeBackend.h"
#include "energy/GradientKernel.h"
#include "energy/TransmittanceKernel.h"
#include "energy/TransmittanceSweep.h"
#include "optimize/PreparedScene.h"
#include "sweep/SlabImages.h"
#include "sweep/Sweeps.h"

#include <algorithm>
#include <iostream>

namespace limpid::benchmark
{
namespace
{
/// Numbers of tiles in all phases of a sweep.
struct Tiles
{
  double all = 0;     ///< tiles that the sweep would visit without lists
  double visited = 0; ///< tiles in the lists
  double active = 0;  ///< of these, tiles with at least one ray or voxel that has something to do

  Json AsJson() const
  {
    return { { "all", this->all }, { "visited", this->visited }, { "active", this->active } };
  }

  /// Calls visit(tile number, phase) for all tiles of some lists; it returns whether one is active.
  template <class Visit>
  void Add(const PhasesOfTiles& lists, double tiles, double phases, const Visit& visit)
  {
    this->all += tiles * phases;
    for (int i = 0; i < *lists.phaseCount; ++i)
    {
      const PhaseOfTiles& phase = lists.phases[i];
      this->visited += phase.count;
      for (int n = 0; n < phase.count; ++n)
      {
        this->active += visit(lists.numbers[phase.first + n], phase.number) ? 1 : 0;
      }
    }
  }
};

using Rays = FrustumRays<SimulatedDevice>;

/// Tiles of the policy's sweep: rays that meet something in the layer behind the slice, and voxels
/// of the slice behind that change.
void AddPolicy(Rays& rays, Tiles& tiles)
{
  const FaceFrustum& plan = rays.Plan();
  const VoxelsOfTiles voxels = rays.Tiles().Found();
  tiles.Add(rays.Tiles().Lists(), voxels.tiles.Count(), TileHasWork::PhasesOf(plan),
    [&](int number, int phase)
    {
      const int s = plan.lastSlice - phase;
      const bool moves = s >= plan.firstNodeSlice &&
        AnyRayIsActive(
          plan, { s, s + 1 }, voxels.tiles.ColumnsOf(number), voxels.tiles.RowsOf(number));
      return moves ||
        (s + 1 <= plan.lastSlice &&
          AnyVoxelIsActive(
            plan, s + 1, voxels.AlongU(s + 1, number), voxels.AlongV(s + 1, number)));
    });
}

/// Tiles of a derivative's sweep.
void AddDerivative(Rays& rays, Tiles& tiles)
{
  using Images = detail::SlabImages<GradientKernel<const float*, float*, Kept::Ignored>>;
  const FaceFrustum& plan = rays.Plan();
  const int slices = Images::SlicesFor(plan.RayCount());
  const SlabLayout<SlabsFromBack> layout(plan, slices);
  tiles.Add(rays.SlabsFromBack(slices).Lists(), layout.TileCount(), layout.PhaseCount(),
    [&](int number, int phase)
    {
      const SlabTile tile = layout.TileAt(phase, number);
      return tile.hasRays ? AnyRayIsActive(plan, layout.SlabOf(tile.place), tile.columns, tile.rows)
                          : AnyVoxelIsActive(plan, tile.place, tile.columns, tile.rows);
    });
}

/// Whether any voxel of a tile has a transmittance below 1.
bool IsDimmed(const FaceFrustum& plan, const SlabTile& tile, const float* transmittance)
{
  const int node = plan.SliceAt(tile.place).node;
  for (int v = tile.rows.begin; v < tile.rows.end; ++v)
  {
    for (int u = tile.columns.begin; u < tile.columns.end; ++u)
    {
      if (transmittance[plan.VoxelAt(node, u, v)] < 1)
      {
        return true;
      }
    }
  }
  return false;
}

/// For every slab of a front-to-back sweep and every row of rays: the columns between which rays
/// have met anything before the end of the slab.
std::vector<Range<int>> FindMet(const SlabLayout<SlabsFromFront>& layout, const FaceFrustum& plan)
{
  std::vector<Range<int>> met;
  std::vector<Range<int>> now(std::size_t(plan.rows));
  for (int slab = 0; slab < layout.slabs; ++slab)
  {
    const Range<int> slices = layout.SlabOf(slab);
    for (int s = slices.begin; s < slices.end && s < plan.lastSlice; ++s)
    {
      for (int row = 0; row < plan.rows; ++row)
      {
        Range<int>& columns = now[std::size_t(row)];
        columns = Hull(columns, plan.ActiveRays(s, row));
      }
    }
    met.insert(met.end(), now.begin(), now.end());
  }
  return met;
}

/// Whether the density of any ray of a tile changes from slice to slice: of those near the sides
/// that have met anything. `met`: by row.
bool ChangesDensity(const FaceFrustum& plan, const SlabTile& tile, const Range<int>* met)
{
  for (int row = tile.rows.begin; row < tile.rows.end; ++row)
  {
    const Range<int> columns = Intersection(tile.columns, met[row]);
    for (int column = columns.begin; column < columns.end; ++column)
    {
      if (plan.IsNearSides(column, row))
      {
        return true;
      }
    }
  }
  return false;
}

/// Tiles of the shadows, and the bytes that they write, without the result itself. `extinction`:
/// what casts them; `exact`: the plan for this extinction alone.
double AddShadows(Rays& rays, const FaceFrustum& exact,
  const FieldBlocks<SimulatedDevice>& extinction, const float* transmittance, Tiles& tiles)
{
  using Images = detail::SlabImages<TransmittanceKernel<const float*, float*>>;
  const FaceFrustum& plan = rays.Plan();
  const int slices = Images::SlicesFor(plan.RayCount());
  const SlabLayout<SlabsFromFront> layout(plan, slices);
  const std::vector<Range<int>> met = FindMet(layout, exact);
  // At the start, all images and the depth of each ray.
  double bytes = double(plan.RayCount()) * (sizeof(double) + 2.0 * slices * 2 * sizeof(float));
  const auto lists =
    ListSlabsFromFront(SimulatedDevice::Shared(), plan, slices, extinction.Blocks());
  tiles.Add(lists.Lists(), layout.TileCount(), layout.PhaseCount(),
    [&](int number, int phase)
    {
      const SlabTile tile = layout.TileAt(phase, number);
      const double lanes = double(tile.columns.Length()) * tile.rows.Length();
      if (!tile.hasRays)
      {
        bytes += lanes * sizeof(float);
        return IsDimmed(plan, tile, transmittance);
      }
      const Range<int> slab = layout.SlabOf(tile.place);
      double nearSides = 0;
      for (int row = tile.rows.begin; row < tile.rows.end; ++row)
      {
        for (int column = tile.columns.begin; column < tile.columns.end; ++column)
        {
          nearSides += plan.IsNearSides(column, row) ? 1 : 0;
        }
      }
      bytes += lanes * sizeof(double) + (lanes + nearSides) * slab.Length() * sizeof(float);
      return AnyRayIsActive(exact, slab, tile.columns, tile.rows) ||
        ChangesDensity(plan, tile, &met[std::size_t(tile.place) * std::size_t(plan.rows)]);
    });
  return bytes;
}

Json CountScene(const SceneForSolver& scene)
{
  const std::shared_ptr<SimulatedDevice> device = SimulatedDevice::Shared();
  PreparedScene values(scene.Fields());
  const Problem problem = values.ProblemFor(scene.camera, scene.light, Settings());
  const auto plan = [&](const RaySource& source)
  {
    return PlanRays(device, problem.grid, *problem.occupancy, source,
      { problem.settings.rayDensity, RayPlacement::ForIntegrals });
  };
  Tiles policy;
  Tiles derivative;
  for (Rays& rays : plan(problem.Camera()))
  {
    AddPolicy(rays, policy);
  }
  for (Rays& rays : plan(problem.Light()))
  {
    AddDerivative(rays, derivative);
  }
  const std::vector<float> base(
    problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
  std::vector<float> transmittance(base.size());
  FillTransmittance(
    problem.grid, base.data(), problem.Light(), problem.settings.rayDensity, transmittance.data());
  Tiles shadows;
  double bytes = double(base.size()) * sizeof(float); // set to 1 first
  const auto planFor = [&](bool skip)
  {
    return PlanRays(device, problem.grid, Occupancy(problem.grid, base.data(), base.data(), skip),
      problem.Light(), { transmittanceRayDensity, RayPlacement::ForNodes });
  };
  const FieldBlocks<SimulatedDevice> blocks(device, problem.grid.nodes, base.data());
  std::vector<Rays> frusta = planFor(false); // see ShadowVolume
  std::vector<Rays> exact = planFor(true);
  for (std::size_t n = 0; n < frusta.size(); ++n)
  {
    bytes += AddShadows(frusta[n], exact[n].Plan(), blocks, transmittance.data(), shadows);
  }
  const Int3& nodes = problem.grid.nodes;
  return { { "scene", scene.name }, { "nodes", { nodes.x, nodes.y, nodes.z } },
    { "policy sweep", policy.AsJson() }, { "derivative", derivative.AsJson() },
    { "transmittance", shadows.AsJson() }, { "shadows_written", bytes } };
}
}
}

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  return RunProgram(argc, argv, { { "sizes", "256" }, { "scenes", "onion" }, { "files", "" } },
    [](const Options& options, Json& results, const std::function<void()>& save)
    {
      results["scenes"] = Json::array();
      const auto count = [&](const SceneForSolver& scene)
      {
        std::cerr << scene.name << std::endl;
        results["scenes"].push_back(CountScene(scene));
        save();
      };
      for (const std::string& filling : options.List("scenes"))
      {
        for (const std::string& size : options.List("sizes"))
        {
          count(MakeVolume(filling, std::stoi(size)));
        }
      }
      for (const std::string& file : options.List("files"))
      {
        count(SceneOfFile(file));
      }
    });
}

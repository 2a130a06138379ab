// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/MeetTargets.h"

#include "backend/Backend.h"
#include "math/PercentText.h"
#include "optimize/TargetSearch.h"
#include "scene/NodeValues.h"
#include "viewpoint/HighestView.h"

#include <algorithm>
#include <iomanip>
#include <memory>
#include <sstream>

namespace limpid
{
namespace
{
/// Share of the work in runs; the rest is to look from where refused targets could be met.
constexpr double shareOfRuns = 0.8;

void SetImportance(const LabelledScene& scene, const Structures& structures)
{
  ParallelFor(scene.fields.ValueCount(), 65536,
    [&](Index node)
    { scene.importance[node] = static_cast<float>(structures.ImportanceOf(scene.rows[node])); });
}

std::string Rounded(const Vec3& direction)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << '(' << direction.x << ", " << direction.y << ", "
       << direction.z << ')';
  return text.str();
}

/// Returns where on the orbit of a camera most of a structure could be seen.
HighestView BestViewOf(const LabelledScene& scene, StructureRow row, const Solver& solver,
  const SearchProgress& progress)
{
  const Settings& settings = solver.Options();
  const Camera& camera = solver.MainCamera();
  const Index count = scene.fields.ValueCount();
  const float* base = scene.fields.baseExtinction;
  NodeValues membership(count);
  NodeValues least(count);
  ParallelFor(count, 65536,
    [&, protect = static_cast<float>(settings.protectImportance)](Index node)
    {
      membership.Data()[node] = scene.rows[node] == row ? 1.0f : 0.0f;
      least.Data()[node] = protect * membership.Data()[node] * base[node];
    });
  ViewedFields viewed{ base, membership.Data() };
  viewed.piece = scene.fields.piece;
  viewed.attainable = true;
  viewed.least = least.Data();
  const ViewScore score(scene.fields.grid, viewed, settings.rayDensity, settings.backend);
  const Orbit orbit = OrbitOf(camera);
  const Vec3 direction = glm::normalize(camera.position - camera.focalPoint);
  return FindHighestView(score, orbit, ViewAt(score, orbit, direction), progress);
}

/// Returns a sentence on a target that no opacity can meet.
std::string RefusalOf(const LabelledScene& scene, StructureRow row, const StructureShares& shares,
  const Solver& solver, const SearchProgress& progress)
{
  const Structure& structure = scene.structures.At(row);
  const Camera& camera = solver.MainCamera();
  HighestView highest;
  if (camera.position != camera.focalPoint)
  {
    highest = BestViewOf(scene, row, solver, progress);
  }
  const double most = highest.view.score.fraction;
  return "The target of \"" + structure.NameOrLabel() + "\" is " + PercentText(*structure.target) +
    ", and at most " + PercentText(shares.attainable) +
    " of it can be seen from this camera (whatever else is cleared, it hides itself). " +
    (most > shares.attainable ? "From the direction " + Rounded(highest.view.direction) +
          " of the focal point it is " + PercentText(most) + ", the most of " +
          std::to_string(highest.evaluations) + " views: go there, or lower the target."
                              : "Lower the target.");
}

/// Raises ceilings to those of the importances given: more important structures are protected more,
/// and hide more of themselves.
void RaiseCeilings(const std::vector<StructureShares>& first, std::vector<StructureShares>& shares)
{
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i].attainable = std::max(shares[i].attainable, first[i].attainable);
  }
}

/// Adds sentences about targets that are not met.
void WarnOfTargets(const LabelledScene& scene, const Solver& solver, const SearchProgress& progress,
  TargetsFound& found)
{
  std::string missed;
  for (std::size_t i = 0; i < found.shares.size(); ++i)
  {
    const auto row = static_cast<StructureRow>(i + 1);
    const Structure& structure = found.structures.At(row);
    const TargetState state = StateOf(structure, found.shares[i]);
    if (state == TargetState::Refused)
    {
      found.warning += (found.warning.empty() ? "" : "\n") +
        RefusalOf(scene, row, found.shares[i], solver, progress);
    }
    else if (state == TargetState::Missed)
    {
      missed += (missed.empty() ? "\"" : ", \"") + structure.NameOrLabel() + "\"";
    }
  }
  if (!missed.empty())
  {
    found.warning += (found.warning.empty() ? "" : "\n") + std::string("Less is visible of ") +
      missed + " than the targets ask: " + found.text + " (after " + std::to_string(found.runs) +
      " runs, what one structure gains another loses). Lower one of the targets, or the "
      "importance of other structures.";
  }
}
}

TargetsFound MeetTargets(const LabelledScene& scene, const CarriedChange& previous,
  const Progress& progress, std::unique_ptr<Solver>& solver)
{
  TargetSearch search(scene.structures, solver->Options());
  TargetsFound found{ search.Tried(), solver->SharesOf(search.Tried(), scene.rows), {}, {} };
  const std::vector<StructureShares> first = found.shares;
  const Camera camera = solver->MainCamera();
  const Light light = solver->OnlyLight();
  while (
    InfoOf(solver->Options().method).iterates && !solver->Stopped() && search.Next(found.shares))
  {
    SetImportance(scene, search.Tried());
    const std::string text = TextOfTargets(found.structures, found.shares);
    solver =
      std::make_unique<Solver>(scene.fields, camera, light, search.TriedSettings(), previous);
    solver->Run(
      [&](double share, const std::string&)
      {
        const double done = (found.runs - 1 + share) / TargetSearch::mostRuns;
        return !progress || progress(done * shareOfRuns, text);
      });
    found.structures = search.Tried();
    found.shares = solver->SharesOf(search.Tried(), scene.rows);
    RaiseCeilings(first, found.shares);
    ++found.runs;
  }
  found.text = TextOfTargets(found.structures, found.shares);
  if (!search.KeepsProtection())
  {
    found.warning = "ProtectImportance is not used (less would be visible of structures with "
                    "targets). Lower the targets to keep important structures whole.";
  }
  if (!solver->Stopped())
  {
    WarnOfTargets(
      scene, *solver,
      [&progress](double share)
      { return !progress || progress(shareOfRuns + (1 - shareOfRuns) * share, ""); },
      found);
  }
  return found;
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/MeetTargets.h"

#include "backend/Backend.h"
#include "math/PercentText.h"
#include "optimize/SceneStructures.h"
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

/// Returns sentences about targets that are not met; may be empty.
std::string WarningOf(const LabelledScene& scene, const Solver& solver, bool keepsProtection,
  const TargetsFound& found, const SearchProgress& progress)
{
  std::string warning = keepsProtection ? "" : std::string(protectionIsLost) + "\n";
  for (std::size_t i = 0; i < found.shares.size(); ++i)
  {
    const auto row = static_cast<StructureRow>(i + 1);
    if (StateOf(found.structures.At(row), found.shares[i]) == TargetState::Refused)
    {
      warning += RefusalOf(scene, row, found.shares[i], solver, progress) + "\n";
    }
  }
  const std::string missed = NamesIn(TargetState::Missed, found.structures, found.shares);
  if (!missed.empty())
  {
    const MethodInfo& method = InfoOf(solver.Options().method);
    std::string why = std::string("the method ") + method.name +
      " does not aim at targets). Use the method Optimized.";
    if (method.iterates)
    {
      why = std::to_string(found.runs) +
        " runs have found no importances that show as much of all of them). Lower one of the "
        "targets, or the importance of other structures.";
    }
    warning +=
      "Less is visible of " + missed + " than the targets ask: " + found.text + " (" + why + "\n";
  }
  return warning.substr(0, warning.find_last_not_of('\n') + 1);
}
}

TargetsFound MeetTargets(const LabelledScene& scene, const CarriedChange& previous,
  const Progress& progress, std::unique_ptr<Solver>& solver)
{
  TargetSearch search(scene.structures, solver->Options());
  TargetsFound found{ search.Tried(), solver->SharesOf(search.Tried(), scene.rows), {}, {} };
  const Camera camera = solver->MainCamera();
  const Light light = solver->OnlyLight();
  while (
    InfoOf(solver->Options().method).iterates && !solver->Stopped() && search.Next(found.shares))
  {
    FillImportance(search.Tried(), scene.rows, scene.fields.ValueCount(), scene.importance);
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
    ++found.runs;
  }
  found.text = TextOfTargets(found.structures, found.shares);
  if (!solver->Stopped())
  {
    found.warning = WarningOf(scene, *solver, search.KeepsProtection(), found,
      [&progress](double share)
      { return !progress || progress(shareOfRuns + (1 - shareOfRuns) * share, ""); });
  }
  return found;
}
}

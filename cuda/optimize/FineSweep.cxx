// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/FineSweep.h"

#include "backend/Backend.h"
#include "backend/HostDevice.h"
#include "optimize/FineFields.h"
#include "optimize/PolicyTurns.h"
#include "optimize/PreparedScene.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace limpid
{
namespace
{
/// Tells how much is done. Returns whether to go on.
bool GoesOn(const Progress& progress, double share)
{
  return !progress || progress(share, "Sweep at the resolution of the data");
}

void MakeFieldsFor(VisibilityTerm<HostDevice>& term, FineFields& fields)
{
  for (FrustumRays<HostDevice>& rays : term.Frusta())
  {
    rays.SweepMadeFields(fields);
  }
}

/// Surveys the fields and returns the problem that they are of.
Problem Surveyed(const Grid& data, FineFields& fields, const CarriedChange& change, float majorant)
{
  fields.Survey();
  Problem problem;
  problem.grid = data;
  problem.baseExtinction = fields.Base();
  problem.importance = fields.Importance();
  problem.nodeImportance = fields.NodeImportance();
  problem.occupancy = fields.Occupied();
  problem.majorant = majorant;
  problem.sources = SourcesOf(change.camera, change.light, change.settings, data);
  problem.settings = change.settings;
  problem.tellsScores = false;
  return problem;
}

/// Whether the sweep of a term writes all voxels that may change before its rays read them: the
/// volume is on one side of the camera.
bool WritesBeforeItReads(const VisibilityTerm<HostDevice>& term)
{
  return term.Frusta().size() == 1 && term.Frusta().front().Plan().firstNodeSlice == 0;
}

/// Sets a field to 0 at nodes outside of the filled parts of rows along an axis, 0 or 1. A
/// derivative that was swept in rows along the other one may differ from 0 there.
void ClearBeside(const Occupancy& filled, int axis, const Int3& nodes, float* field)
{
  ParallelFor(nodes.z,
    [&](Index slice)
    {
      const auto z = static_cast<int>(slice);
      float* value = field + slice * nodes.y * nodes.x;
      for (int y = 0; y < nodes.y; ++y)
      {
        for (int x = 0; x < nodes.x; ++x, ++value)
        {
          const Range<int>& span = filled.Row(axis, axis == 0 ? y : x, z).filled;
          *value = span.Contains(axis == 0 ? x : y) ? *value : 0.0f;
        }
      }
    });
}

/// Finds the weighted derivative of the terms that a turn does not sweep: of the light. Returns
/// null if there are none. `next`: what the turn will write. Where it can, the sweep replaces the
/// derivative there, voxel by voxel, by the next iterate; otherwise `apart` gets it.
const float* FindDerivative(Terms<HostDevice>& energy, const PolicyTurn<HostDevice>& turn,
  const Problem& problem, FineFields& fields, float* next, NodeValues& apart)
{
  const bool inPlace = WritesBeforeItReads(*turn.swept);
  if (inPlace)
  {
    std::fill_n(next, problem.grid.NodeCount(), 0.0f);
  }
  else
  {
    fields.Fill(fields.Changed(), next);
  }
  if (turn.others.empty())
  {
    return nullptr;
  }
  apart = inPlace ? NodeValues() : NodeValues(problem.grid.NodeCount());
  float* derivative = inPlace ? next : apart.Data();
  for (EnergyTerm<HostDevice>* other : turn.others)
  {
    energy.DifferentiateTerm(*other, fields.Changed(), 0, derivative); // there is only one
  }
  if (inPlace)
  {
    ClearBeside(
      *problem.occupancy, turn.swept->Frusta().front().Plan().axisU, problem.grid.nodes, next);
  }
  return derivative;
}

/// Sweeps the camera once, from the changed extinction to the next. Returns whether it did;
/// `progress` may stop it before the sweep.
bool SweepOnce(const Problem& problem, FineFields& fields, const Progress& progress, float* next)
{
  if (!GoesOn(progress, 0.1))
  {
    return false;
  }
  const std::shared_ptr<HostDevice> device = HostDevice::Shared();
  Terms<HostDevice> energy(device, problem);
  for (EnergyTerm<HostDevice>& term : energy.all)
  {
    MakeFieldsFor(term, fields);
  }
  const PolicyTurns<HostDevice> turns(problem, energy, true);
  const PolicyTurn<HostDevice> turn =
    problem.settings.smoothness > 0 ? turns.Smoothing(0) : turns.Of(0);
  energy.MeasureTerm(*turn.swept, fields.Changed());
  if (!GoesOn(progress, 0.3))
  {
    return false;
  }
  NodeValues apart;
  const float* lagged = FindDerivative(energy, turn, problem, fields, next, apart);
  if (!GoesOn(progress, 0.5))
  {
    return false;
  }
  if (turn.smoothing > 0)
  {
    fields.SetPull(lagged, turn.smoothing);
    lagged = fields.Pulled();
  }
  std::vector<Pull> pulls = energy.Pulls();
  pulls.push_back({ fields.Base(), turn.smoothing });
  PolicySweep sweep{ fields.Changed(), lagged, next, turn.swept->Weight(), pulls,
    turn.transmittance, Kept::Ignored };
  sweep.alternative = turn.weighs ? fields.Base() : nullptr;
  sweep.reach = turn.reach;
  sweep.tellsAfter = false;
  ExactDifferences moved;
  SweepPolicy(*device, *turn.swept, energy, problem, sweep, moved);
  return true;
}

/// Sweeps the camera once, or writes the changed extinction if `progress` stops that.
void SweepOrFill(const Problem& problem, FineFields& fields, const Progress& progress, float* next)
{
  if (!SweepOnce(problem, fields, progress, next))
  {
    fields.Fill(fields.Changed(), next);
  }
}

/// The rays by which a source measures scores, see PreparedScene::ProblemForScores.
VisibilityTerm<HostDevice> RaysForScores(
  const Problem& problem, const RaySource& source, FineFields& fields)
{
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), problem.grid, *fields.OccupiedByGiven(),
    source, RayDensityOfScores(problem), problem.MayHaveThickLayers());
  MakeFieldsFor(term, fields);
  return term;
}

Ceiling CeilingFrom(
  VisibilityTerm<HostDevice>& term, const Problem& problem, const FineFields& fields)
{
  const bool protects = problem.settings.protectImportance > 0;
  const CeilingFields bounds{ fields.Base(), fields.Given(), protects ? fields.Least() : nullptr,
    MostOf(problem) };
  Seen most;
  term.FindCeiling(bounds, &most);
  return CeilingOf(most, bounds.CountsKept());
}

/// Measures the base extinction and another one like Solver.
ScoresOnData Measure(const Problem& problem, FineFields& fields, const float* extinction)
{
  VisibilityTerm<HostDevice> camera = RaysForScores(problem, problem.Camera(), fields);
  Seen ofBase;
  camera.Forward({ fields.Base(), fields.Given() }, &ofBase);
  Seen ofResult;
  camera.Forward({ extinction, fields.Given(), nullptr, fields.Base() }, &ofResult);
  ScoresOnData scores{ ScoreOfBase(ofBase.all), ScoreOf(ofResult, ofBase.all.unattenuated),
    CeilingFrom(camera, problem, fields) };
  if (problem.settings.weights.light > 0)
  {
    VisibilityTerm<HostDevice> light = RaysForScores(problem, problem.Light(), fields);
    scores.ceiling.lightVisibility = CeilingFrom(light, problem, fields).visibility;
  }
  return scores;
}
}

bool CanSweepData(const Settings& settings)
{
  const bool sweeps = InfoOf(settings.method).iterates && settings.solver == SolverKind::Policy &&
    settings.maximumIterations > 0;
  return sweeps && settings.weights.view > 0 && settings.otherCameras.empty() &&
    !HasLightExtinction(settings) && settings.temporalCoherence == 0 && settings.referencePull == 0;
}

void SweepData(const Grid& data, const FieldsOfBox& ofBox, const CarriedChange& change,
  float majorant, const Progress& progress, float* extinction)
{
  FineFields fields(data, ofBox, change, majorant);
  SweepOrFill(Surveyed(data, fields, change, majorant), fields, progress, extinction);
}

ScoresOnData SweepAndMeasureData(const Grid& data, const FieldsOfBox& ofBox,
  const CarriedChange& change, float majorant, const Progress& progress, float* extinction)
{
  const auto start = std::chrono::steady_clock::now();
  FineFields fields(data, ofBox, change, majorant);
  const Problem problem = Surveyed(data, fields, change, majorant);
  SweepOrFill(problem, fields, progress, extinction);
  GoesOn(progress, 0.8);
  ScoresOnData scores = Measure(problem, fields, extinction);
  if (!(problem.settings.emphasis > 0) && scores.result.fraction < scores.base.fraction)
  {
    fields.Fill(fields.Base(), extinction);
    scores.result = scores.base;
  }
  scores.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return scores;
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For any input, a solver throws limpid::Error or keeps its bounds.

#include "Invented.h"

#include "math/Require.h"
#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace limpid;

namespace
{
Vec3 MakeVector(Invented& make, double size)
{
  const double x = make.Number(-size, size);
  const double y = make.Number(-size, size);
  return { x, y, make.Number(-size, size) };
}

Settings MakeSettings(Invented& make)
{
  Settings settings;
  settings.weights.regularization = make.Number(1e-6, 1);
  settings.weights.view = make.Number(0, 100);
  settings.weights.light = make.Number(0, 10);
  settings.mode = make.Chance() ? Mode::Joint : Mode::Separate;
  settings.solver = make.Chance() ? SolverKind::Policy : SolverKind::Adam;
  settings.derivative = make.Chance() ? Derivative::Volume : Derivative::Ray;
  settings.maximumIterations = make.Integer(-1, 3);
  settings.iterationsPerLevel = { { make.Integer(-1, 2), make.Integer(0, 2), make.Integer(0, 2) } };
  settings.learningRate = make.Number(0.001, 0.2);
  settings.tolerance = make.Number(0, 0.01);
  settings.rayDensity = make.Number(0.5, 2);
  settings.skipUnneeded = make.Chance();
  settings.restrictToView = make.Chance();
  settings.protectImportance = make.Number(0, 1);
  settings.clearingThreshold = make.Chance() ? make.Number(0, 2) : 0;
  settings.emphasis = make.Number(0, 1);
  settings.importanceSmoothing =
    make.Chance() ? ImportanceSmoothing::Median : ImportanceSmoothing::Off;
  settings.smoothness = make.Chance() ? make.Number(0, 10) : 0;
  settings.temporalCoherence = make.Chance() ? make.Number(0, 10) : 0;
  settings.backend = BackendKind::Cpu;
  return settings;
}

bool AreWithin(const std::vector<float>& values, double high)
{
  return std::all_of(values.begin(), values.end(),
    [high](float value) { return value >= 0 && double(value) <= high; });
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  Invented make(bytes, count);
  Grid grid;
  grid.nodes = { make.Integer(1, 7), make.Integer(1, 7), make.Integer(1, 7) };
  grid.origin = MakeVector(make, 10);
  grid.spacing = { make.Number(0.1, 3), make.Number(0.1, 3), make.Number(0.1, 3) };
  Camera camera;
  camera.position = MakeVector(make, 20);
  camera.focalPoint = MakeVector(make, 5);
  camera.viewUp = MakeVector(make, 1);
  camera.viewAngle = make.Number(1, 179);
  camera.parallel = make.Chance();
  camera.parallelScale = make.Number(0.1, 10);
  Light light;
  light.type = make.Chance() ? LightType::Directional : LightType::Point;
  light.position = MakeVector(make, 20);
  light.focalPoint = MakeVector(make, 5);
  const Settings settings = MakeSettings(make);
  std::vector<float> extinction(std::size_t(grid.NodeCount()));
  std::vector<float> importance(extinction.size());
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    extinction[node] = make.Chance() ? static_cast<float>(make.Number(0, 10)) : 0.0f;
    importance[node] = make.Chance() ? static_cast<float>(make.Number(0, 1)) : 0.0f;
  }
  try
  {
    Solver solver({ grid, extinction.data(), importance.data() }, camera, light, settings);
    solver.Run();
    Demand(AreWithin(solver.Extinction(), solver.Majorant()), "extinction in [0, majorant]");
    Demand(AreWithin(solver.LightExtinction(), solver.Majorant()), "the same for the light");
    std::vector<float> transmittance(extinction.size());
    solver.Transmittance(transmittance.data());
    Demand(AreWithin(transmittance, 1), "transmittance from the camera in [0, 1]");
    solver.LightTransmittance(transmittance.data());
    Demand(AreWithin(transmittance, 1), "transmittance from the light in [0, 1]");
    const Score score = solver.BestScore();
    Demand(std::isfinite(score.visibility) && score.visibility >= 0, "a score");
    Demand(score.fraction >= 0 && score.fraction <= 1, "a visible share in [0, 1]");
  }
  catch (const Error&) // says what is wrong
  {
  }
  return 0;
}

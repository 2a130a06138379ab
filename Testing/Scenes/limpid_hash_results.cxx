// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Prints one line per result of a scene: its name, what it is, and a hash of its bits. Two builds
// that print the same lines give the same results, bit for bit. Compare builds of one compiler on
// one machine: others may contract or order the same arithmetic in another way.
//   limpid_hash_results SCENE.scene.json...

#include "PretendedClock.h"
#include "RenderScene.h"
#include "SceneForSolver.h"
#include "SceneFunctions.h"

#include "optimize/Progressive.h"
#include "viewpoint/Search.h"

#include <cinttypes>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

namespace limpid
{
namespace
{
/// Fowler, Noll and Vo's hash of 64 bits (FNV-1a), of what is added.
class Hash
{
public:
  template <class Value>
  Hash& Add(const Value* values, std::size_t count)
  {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(Value); ++i)
    {
      this->State = (this->State ^ bytes[i]) * 1099511628211u;
    }
    return *this;
  }

  template <class Value>
  Hash& Add(const std::vector<Value>& values)
  {
    return this->Add(values.data(), values.size());
  }

  Hash& Add(double value) { return this->Add(&value, 1); }

  std::uint64_t Value() const { return this->State; }

private:
  std::uint64_t State = 14695981039346656037u;
};

/// What is computed of one scene.
class ResultsOf
{
public:
  ResultsOf(const SceneForSolver& scene, const std::vector<float>& scalars,
    const TransferFunctions& functions)
    : Scene(scene)
    , Scalars(scalars)
    , Functions(functions)
  {
  }

  void PrintAll()
  {
    this->PrintSolvers();
    this->PrintEyes();
    this->PrintPreviews();
    this->PrintViewpoints();
    this->PrintPictures();
  }

private:
  void Print(const char* what, const Hash& hash) const
  {
    std::printf("%s %s %016" PRIx64 "\n", this->Scene.name.c_str(), what, hash.Value());
    std::fflush(stdout);
  }

  /// Runs a solver. Returns what it has found.
  std::vector<float> PrintRun(
    const char* what, const Camera& camera, const Light& light, const Settings& settings) const
  {
    Solver solver(this->Scene.Fields(), camera, light, settings);
    solver.Run();
    Hash hash;
    hash.Add(solver.Extinction()).Add(solver.LightExtinction());
    for (const IterationRecord& record : solver.History())
    {
      hash.Add(record.energy.regularization).Add(record.energy.view).Add(record.energy.light);
      hash.Add(record.score.visibility).Add(record.meanChange);
    }
    this->Print(what, hash);
    return solver.Extinction();
  }

  void PrintSolvers()
  {
    const Camera& camera = this->Scene.camera;
    const Light& light = this->Scene.light;
    Settings settings;
    settings.backend = BackendKind::Cpu;
    this->Optimised = this->PrintRun("policy", camera, light, settings);

    Solver base(this->Scene.Fields(), camera, light, settings);
    std::vector<float> transmittance(this->Optimised.size());
    base.Transmittance(transmittance.data());
    this->Print("transmittance", Hash().Add(transmittance));
    base.LightTransmittance(transmittance.data());
    this->Print("light-transmittance", Hash().Add(transmittance));

    settings.maximumIterations = 3;
    Settings other = settings;
    other.mode = Mode::Separate;
    this->PrintRun("policy-separate", camera, light, other);
    other = settings;
    other.derivative = Derivative::Ray;
    this->PrintRun("policy-ray-derivative", camera, light, other);
    other = settings;
    other.skipUnneeded = false;
    other.restrictToView = true;
    this->PrintRun("policy-in-view-without-skips", camera, light, other);
    other = settings;
    other.weights.light = 0;
    other.rayDensity = 1.7;
    this->PrintRun("policy-camera-alone", camera, light, other);
    other = settings;
    other.solver = SolverKind::Adam;
    other.iterationsPerLevel = { { 2, 2, 3 } };
    this->PrintRun("adam", camera, light, other);
    other.derivative = Derivative::Ray;
    other.restrictToView = true;
    this->PrintRun("adam-ray-derivative-in-view", camera, light, other);
  }

  /// Cameras along every axis, inside and parallel; lights elsewhere.
  void PrintEyes()
  {
    const Grid& grid = this->Scene.grid;
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.maximumIterations = 2;
    const Vec3 directions[4] = { Vec3(2.7, 0.3, 0.4), Vec3(-0.2, -2.6, 0.7), Vec3(0.6, 0.2, -2.8),
      Vec3(0.11, -0.23, 0.17) };
    const char* names[4] = { "policy-along-x", "policy-along-y", "policy-along-z",
      "policy-inside" };
    for (int i = 0; i < 4; ++i)
    {
      Camera camera = this->Scene.camera;
      camera.focalPoint = grid.Centre();
      camera.position = grid.Centre() + grid.Radius() * directions[i];
      camera.viewUp = Vec3(0.1, 0.2, 1);
      Light light = this->Scene.light;
      light.type = i % 2 == 0 ? LightType::Directional : LightType::Point;
      light.focalPoint = grid.Centre();
      light.position = grid.Centre() + grid.Radius() * directions[(i + 1) % 4] * 1.1;
      camera.parallel = i == 2;
      camera.parallelScale = grid.Radius();
      this->PrintRun(names[i], camera, light, settings);
    }
  }

  void PrintPreviews() const
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    Progressive progressive(this->Scene.Fields(), settings);
    const PretendedClock clock(1e-7);
    progressive.SetView(this->Scene.camera, this->Scene.light, settings);
    progressive.Preview(0.03);
    const auto count = static_cast<std::size_t>(progressive.ShownGrid().NodeCount());
    Hash hash;
    hash.Add(progressive.Extinction(), count).Add(progressive.BestScore().visibility);
    this->Print("preview", hash.Add(progressive.BaseScore().visibility));
  }

  void PrintViewpoints() const
  {
    const Grid& grid = this->Scene.grid;
    std::vector<float> proxy = this->Scene.importance;
    for (float& value : proxy)
    {
      value *= this->Functions.extinction.empty() ? 1.0f : 3.0f / float(grid.Radius());
    }
    const ViewScore score(grid, { proxy.data(), this->Scene.importance.data() }, 1);
    Orbit orbit;
    orbit.centre = grid.Centre();
    orbit.distance = 3 * grid.Radius();
    Hash scores;
    Hash slopes;
    for (int i = 0; i < 8; ++i)
    {
      orbit.parallel = i == 5;
      const Camera camera =
        orbit.At(glm::normalize(Vec3(std::sin(1.0 + i), std::cos(2.3 * i), std::sin(0.7 * i))));
      const Score at = score.At(camera);
      scores.Add(at.visibility);
      if (i > 3)
      {
        const ViewSlope slope = score.SlopeAt(camera);
        slopes.Add(slope.score).Add(slope.slope.x).Add(slope.slope.y).Add(slope.slope.z);
      }
    }
    this->Print("view-scores", scores);
    this->Print("view-slopes", slopes);
    const Camera& near = this->Scene.camera;
    const ViewSlope slope = score.SlopeAt(near);
    Hash hash;
    hash.Add(slope.score).Add(slope.slope.x).Add(slope.slope.y).Add(slope.slope.z);
    this->Print("view-slope-of-camera", hash);
  }

  void PrintPicture(const char* what, Renderer& renderer, const View& view) const
  {
    Picture picture;
    renderer.Render(view, picture);
    this->Print(what, Hash().Add(picture.rgba));
  }

  void PrintPictures() const
  {
    const Camera& camera = this->Scene.camera;
    const double distance = glm::length(camera.position - camera.focalPoint);
    View view;
    view.width = 200;
    view.height = 160;
    view.jitter = true;
    view.clipToWorld = Perspective(LookAt(camera.position, camera.focalPoint, camera.viewUp),
      camera.viewAngle, 1.25, 0.1 * distance, 3 * distance);
    Renderer renderer;
    renderer.SetScalars(this->Scene.grid, this->Scalars.data());
    renderer.SetTransferFunctions(this->Functions);
    this->PrintPicture("picture", renderer, view);
    Lighting lighting;
    lighting.enabled = true;
    lighting.light = this->Scene.light;
    renderer.SetLighting(lighting);
    this->PrintPicture("picture-lit", renderer, view);
    renderer.SetExtinction(
      this->Scene.grid, this->Scene.extinction.data(), this->Optimised.data(), 0.4);
    renderer.SetExtinction(
      this->Scene.grid, this->Scene.extinction.data(), this->Optimised.data(), 0.7);
    this->PrintPicture("picture-optimised", renderer, view);
    renderer.SetShadowCoarseness(3);
    view.sampleDistance = 2;
    this->PrintPicture("picture-coarse", renderer, view);
    lighting.shadows = false;
    renderer.SetLighting(lighting);
    this->PrintPicture("picture-without-shadows", renderer, view);
    lighting.enabled = false;
    renderer.SetLighting(lighting);
    this->PrintPicture("picture-optimised-unlit", renderer, view);
    renderer.SetImportance(this->Scene.importance.data());
    renderer.ShowMissed(std::array<float, 3>{ { 1.0f, 0.2f, 0.1f } });
    this->PrintPicture("picture-missed", renderer, view);
    renderer.ShowMissed(std::nullopt);
    renderer.SetExtinction(this->Scene.grid, nullptr, nullptr);
    renderer.ComposeBy(Compositing::FromObject);
    this->PrintPicture("picture-viola", renderer, view);
    renderer.ComposeBy(Compositing::ImportanceMean);
    this->PrintPicture("picture-marchesin", renderer, view);
  }

  const SceneForSolver& Scene;
  const std::vector<float>& Scalars;
  const TransferFunctions& Functions;
  std::vector<float> Optimised;
};

/// A small scene that needs no data: waves, anisotropic and turned, with holes.
void PrintWaves()
{
  Grid grid = MakeGrid({ 37, 29, 43 }, Vec3(5, -3, 2), Vec3(0.9, 1.3, 0.7));
  const double angle = 0.4;
  grid.direction = Mat3(Vec3(std::cos(angle), std::sin(angle), 0),
    Vec3(-std::sin(angle), std::cos(angle), 0), Vec3(0, 0, 1));
  RenderScene drawn = RenderScene::Random(7, grid, 6);
  std::mt19937 generator(3);
  const std::vector<float> waves = RenderScene::Waves(grid, generator);
  SceneForSolver scene;
  scene.name = "waves";
  scene.grid = grid;
  const float steepest = float(6 / grid.Radius());
  for (std::size_t node = 0; node < waves.size(); ++node)
  {
    const float height = drawn.scalars[node];
    scene.extinction.push_back(height > 0.35f ? steepest * std::min(height, 1.0f) : 0.0f);
    scene.importance.push_back(waves[node] > 0.75f ? std::min(waves[node], 1.0f) : 0.0f);
    if (node % 97 == 0)
    {
      drawn.scalars[node] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  scene.camera.position = grid.Centre() + grid.Radius() * Vec3(1.1, -2.3, 1.4);
  scene.camera.focalPoint = grid.Centre();
  scene.camera.viewUp = Vec3(0, 0, 1);
  scene.light.position = grid.Centre() + grid.Radius() * Vec3(-1, 3, -0.7);
  scene.light.focalPoint = grid.Centre();
  ResultsOf(scene, drawn.scalars, drawn.functions).PrintAll();
}

void PrintFile(const std::string& path)
{
  const truth::SceneFile file = truth::ReadSceneFile(path);
  const std::vector<float> scalars(file.scalars.begin(), file.scalars.end());
  const TransferFunctions functions = FunctionsOf(file);
  ResultsOf(SceneForSolver(file), scalars, functions).PrintAll();
}
}
}

int main(int count, char** arguments)
{
  try
  {
    limpid::PrintWaves();
    for (int i = 1; i < count; ++i)
    {
      limpid::PrintFile(arguments[i]);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_PaperScheme_h
#define limpid_testing_PaperScheme_PaperScheme_h

#include "PaperScheme/GradientVoxel.h"
#include "PaperScheme/PerspectiveMap.h"
#include "PaperScheme/Views.h"
#include "optimize/Settings.h"
#include "optimize/Solver.h"

#include <vector>

namespace limpid::reference
{
struct PaperSettings
{
  Weights weights;
  double samplesPerVoxel = 2; ///< of the perspective grids, along each axis
  double learningRate = 0.05; ///< Adam [majorant]
};

/**
 * The paper's scheme to the letter: perspective grids for camera and light (Section 3.3), gradient
 * looked up in them (Eqs. (26)-(28)), Adam steps on one resolution level (Eq. (30)).
 *
 * It is the slow and simple reference of the tests and the peer of the benchmarks; the product is
 * limpid::Solver. Camera and light are points outside the data. Everything is computed in
 * normalised coordinates: positions from the centre of the box in radii, extinction times radius.
 */
template <class Real>
class PaperScheme
{
public:
  /// Starts from the base extinction, with its grids up to date. `camera` and `light` are positions
  /// in world coordinates. Throws limpid::Error when they are not outside the data, or when scene
  /// or settings cannot be worked with.
  PaperScheme(
    const SceneFields& scene, const Vec3& camera, const Vec3& light, const PaperSettings& settings);

  /// Replaces the extinction and brings the grids up to date; `extinction` has one value per node
  /// [1/length].
  void SetExtinction(const float* extinction);

  /// Recomputes transmittance and visible importance on both perspective grids, Eqs. (17)-(20).
  void Update();

  /// dF/dmu of Eqs. (26)-(28) with the grids as they are, in normalised coordinates; `gradient` has
  /// room for one value per node.
  void Gradient(Real* gradient) const;

  /// One iteration of Section 3.5: gradient, Adam step, update of the grids.
  void Step();

  /// S of Eq. (32) as a Riemann sum over the camera's perspective grid [length^2].
  double Score() const;

  std::vector<float> Extinction() const; ///< one value per node [1/length]
  double Majorant() const;               ///< upper bound of Eq. (25) [1/length]
  const PerspectiveMap<Real>& CameraMap() const { return this->Camera.map; }
  const PerspectiveMap<Real>& LightMap() const { return this->Light.map; }

private:
  /// A perspective grid of Fig. 4.
  struct SourceGrids
  {
    Real weight = 0; // q or r
    PerspectiveMap<Real> map;
    std::vector<Real> transmittance;
    std::vector<Real> visibleBehind;

    SourceTerm<Real> Term() const;
  };

  SourceGrids MakeGrids(const Vec3& eye, double weight) const;
  void UpdateGrids(SourceGrids& grids);
  FieldView<Real> View(const std::vector<Real>& field) const;

  Grid Nodes;
  PaperSettings Options;
  Real NormalisedMajorant = 0;
  std::vector<Real> Current; // extinction, normalised
  std::vector<Real> Base;    // base extinction, normalised
  std::vector<Real> Importance;
  std::vector<Real> Slope; // gradient of the last step
  std::vector<Real> FirstMoment;
  std::vector<Real> SecondMoment;
  int Steps = 0;
  SourceGrids Camera;
  SourceGrids Light;
};
}

#endif

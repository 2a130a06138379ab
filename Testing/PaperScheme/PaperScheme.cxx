// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PaperScheme/PaperScheme.h"

#include "PaperScheme/AdamVoxel.h"
#include "PaperScheme/Launch.h"
#include "PaperScheme/ScoreRay.h"
#include "PaperScheme/TransmittanceRay.h"
#include "PaperScheme/VisibleImportanceRay.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>

namespace limpid::reference
{
template <class Real>
PaperScheme<Real>::PaperScheme(
  const SceneFields& scene, const Vec3& camera, const Vec3& light, const PaperSettings& settings)
  : Nodes(scene.grid)
  , Options(settings)
{
  scene.grid.Require();
  const Index count = scene.grid.NodeCount();
  const double radius = scene.grid.Radius();
  this->Base.resize(count);
  this->Importance.assign(scene.importance, scene.importance + count);
  for (Index node = 0; node < count; ++node)
  {
    this->Base[node] = Real(scene.baseExtinction[node] * radius);
  }
  this->NormalisedMajorant = *std::max_element(this->Base.begin(), this->Base.end());
  LIMPID_REQUIRE(this->NormalisedMajorant > 0,
    "The majorant extinction is " << this->NormalisedMajorant
                                  << " (Eq. (25) needs an upper bound above zero). "
                                     "Give the transfer function some opacity.");

  this->Current = this->Base;
  this->Slope.assign(count, 0);
  this->FirstMoment.assign(count, 0);
  this->SecondMoment.assign(count, 0);
  this->Camera = this->MakeGrids(camera, settings.weights.view);
  this->Light = this->MakeGrids(light, settings.weights.light);
  this->Update();
}

template <class Real>
SourceTerm<Real> PaperScheme<Real>::SourceGrids::Term() const
{
  return { this->weight, this->map, { this->transmittance.data(), this->map.cells },
    { this->visibleBehind.data(), this->map.cells } };
}

template <class Real>
typename PaperScheme<Real>::SourceGrids PaperScheme<Real>::MakeGrids(
  const Vec3& eye, double weight) const
{
  SourceGrids grids;
  grids.weight = Real(weight);
  grids.map = LookAtBox<Real>(this->Nodes, eye, this->Options.samplesPerVoxel);
  grids.transmittance.resize(grids.map.CellCount());
  grids.visibleBehind.resize(grids.map.CellCount());
  return grids;
}

template <class Real>
FieldView<Real> PaperScheme<Real>::View(const std::vector<Real>& field) const
{
  return { field.data(), this->Nodes.nodes };
}

template <class Real>
void PaperScheme<Real>::SetExtinction(const float* extinction)
{
  const double radius = this->Nodes.Radius();
  for (std::size_t node = 0; node < this->Current.size(); ++node)
  {
    this->Current[node] = Real(extinction[node] * radius);
  }
  this->Update();
}

template <class Real>
void PaperScheme<Real>::UpdateGrids(SourceGrids& grids)
{
  const GridView<Real> transmittance{ grids.transmittance.data(), grids.map.cells };
  const GridView<Real> visibleBehind{ grids.visibleBehind.data(), grids.map.cells };
  Launch(grids.map.RayCount(),
    TransmittanceRay<Real>{ this->View(this->Current), grids.map, transmittance });
  Launch(grids.map.RayCount(),
    VisibleImportanceRay<Real>{ this->View(this->Current), this->View(this->Importance), grids.map,
      { grids.transmittance.data(), grids.map.cells }, visibleBehind });
}

template <class Real>
void PaperScheme<Real>::Update()
{
  this->UpdateGrids(this->Camera);
  this->UpdateGrids(this->Light);
}

template <class Real>
void PaperScheme<Real>::Gradient(Real* gradient) const
{
  Launch(this->Nodes.NodeCount(),
    GradientVoxel<Real>{ this->Nodes.nodes, this->Current.data(), this->Base.data(),
      this->Importance.data(), Real(this->Options.weights.regularization), this->Camera.Term(),
      this->Light.Term(), gradient });
}

template <class Real>
void PaperScheme<Real>::Step()
{
  this->Gradient(this->Slope.data());

  ++this->Steps;
  const Weights& weights = this->Options.weights;
  AdamVoxel<Real> adam;
  adam.gradient = this->Slope.data();
  adam.firstMoment = this->FirstMoment.data();
  adam.secondMoment = this->SecondMoment.data();
  adam.extinction = this->Current.data();
  adam.majorant = this->NormalisedMajorant;
  adam.stepLength = Real(this->Options.learningRate * this->NormalisedMajorant);
  adam.epsilon = Real(1e-6 * std::max({ weights.view, weights.light, weights.regularization }));
  adam.firstCorrection = Real(1 / (1 - std::pow(0.9, this->Steps)));
  adam.secondCorrection = Real(1 / (1 - std::pow(0.999, this->Steps)));
  Launch(this->Nodes.NodeCount(), adam);

  this->Update();
}

template <class Real>
double PaperScheme<Real>::Score() const
{
  const SourceTerm<Real> camera = this->Camera.Term();
  std::vector<double> scores(camera.map.RayCount());
  Launch(camera.map.RayCount(),
    ScoreRay<Real>{ this->View(this->Current), this->View(this->Importance), camera.map,
      camera.transmittance, scores.data() });

  double score = 0; // in the order of the rays, whatever the number of threads
  for (const double ofRay : scores)
  {
    score += ofRay;
  }
  const double radius = this->Nodes.Radius();
  return score * radius * radius;
}

template <class Real>
std::vector<float> PaperScheme<Real>::Extinction() const
{
  const double radius = this->Nodes.Radius();
  std::vector<float> extinction(this->Current.size());
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    extinction[node] = float(this->Current[node] / radius);
  }
  return extinction;
}

template <class Real>
double PaperScheme<Real>::Majorant() const
{
  return this->NormalisedMajorant / this->Nodes.Radius();
}

template class PaperScheme<float>;
template class PaperScheme<double>;
}

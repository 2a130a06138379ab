// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the input and the properties of a vtkVisibilityAlgorithm to the scene of the core.

#ifndef vtkVisibilityAlgorithmScene_h
#define vtkVisibilityAlgorithmScene_h

#include "SampledData.h"
#include "SceneConversion.h"
#include "SharedImage.h"
#include "StartingImportance.h"
#include "vtkVisibilityAlgorithm.h"

#include "optimize/Solver.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limpid
{
/// A scene that was read from an image, and the parameters it was read with.
struct ImageScene
{
  Grid grid;
  double unitDistance = 1; ///< unit distance of opacities [length]
  SceneArrays arrays;
  float majorant = 0; ///< majorant of the opacity function; zero: that of the arrays [1/length]
  std::shared_ptr<const ScenePiece> piece;      ///< of this rank; null: everything
  std::shared_ptr<const Structures> structures; ///< null: importance is given otherwise
  std::string warning; ///< says what was assumed of structures; may be empty

  /// Converts both fields a few layers at a time, instead of the arrays; null: they are here.
  std::shared_ptr<LayeredFields> layered;

  /// Arrays of the input that are used as fields of the scene without a copy.
  std::vector<vtkDataArray*> taken;

  /// Returns the fields for the core. Their memory belongs to this object. They are null if they
  /// are converted in layers.
  SceneFields Fields() const;
};
}

struct vtkVisibilityAlgorithm::SceneReader
{
  explicit SceneReader(vtkVisibilityAlgorithm* self)
    : Self(self)
  {
  }

  /// Returns the input. Throws if it is missing or is not the whole image.
  vtkImageData* RequireWholeImage(vtkInformationVector** inputVector) const;

  /// Returns whether the input has to be sampled: it is there, and is no image.
  static bool IsMesh(vtkInformationVector** inputVector);

  /// Samples data that are no image, with the labels that were chosen. `isWholeOnAll`: see
  /// DataSampling. Collective.
  limpid::SampledData Sample(
    vtkDataObject* data, const limpid::Communicator& ranks, bool isWholeOnAll) const;

  /// Throws if the unit distance is not a valid distance.
  void RequireUnitDistance() const;

  /// Reads the scene of the input, with the base extinction from `extinctionSource`. Warns about
  /// unusable values. `inLayers`: returns whether the fields are to be converted in layers instead,
  /// which then warn (WarnOfValues); it is asked only where that is possible.
  limpid::ImageScene Read(vtkImageData* input, int extinctionSource,
    const std::function<bool(const limpid::ImageScene&)>& inLayers = {}) const;

  /// Warns about the unusable values of the layers that were converted.
  void WarnOfValues(const limpid::ImageScene& scene) const;

  /// Reads the scene of an image that ranks share. If one rank fails, this throws on all of them.
  limpid::ImageScene ReadShared(const std::shared_ptr<const limpid::Communicator>& ranks,
    vtkInformationVector** inputVector, int extinctionSource) const;

  /// Returns the whole extent of the input, over all ranks.
  static std::array<int, 6> WholeExtentOf(vtkInformationVector** inputVector);

  /// Requests from the input the piece that is requested from this filter.
  static void RequestPiece(vtkInformation* outInfo, vtkInformationVector** inputVector);

private:
  /// A range of scalars; it is empty if its ends are NaN.
  using ScalarRange = std::array<double, 2>;

  /// Assumptions about the scalars of all ranks.
  struct Assumed
  {
    ScalarRange range{};                              ///< of opacities, see OpacityOfScalars
    std::optional<limpid::ImportanceRamp> importance; ///< none: importance is given
    bool isThere = false;                             ///< whether any rank has an importance array
  };

  bool HasOpacityFunction() const;
  /// The sources of both fields.
  struct Sources
  {
    limpid::FieldSource extinction;
    limpid::FieldSource importance;
  };

  Sources SourcesOf(vtkImageData* input, int extinctionSource, const Assumed& assumed,
    limpid::ImageScene& scene) const;
  void Convert(vtkImageData* input, const Sources& sources, limpid::ImageScene& scene) const;
  void AssumeShared(
    const limpid::SharedImage& shared, const std::array<int, 6>& whole, Assumed& assumed) const;
  void Warn(const Assumed& assumed, const limpid::ImageScene& scene) const;
  void ReadUnits(int extinctionSource, limpid::ImageScene& scene) const;
  ScalarRange RangeOfScalars(vtkImageData* input) const;

  limpid::FieldSource FindArray(int index, const char* fallback, vtkImageData* input) const;
  limpid::FieldSource RequireArray(
    int index, const char* role, const char* fallback, vtkImageData* input) const;
  limpid::ImportanceChoice ChooseImportance(vtkImageData* input) const;
  limpid::FieldSource ImportanceSource(vtkImageData* input, const Assumed& assumed) const;
  limpid::FieldSource ExtinctionArray(vtkImageData* input) const;
  limpid::FieldSource Scalars(vtkImageData* input) const;
  limpid::FieldSource OpacityOfScalars(
    vtkImageData* input, double unitDistance, const ScalarRange& range) const;

  vtkVisibilityAlgorithm* Self;
};

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From the input and the properties of a vtkVisibilityAlgorithm to the scene of the core.

#ifndef vtkVisibilityAlgorithmScene_h
#define vtkVisibilityAlgorithmScene_h

#include "SceneConversion.h"
#include "SharedImage.h"
#include "StartingImportance.h"
#include "vtkVisibilityAlgorithm.h"

#include "optimize/Solver.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limpid
{
/// A scene that was read from an image, and what it was read with.
struct ImageScene
{
  Grid grid;
  double unitDistance = 1; ///< of opacities [length]
  SceneArrays arrays;
  float majorant = 0; ///< of the opacity function; zero: that of the arrays [1/length]
  std::shared_ptr<const ScenePiece> piece; ///< null: the arrays have all points

  /// Arrays of the input that are fields of the scene as they are.
  std::vector<vtkDataArray*> taken;

  /// What the core takes of it; the arrays stay here.
  SceneFields Fields() const;
};
}

struct vtkVisibilityAlgorithm::SceneReader
{
  explicit SceneReader(vtkVisibilityAlgorithm* self)
    : Self(self)
  {
  }

  /// Throws unless the input is there, and all of it.
  vtkImageData* RequireWholeImage(vtkInformationVector** inputVector) const;

  /// Throws on a unit distance that is none.
  void RequireUnitDistance() const;

  /// The scene of the input, with the base extinction from `extinctionSource`. Warns of values that
  /// cannot be used.
  limpid::ImageScene Read(vtkImageData* input, int extinctionSource) const;

  /// Reads the scene of an image that ranks share. If one rank fails, this throws on all of them.
  limpid::ImageScene ReadShared(const std::shared_ptr<const limpid::Communicator>& ranks,
    vtkInformationVector** inputVector, int extinctionSource) const;

  /// Returns the whole extent of the input, over all ranks.
  static std::array<int, 6> WholeExtentOf(vtkInformationVector** inputVector);

  /// Asks the input for the piece that is asked for here.
  static void RequestPiece(vtkInformation* outInfo, vtkInformationVector** inputVector);

private:
  /// A range of scalars; ends that are not numbers: there are none.
  using ScalarRange = std::array<double, 2>;

  /// What is assumed of all scalars, those of other ranks included.
  struct Assumed
  {
    ScalarRange range{};                              ///< of opacities; see OpacityOfScalars
    std::optional<limpid::ImportanceRamp> importance; ///< none: something says what is important
    bool isThere = false;                             ///< an importance array, on some rank
  };

  bool HasOpacityFunction() const;
  limpid::SceneArrays Convert(vtkImageData* input, int extinctionSource, const Assumed& assumed,
    limpid::ImageScene& scene) const;
  void AssumeShared(
    const limpid::SharedImage& shared, const std::array<int, 6>& whole, Assumed& assumed) const;
  void Warn(const Assumed& assumed, const limpid::ImageScene& scene) const;
  void ReadUnits(int extinctionSource, limpid::ImageScene& scene) const;
  ScalarRange RangeOfScalars(vtkImageData* input) const;

  std::string ChosenName(int index) const;
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

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Values of data sets at the points of a lattice.

#ifndef limpid_LatticeSamples_h
#define limpid_LatticeSamples_h

#include "DataLeaves.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;

namespace limpid
{
class Communicator;

/// Points at equal distances along each axis, those of an extent as vtkImageData has.
struct Lattice
{
  std::array<double, 3> origin{};
  std::array<double, 3> spacing{};
  std::array<int, 6> extent{ { 0, -1, 0, -1, 0, -1 } };

  vtkIdType Count() const;
  std::array<double, 3> PointAt(vtkIdType number) const;

  /// Returns the part of it within an extent.
  Lattice Within(const std::array<int, 6>& other) const;

  /// Returns the part of it in which a box is, and a point around.
  Lattice Around(const double bounds[6]) const;

  /// Returns the part of it in which leaves are, and a point around.
  Lattice Around(const std::vector<Leaf>& leaves) const;

  /// Returns its parts between planes across the last axis; none, if it has no points.
  std::vector<Lattice> Slabs(int most) const;

  /// Returns the centres of its cells.
  Lattice OfCells() const;
};

/// An array of samples.
struct SampledArray
{
  std::string name;
  int type = 0; ///< of VTK
  int components = 1;
  bool isActive = false; ///< whether these are the active scalars
};

/// Returns the arrays of the first rank that has any. Collective.
std::vector<SampledArray> OfFirstThatHasAny(
  const Communicator& ranks, const std::vector<SampledArray>& here);

/// Returns the numbers of all ranks. Collective.
std::vector<std::int64_t> OfEachRank(const Communicator& ranks, std::int64_t here);

/// The samples of data sets at the points of a lattice: arrays, and whether each point has them.
class LatticeSamples
{
public:
  LatticeSamples(const Lattice& lattice, const std::vector<SampledArray>& arrays);

  /// Uses values at all points of the lattice as samples, those of arrays with the names.
  void Use(vtkDataSetAttributes* values);

  /// Samples a leaf where no other one was. Returns the numbers of these points.
  std::vector<vtkIdType> Add(vtkDataSet* leaf);

  /// Copies values of an array, at its points `from`, to points `to`.
  void Copy(
    vtkDataArray* array, const std::vector<vtkIdType>& from, const std::vector<vtkIdType>& to);

  /// Gives cells without a sample the values at one of their corners that has one. `corners`: the
  /// samples at the corners of these cells.
  void Complete(const LatticeSamples& corners);

  /// Takes values of a leaf's arrays into the ranges of these: weights of interpolation add up to
  /// one but for rounding. `association`: of the arrays.
  void TakeIntoRanges(const std::vector<Leaf>& leaves, int association);

  /// Returns the samples of all ranks at the points of a lattice, of which the arrays are the same;
  /// of ranks that have a point, the first one counts. Collective.
  LatticeSamples Shared(const Communicator& ranks, const Lattice& lattice) const;

  bool IsValid(vtkIdType point) const { return this->Valid[std::size_t(point)] != 0; }

  const std::vector<vtkSmartPointer<vtkDataArray>>& Values() const { return this->Arrays; }

private:
  vtkIdType NumberOf(int i, int j, int k) const;
  std::vector<vtkIdType> NumbersIn(const Lattice& part) const;
  std::vector<vtkIdType> Take(vtkPointData* sampled, const Lattice& part);
  std::size_t BytesOfPoint() const;
  std::vector<unsigned char> Packed(const Lattice& part) const;
  void Unpack(const Lattice& part, const std::vector<unsigned char>& packed);

  Lattice Here;
  std::vector<unsigned char> Valid; ///< 0: no; 1: sampled; 2: completed
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
};

/// Returns the points of a leaf that are nearest to points of a lattice.
std::vector<vtkIdType> NearestOf(
  vtkDataSet* leaf, const Lattice& lattice, const std::vector<vtkIdType>& points);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An array of an image that is distributed over processes.

#ifndef limpid_SharedArray_h
#define limpid_SharedArray_h

#include "SceneConversion.h"

#include "vtkLimpidFiltersModule.h" // for export macro

#include "scene/StartingImportance.h"

#include <array>
#include <vector>

class vtkImageData;
class vtkMultiProcessController;

namespace limpid
{
struct NodeBox;

/// Its methods are collective if there are several processes: all must call them, in the same
/// order.
class VTKLIMPIDFILTERS_EXPORT SharedArray
{
public:
  /// `source`: array and component; a null array: this process has no values. `processes`: null:
  /// this process has the whole array. `owned`: the points that count here; null: all except ghost
  /// points that the next process has, too.
  SharedArray(const FieldSource& source, vtkImageData* image, const int wholeExtent[6],
    vtkMultiProcessController* processes, const NodeBox* owned = nullptr);

  /// Returns the smallest and largest finite number of all processes; 0 if there is none.
  std::array<double, 2> FiniteRange() const;

  /// Returns about `most` finite numbers or fewer, at equal distances in the whole array, sorted.
  std::vector<double> Samples(long long most) const;

  /// Returns those of these samples that are above a value, with their neighbours. If the pieces of
  /// processes do not overlap, the border of a piece is treated like that of the image.
  std::vector<ValueWithNeighbours> SamplesAbove(double value, long long most) const;

private:
  double ValueAt(int i, int j, int k) const;
  template <class Visit>
  void VisitSamples(long long most, const Visit& visit) const;
  std::vector<double> Gathered(std::vector<double> here) const;

  vtkDataArray* Array;
  int Component;
  std::array<int, 3> First{};   ///< index of the first value here in the whole array
  std::array<int, 3> Size{};    ///< number of values here
  std::array<int, 3> Skipped{}; ///< ghost values here before the owned ones
  std::array<int, 3> Own{};     ///< number of owned values
  std::array<int, 3> Whole{};   ///< size of the whole array
  vtkMultiProcessController* Processes;
};

/// Returns whether `here` is true on any of the processes; null: one process.
VTKLIMPIDFILTERS_EXPORT bool AnyProcess(vtkMultiProcessController* processes, bool here);
}

#endif

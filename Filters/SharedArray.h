// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An array of an image, of which every process has a piece if several draw it together.

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

/// Where processes differ, all of them have to ask for the same in the same order.
class VTKLIMPIDFILTERS_EXPORT SharedArray
{
public:
  /// `source`: its array and component; an array of null: this process has no values.
  /// `processes`: null: it has all. `owned`: the points that count here; null: all but those that a
  /// process behind has, too.
  SharedArray(const FieldSource& source, vtkImageData* image, const int wholeExtent[6],
    vtkMultiProcessController* processes, const NodeBox* owned = nullptr);

  /// Smallest and largest number of all; 0 where there is none.
  std::array<double, 2> FiniteRange() const;

  /// At most about so many of the finite numbers, at equal distances in the whole array, sorted.
  std::vector<double> Samples(long long most) const;

  /// Those of these that are above a value, among their neighbours. Where the pieces of processes
  /// do not overlap, the border of a piece is as that of the image.
  std::vector<ValueAmongOthers> SamplesAbove(double value, long long most) const;

private:
  double ValueAt(int i, int j, int k) const;
  template <class Visit>
  void VisitSamples(long long most, const Visit& visit) const;
  std::vector<double> Gathered(std::vector<double> here) const;

  vtkDataArray* Array;
  int Component;
  std::array<int, 3> First{};   ///< of the values here, among all
  std::array<int, 3> Size{};    ///< of those here
  std::array<int, 3> Skipped{}; ///< of those here, before those that count
  std::array<int, 3> Own{};     ///< of those that count here, not in other processes
  std::array<int, 3> Whole{};   ///< of all
  vtkMultiProcessController* Processes;
};

/// Whether any of the processes says so; null: there is one.
VTKLIMPIDFILTERS_EXPORT bool AnyProcess(vtkMultiProcessController* processes, bool here);
}

#endif

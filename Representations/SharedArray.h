// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An array of an image, of which every process has a piece if several draw it together.

#ifndef limpid_SharedArray_h
#define limpid_SharedArray_h

#include <array>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

namespace limpid
{
/// Where processes differ, all of them have to ask for the same in the same order.
class SharedArray
{
public:
  /// `array`: null: this process has no values. `processes`: null: it has all.
  SharedArray(vtkDataArray* array, vtkImageData* image, bool onCells, const int wholeExtent[6],
    vtkMultiProcessController* processes);

  /// Smallest and largest number of all, of magnitudes if there are several components; 0 where
  /// there is none.
  std::array<double, 2> FiniteRange() const;

  /// At most about so many of the finite numbers, at equal distances in the whole array, sorted.
  std::vector<double> Samples(long long most) const;

private:
  double ValueAt(long long tuple) const;
  std::vector<double> SamplesHere(long long most) const;

  vtkDataArray* Array;
  std::array<int, 3> First{}; ///< of the values here, among all
  std::array<int, 3> Size{};  ///< of those here
  std::array<int, 3> Own{};   ///< of those that no process behind has, too
  std::array<int, 3> Whole{}; ///< of all
  vtkMultiProcessController* Processes;
};

/// Whether any of the processes says so; null: there is one.
bool AnyProcess(vtkMultiProcessController* processes, bool here);
}

#endif

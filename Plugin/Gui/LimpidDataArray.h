// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Gets data of a source and their statistics on the client, wherever the source runs.
 */

#ifndef LimpidDataArray_h
#define LimpidDataArray_h

#include "vtkSmartPointer.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkSMProxy;
class vtkSMSourceProxy;
class vtkTable;

/// Returns an output of a source on the client, as data of a type (VTK_POLY_DATA, ...). Null if it
/// has none. `time`: the time to execute it for; none: the data keep their present time.
vtkSmartPointer<vtkDataObject> BringToClient(
  vtkSMSourceProxy* source, unsigned int port, int type, std::optional<double> time);

/// An array of an output of a source.
struct LimpidDataArray
{
  vtkSMSourceProxy* Source = nullptr; ///< null: there is no such array
  unsigned int Port = 0;
  int Association = 0; ///< of vtkDataObject
  std::string Name;
  int Component = -1; ///< -1: the magnitude

  explicit operator bool() const { return this->Source != nullptr; }

  /// Returns the smallest and largest finite value; the first is larger than the second if there is
  /// none.
  std::array<double, 2> Range() const;

  /// Returns the extents of `bins` equal bins of a range ("bin_extents"), and for each bin the
  /// logarithm of its number of values plus one, so that rare values are visible. Null for an empty
  /// range.
  vtkSmartPointer<vtkTable> Histogram(const std::array<double, 2>& range, int bins) const;

  /// Returns a suggestion of important values, in the form of the property SuggestedImportance, to
  /// a few thousandths of their range. Empty if the values are importance themselves or all alike.
  std::vector<double> SuggestedImportance() const;
};

/// Returns the array of the property ImportanceArray of a display or a filter, as its panel shows
/// it. A display's name "(Color Array)" stands for the array that it is colored by.
LimpidDataArray ImportanceArrayOf(vtkSMProxy* proxy);

/// Returns the array of the property StructureArray likewise.
LimpidDataArray StructureArrayOf(vtkSMProxy* proxy);

#endif

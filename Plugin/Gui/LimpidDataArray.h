// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Data of a source, and what the client learns of them, wherever the source runs.
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

/// An output of a source, brought to the client as data of a type (VTK_POLY_DATA, ...). Null if it
/// has none. `time`: for which it is executed; none: its data stay those of the time that they are
/// for.
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

  /// Smallest and largest finite value; the first is larger than the second if there is none.
  std::array<double, 2> Range() const;

  /// The extents of `bins` equal parts of a range ("bin_extents"), and for each the logarithm of
  /// one more than the number of values in it: what is rare shows, too. Null for an empty range.
  vtkSmartPointer<vtkTable> Histogram(const std::array<double, 2>& range, int bins) const;

  /// What may be important: values as the property SuggestedImportance has them, to a part in some
  /// thousands of their range. None if the values are importance themselves, or all alike.
  std::vector<double> SuggestedImportance() const;
};

/// The array that the property ImportanceArray of a display or of a filter names, as its panel
/// shows it. A display's name "(Color Array)" stands for the array that it is colored by.
LimpidDataArray ImportanceArrayOf(vtkSMProxy* proxy);

#endif

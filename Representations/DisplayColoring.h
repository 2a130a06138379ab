// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses an array to colour a display that has no scalar colouring.

#ifndef limpid_DisplayColoring_h
#define limpid_DisplayColoring_h

#include "vtkDataObject.h" // for associations

#include <string>

class vtkSMPVRepresentationProxy;

namespace limpid
{
struct ColorArray
{
  std::string name; ///< empty: none
  int association = vtkDataObject::POINT;
};

/// Colours a display without scalar colouring by the array `first`. If there is no such array, by
/// the active scalars of the points, or else by the first array of the points, or else by the first
/// array. The array `last` is used only if there is no other.
void ColorByAnArray(
  vtkSMPVRepresentationProxy* display, const ColorArray& first, const std::string& last);
}

#endif

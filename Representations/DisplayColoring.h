// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// By which array a client lets a display be coloured that has no colouring.

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

/// Colours a display without scalar colouring by the array `first`, or if it has no such array, by
/// the active scalars of the points, or else by the first array of the points, or else by the first
/// one. `last` is for want of another one only.
void ColorByAnArray(
  vtkSMPVRepresentationProxy* display, const ColorArray& first, const std::string& last);
}

#endif

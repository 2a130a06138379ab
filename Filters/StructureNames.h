// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Names of labels, in the field data of the image that has these.

#ifndef limpid_StructureNames_h
#define limpid_StructureNames_h

#include <cstdint>
#include <map>
#include <string>

class vtkImageData;

namespace limpid
{
using StructureNames = std::map<std::int64_t, std::string>; ///< by label

/// Gives names to an image, as the arrays "StructureLabels" and "StructureNames", unless there are
/// none.
void SetStructureNames(const StructureNames& names, vtkImageData* image);

/// Returns the names that an image has.
StructureNames StructureNamesOf(vtkImageData* image);
}

#endif

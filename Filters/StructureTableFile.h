// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Names and colours of labels from a text file.

#ifndef limpid_StructureTableFile_h
#define limpid_StructureTableFile_h

#include "StructureLooks.h"

#include <string>

namespace limpid
{
/// The names and colours that a file gives to labels.
struct StructureTableFile
{
  StructureLooks looks;
  std::string warning; ///< what could not be read; empty: everything was
};

/// Reads a file in one of the forms that vtkAddStructures lists.
StructureTableFile ReadStructureTable(const std::string& path);
}

#endif

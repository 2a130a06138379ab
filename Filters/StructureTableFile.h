// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Names of labels from a text file.

#ifndef limpid_StructureTableFile_h
#define limpid_StructureTableFile_h

#include <cstdint>
#include <map>
#include <string>

namespace limpid
{
/// The names that a file gives to labels.
struct StructureTableFile
{
  std::map<std::int64_t, std::string> names;
  std::string warning; ///< what could not be read; empty: everything was
};

/// Reads a file in one of the forms that vtkAddStructures lists.
StructureTableFile ReadStructureTable(const std::string& path);
}

#endif

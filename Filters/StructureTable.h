// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_StructureTable_h
#define limpid_StructureTable_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include "viewpoint/MeetTargets.h"

#include <string>
#include <vector>

class vtkTable;

namespace limpid
{
/// Returns the names of structures that have nothing to see, for a message; empty: there are none.
std::string StructuresWithoutMatter(
  const Structures& structures, const std::vector<StructureShares>& shares);

/// Fills a table with one row per structure, see vtkExtinctionOptimizer. `given`: the structures
/// with the importances given; columns of shares are left out if they are not known.
VTKLIMPIDFILTERS_EXPORT void FillStructures(
  const Structures& given, const TargetsFound& found, vtkTable* table);
}

#endif

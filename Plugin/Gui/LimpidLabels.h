// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Finds the labels of a structure array, their names and colours, on the client.
 */

#ifndef LimpidLabels_h
#define LimpidLabels_h

#include "StructureLooks.h"

#include <QString>

class vtkSMProxy;

/// The labels in data.
struct LimpidLabels
{
  limpid::StructureLooks Looks; ///< all labels but 0, with their names and colours
  QString Problem;              ///< why there are none; empty: there are some
};

/// Returns the labels of the property StructureArray of a display or a filter. Their names and
/// colours are those of the table "Structures" that the source has as another output, or else the
/// annotations of the array's color map; without either, a name is "label 5".
LimpidLabels LabelsOf(vtkSMProxy* proxy);

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Finds the labels of a structure array, and their names, on the client.
 */

#ifndef LimpidLabels_h
#define LimpidLabels_h

#include <QString>

#include <cstdint>
#include <map>

class vtkSMProxy;

/// The labels in data.
struct LimpidLabels
{
  std::map<std::int64_t, QString> Names; ///< all labels but 0, with their names
  QString Problem;                       ///< why there are none; empty: there are some
};

/// Returns the labels of the property StructureArray of a display or a filter. Their names are
/// those of the table "Structures" that the source has as another output, or else the annotations
/// of the array's color map; without either, "label 5".
LimpidLabels LabelsOf(vtkSMProxy* proxy);

#endif

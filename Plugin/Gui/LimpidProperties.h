// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Copies properties of proxies by name.
 */

#ifndef LimpidProperties_h
#define LimpidProperties_h

#include <functional>
#include <string>
#include <vector>

class vtkSMProperty;
class vtkSMProxy;

/// Calls `act` for all properties of a proxy except information properties, with their names.
void ForEachProperty(
  vtkSMProxy* proxy, const std::function<void(const std::string&, vtkSMProperty*)>& act);

/// Copies the value of a property, unless the value is a proxy or either property is null.
void CopyValue(vtkSMProperty* property, vtkSMProperty* from);

/// Returns the points of the function that is the value of a proxy's property; empty if there is
/// none.
std::vector<double> PointsOf(vtkSMProxy* owner, const char* name);

/// Sets these points, unless there are none. The trace includes this.
void SetPoints(vtkSMProxy* owner, const char* name, const std::vector<double>& points);

#endif

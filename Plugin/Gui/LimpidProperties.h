// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Properties of proxies, copied by name.
 */

#ifndef LimpidProperties_h
#define LimpidProperties_h

#include <functional>
#include <string>
#include <vector>

class vtkSMProperty;
class vtkSMProxy;

/// Calls `act` for all properties of a proxy but those that only inform, with their names.
void ForEachProperty(
  vtkSMProxy* proxy, const std::function<void(const std::string&, vtkSMProperty*)>& act);

/// Copies the value of a property unless that is a proxy, or either is null.
void CopyValue(vtkSMProperty* property, vtkSMProperty* from);

/// Points of the function that a property of a proxy holds; none if it holds none.
std::vector<double> PointsOf(vtkSMProxy* owner, const char* name);

/// Sets these points, unless there are none, which the trace has.
void SetPoints(vtkSMProxy* owner, const char* name, const std::vector<double>& points);

#endif

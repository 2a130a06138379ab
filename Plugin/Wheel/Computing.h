// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_wheel_Computing_h
#define limpid_wheel_Computing_h

#include <nanobind/nanobind.h>

#include <functional>
#include <string>

namespace limpid::python
{
/**
 * Calls a function that computes and touches nothing of Python's, while other threads of Python
 * run. A signal whose handler raises an exception, as Ctrl-C does, ends it: the exception goes on
 * from here.
 */
void ComputeBesidePython(const std::function<void()>& compute);

/// A callable of Python's, called with the share of the work that is done and a text, which returns
/// false to stop; no function for None. The callable has to outlive it.
std::function<bool(double, const std::string&)> ToProgress(const nanobind::object& callable);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_wheel_Computing_h
#define limpid_wheel_Computing_h

#include <nanobind/nanobind.h>

#include <functional>
#include <string>

namespace limpid::python
{
/// A function that is called with the share of the last parallel loop that is done, in [0, 1]. It
/// may use Python objects and throw exceptions of Python.
using Listener = std::function<void(double)>;

/**
 * Calls a function that computes without touching Python objects, while other Python threads run. A
 * signal whose handler raises an exception, as Ctrl-C does, interrupts it, and so does an exception
 * of the listener, which is called some times per second; this function then throws that exception.
 */
void ComputeBesidePython(
  const std::function<void()>& compute, const Listener& listener = Listener());

/// Converts a Python callable to a progress function; None to an empty function. The callable gets
/// the share of the work that is done and a text, and returns false to stop. It must outlive the
/// result.
std::function<bool(double, const std::string&)> ToProgress(const nanobind::object& callable);
}

#endif

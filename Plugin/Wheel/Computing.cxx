// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Computing.h"

#include "backend/Interruption.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

namespace nb = nanobind;

namespace limpid::python
{
namespace
{
// Returns false once a signal handler or the listener has raised an exception. Python calls
// handlers only when asked, and only in its main thread.
bool GoOn(const Listener& listener, double share)
{
  const nb::gil_scoped_acquire acquired;
  if (PyErr_CheckSignals() != 0)
  {
    return false;
  }
  try
  {
    if (listener)
    {
      listener(share);
    }
    return true;
  }
  catch (nb::python_error& error)
  {
    error.restore();
    return false;
  }
}

// Returns false if interrupted.
bool Compute(const std::function<void()>& compute, const Listener& listener)
{
  const nb::gil_scoped_release released;
  try
  {
    const Interruptible interruptible([&](double share) { return GoOn(listener, share); });
    compute();
    return true;
  }
  catch (const Interrupted&)
  {
    return false;
  }
}
}

void ComputeBesidePython(const std::function<void()>& compute, const Listener& listener)
{
  if (!Compute(compute, listener))
  {
    throw nb::python_error(); // the exception that the handler or the listener raised
  }
}

std::function<bool(double, const std::string&)> ToProgress(const nb::object& callable)
{
  if (callable.is_none())
  {
    return {};
  }
  return [&callable](double share, const std::string& text)
  {
    const nb::gil_scoped_acquire acquired;
    return !callable(share, text).equal(nb::bool_(false));
  };
}
}

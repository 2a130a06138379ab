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
// Returns false once a signal handler has raised an exception. Python calls handlers only when
// asked, and only in its main thread.
bool GoOn()
{
  const nb::gil_scoped_acquire acquired;
  return PyErr_CheckSignals() == 0;
}

// Returns false if interrupted.
bool Compute(const std::function<void()>& compute)
{
  const nb::gil_scoped_release released;
  try
  {
    const Interruptible interruptible(GoOn);
    compute();
    return true;
  }
  catch (const Interrupted&)
  {
    return false;
  }
}
}

void ComputeBesidePython(const std::function<void()>& compute)
{
  if (!Compute(compute))
  {
    throw nb::python_error(); // the exception that the handler raised
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

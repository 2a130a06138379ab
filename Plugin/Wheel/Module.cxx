// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Bindings.h"

#include "math/Require.h"

#include <exception>

namespace nb = nanobind;

namespace
{
// Converts errors about the user's data to ValueError with the same message.
void TranslateErrors(const std::exception_ptr& thrown, void*)
{
  try
  {
    std::rethrow_exception(thrown);
  }
  catch (const limpid::DeviceError& error)
  {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
  catch (const limpid::Error& error)
  {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}
}

NB_MODULE(_core, module)
{
  module.doc() = "The core of Limpid, for the package limpid.";
  module.attr("version") = LIMPID_VERSION;
  nb::register_exception_translator(TranslateErrors);
  limpid::python::BindScene(module);
  limpid::python::BindSettings(module);
  limpid::python::BindOptimize(module);
  limpid::python::BindViewpoints(module);
  limpid::python::BindRender(module);
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of the extension module limpid._core, which the Python package in Plugin/Wheel/limpid
// wraps. That package checks and converts all arguments; nothing else calls the module.

#ifndef limpid_wheel_Bindings_h
#define limpid_wheel_Bindings_h

#include <nanobind/nanobind.h>

namespace limpid::python
{
/// Binds Grid, Camera, Light, and their automatic placement.
void BindScene(nanobind::module_& module);

/// Binds the settings of the optimiser and their enumerations.
void BindSettings(nanobind::module_& module);

/// Binds the function optimize.
void BindOptimize(nanobind::module_& module);

/// Binds the function search_viewpoints.
void BindViewpoints(nanobind::module_& module);

/// Binds Lighting and the function render.
void BindRender(nanobind::module_& module);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of the module limpid._core, which Plugin/Wheel/limpid makes a Python package of. It
// takes what that package has checked and put in order: nobody else calls it.

#ifndef limpid_wheel_Bindings_h
#define limpid_wheel_Bindings_h

#include <nanobind/nanobind.h>

namespace limpid::python
{
/// Grid, Camera, Light, and where they stand when nobody has placed them.
void BindScene(nanobind::module_& module);

/// Settings of the optimiser, and their choices.
void BindSettings(nanobind::module_& module);

/// The function optimize.
void BindOptimize(nanobind::module_& module);

/// The function search_viewpoints.
void BindViewpoints(nanobind::module_& module);

/// Lighting, and the function render.
void BindRender(nanobind::module_& module);
}

#endif

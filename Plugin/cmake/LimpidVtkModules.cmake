# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The VTK modules without ParaView, as shared libraries and as the Python package "limpid".
# The VTK inside ParaView will do: -DVTK_DIR=.../cmake/paraview-5.11/vtk.

include(PredeclareMissingPythonTargets)
limpid_predeclare_missing_python_targets(VTK)

find_package(VTK 9.2 REQUIRED
  COMPONENTS
    CommonExecutionModel FiltersCore FiltersModeling FiltersSources ImagingCore ParallelCore
    RenderingOpenGL2 RenderingVolume
  OPTIONAL_COMPONENTS
    WrappingPythonCore)
message(STATUS "Limpid: modules for VTK ${VTK_VERSION}, Python wrapping ${VTK_WRAP_PYTHON}")

vtk_module_scan(
  MODULE_FILES
    "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Representations/Rendering/vtk.module"
  REQUEST_MODULES Limpid::Filters Limpid::Rendering
  PROVIDES_MODULES modules
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${modules}
  VERSION "${PROJECT_VERSION}")

if (VTK_WRAP_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  set(LIMPID_PYTHON_DESTINATION "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
  vtk_module_wrap_python(
    MODULES ${modules}
    PYTHON_PACKAGE "limpid"
    MODULE_DESTINATION "${LIMPID_PYTHON_DESTINATION}"
    CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/Limpid"
    WRAPPED_MODULES wrapped
    TARGET Limpid::python)
endif ()

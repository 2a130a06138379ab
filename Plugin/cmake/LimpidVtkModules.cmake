# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The VTK modules without ParaView, as shared libraries and as the Python package "limpid".
# The VTK inside ParaView will do: -DVTK_DIR=.../cmake/paraview-5.11/vtk.

include(PredeclareMissingPythonTargets)
limpid_predeclare_missing_python_targets(VTK)

# What the modules are made of; who uses them looks for it, too.
set(LIMPID_VTK_COMPONENTS
  CommonExecutionModel FiltersCore FiltersModeling FiltersSources ImagingCore ParallelCore
  RenderingOpenGL2 RenderingVolume zlib)
find_package(VTK 9.2 REQUIRED
  COMPONENTS ${LIMPID_VTK_COMPONENTS}
  OPTIONAL_COMPONENTS
    ParallelMPI WrappingPythonCore)
message(STATUS "Limpid: modules for VTK ${VTK_VERSION}, Python wrapping ${VTK_WRAP_PYTHON}")

vtk_module_scan(
  MODULE_FILES
    "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Representations/Rendering/vtk.module"
  REQUEST_MODULES Limpid::Filters Limpid::Rendering
  PROVIDES_MODULES modules
  ENABLE_TESTS OFF)
set(export)
if (BUILD_SHARED_LIBS)
  set(export INSTALL_EXPORT Limpid) # static ones would need targets that nobody else is to have
endif ()
vtk_module_build(
  MODULES ${modules}
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
  PACKAGE Limpid
  ${export}
  HEADERS_DESTINATION "${LIMPID_VTK_HEADERS_DESTINATION}"
  CMAKE_DESTINATION "${LIMPID_CMAKE_DESTINATION}")

if (VTK_WRAP_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  # No headers: there would be one, python.h, that is of use for static modules alone.
  vtk_module_wrap_python(
    MODULES ${modules}
    PYTHON_PACKAGE "limpid"
    MODULE_DESTINATION "${LIMPID_PYTHON_DESTINATION}"
    LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    INSTALL_HEADERS OFF
    WRAPPED_MODULES wrapped
    TARGET Limpid::python)
endif ()

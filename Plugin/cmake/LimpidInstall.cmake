# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What is installed below the prefix; all of it may be moved afterwards.
#   limpid-paraview  the plugins, and nothing that they are made of;
#   limpid-vtk       VTK modules with headers, the Python package, and the core;
#   limpid-core      the core with its headers.
# The latter two are what find_package(Limpid) finds: see LimpidConfig.cmake.in.

if (LIMPID_ENABLE_PARAVIEW)
  set(LIMPID_PACKAGE limpid-paraview)
elseif (LIMPID_ENABLE_VTK)
  set(LIMPID_PACKAGE limpid-vtk)
else ()
  set(LIMPID_PACKAGE limpid-core)
endif ()

install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${LIMPID_PACKAGE}"
  RENAME copyright)

if (LIMPID_ENABLE_PARAVIEW)
  install(TARGETS Limpid
    LIBRARY DESTINATION "${LIMPID_PLUGIN_DESTINATION}/Limpid")
  return ()
endif ()

# The modules have been given their rules where they are made.
install(TARGETS limpid_core
  EXPORT LimpidCore
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
foreach (folder IN ITEMS
    backend compute distributed energy math methods optimize render scene sweep viewpoint)
  install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/cuda/${folder}"
    DESTINATION "${LIMPID_CORE_HEADERS_DESTINATION}"
    FILES_MATCHING PATTERN "*.h")
endforeach ()

install(EXPORT LimpidCore
  NAMESPACE Limpid::
  FILE LimpidCore-targets.cmake
  DESTINATION "${LIMPID_CMAKE_DESTINATION}")

set(components Core)
if (LIMPID_ENABLE_VTK AND BUILD_SHARED_LIBS)
  list(APPEND components Filters Rendering)
  math(EXPR next_minor "${VTK_MINOR_VERSION} + 1")
  set(vtk_versions "${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}...<${VTK_MAJOR_VERSION}.${next_minor}")
endif ()
include(CMakePackageConfigHelpers)
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/LimpidConfig.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/LimpidConfig.cmake"
  INSTALL_DESTINATION "${LIMPID_CMAKE_DESTINATION}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/LimpidConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(
  FILES
    "${CMAKE_CURRENT_BINARY_DIR}/LimpidConfig.cmake"
    "${CMAKE_CURRENT_BINARY_DIR}/LimpidConfigVersion.cmake"
    "${CMAKE_CURRENT_LIST_DIR}/PredeclareMissingPythonTargets.cmake"
  DESTINATION "${LIMPID_CMAKE_DESTINATION}")

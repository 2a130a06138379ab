# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What every configuration needs: a build type, where results go, warnings, sanitizers, names of
# files in messages.

get_property(multipleConfigurations GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if (NOT CMAKE_BUILD_TYPE AND NOT multipleConfigurations)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif ()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")

# Below the prefix.
set(LIMPID_CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/Limpid")
set(LIMPID_CORE_HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/limpid")
set(LIMPID_VTK_HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/limpid/vtk")
set(LIMPID_PYTHON_DESTINATION "lib/python3/dist-packages"
  CACHE STRING "Folder below the prefix for the Python package limpid")

# Our own sources link to one of these, PRIVATE; code that VTK generates does not.
#   limpid_warnings      for all that is plain C++;
#   limpid_vtk_warnings  for VTK classes, whose macros leave semicolons that ISO C++ does not want.
function (limpid_add_warnings)
  set(gnuLike "$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>")
  add_library(limpid_vtk_warnings INTERFACE)
  target_compile_options(limpid_vtk_warnings
    INTERFACE
      "$<${gnuLike}:-Wall;-Wextra;-Wshadow>")
  if (LIMPID_WARNINGS_AS_ERRORS)
    target_compile_options(limpid_vtk_warnings
      INTERFACE
        "$<${gnuLike}:-Werror>")
  endif ()
  add_library(limpid_warnings INTERFACE)
  target_link_libraries(limpid_warnings
    INTERFACE
      limpid_vtk_warnings)
  target_compile_options(limpid_warnings
    INTERFACE
      "$<${gnuLike}:-Wpedantic>")
endfunction ()

# Sanitizers have to see the whole program, so this one flag is for all targets.
function (limpid_add_sanitizers)
  if (LIMPID_SANITIZE)
    add_compile_options("-fsanitize=${LIMPID_SANITIZE}" -fno-omit-frame-pointer -g)
    add_link_options("-fsanitize=${LIMPID_SANITIZE}")
  endif ()
endfunction ()

# VTK's messages name a file (__FILE__): as the repository does, and not as the machine that compiled
# it. Headers are compiled into what VTK generates, too, so this is for all targets that follow.
function (limpid_hide_folders)
  foreach (folder IN ITEMS "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}")
    add_compile_options(
      "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-fmacro-prefix-map=${folder}/=>")
  endforeach ()
endfunction ()

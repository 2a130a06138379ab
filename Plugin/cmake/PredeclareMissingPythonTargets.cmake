# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Debian's ParaView 5.13 and 6.1 install their Python extension modules under names with an ABI
# tag (vtkX.cpython-313-x86_64-linux-gnu.so), but their CMake files say vtkX.so. CMake then stops
# in find_package, although nobody links to those modules. An export set whose targets all exist
# already is passed over, so we declare the targets of every set that names a missing file. Where
# no file is missing, nothing happens.

# The folders of the package's CMake files that find_package would consider, without loading any:
# no package has this version.
function (limpid_package_folders package result)
  set(chosen "${${package}_DIR}")
  find_package(${package} 9999 EXACT QUIET CONFIG)
  set(folders)
  if (chosen)
    set(${package}_DIR "${chosen}" CACHE PATH "" FORCE)
    list(APPEND folders "${chosen}")
  else ()
    unset(${package}_DIR CACHE)
    foreach (config IN LISTS ${package}_CONSIDERED_CONFIGS)
      cmake_path(GET config PARENT_PATH folder)
      list(APPEND folders "${folder}")
    endforeach ()
  endif ()
  set(${result} "${folders}" PARENT_SCOPE)
endfunction ()

# The folder that the paths in an export file start from: as many levels up as the file goes.
function (limpid_import_prefix exportFile text result)
  set(folder "${exportFile}")
  string(REGEX MATCHALL "_IMPORT_PREFIX \"[^\"]*\" PATH" steps "${text}")
  foreach (step IN LISTS steps)
    cmake_path(GET folder PARENT_PATH folder)
  endforeach ()
  if (folder STREQUAL "/")
    set(folder "")
  endif ()
  set(${result} "${folder}" PARENT_SCOPE)
endfunction ()

function (limpid_has_missing_files exportFile text result)
  limpid_import_prefix("${exportFile}" "${text}" prefix)
  cmake_path(REMOVE_EXTENSION exportFile LAST_ONLY OUTPUT_VARIABLE stem)
  file(GLOB locationFiles "${stem}-*.cmake")
  set(${result} FALSE PARENT_SCOPE)
  foreach (locationFile IN LISTS locationFiles)
    file(STRINGS "${locationFile}" lines REGEX "IMPORTED_LOCATION_")
    foreach (line IN LISTS lines)
      if (line MATCHES "{_IMPORT_PREFIX}([^\"]+)\"")
        if (NOT EXISTS "${prefix}${CMAKE_MATCH_1}")
          set(${result} TRUE PARENT_SCOPE)
          return ()
        endif ()
      endif ()
    endforeach ()
  endforeach ()
endfunction ()

function (limpid_predeclare_missing_python_targets package)
  limpid_package_folders(${package} folders)
  if (NOT folders)
    return ()
  endif ()
  list(GET folders 0 folder)
  file(GLOB exportFiles
    "${folder}/*Python*-targets.cmake"
    "${folder}/vtk/*Python*-targets.cmake")
  foreach (exportFile IN LISTS exportFiles)
    file(READ "${exportFile}" text)
    limpid_has_missing_files("${exportFile}" "${text}" missing)
    if (NOT missing)
      continue ()
    endif ()
    message(STATUS "Limpid: declaring the targets of ${exportFile}, whose files are missing")
    string(REGEX MATCHALL "add_library\\([^)]* IMPORTED" declarations "${text}")
    foreach (declaration IN LISTS declarations)
      string(REGEX MATCH "add_library\\(([^ ]+) ([A-Z]+) IMPORTED" matched "${declaration}")
      if (matched AND NOT TARGET "${CMAKE_MATCH_1}")
        add_library("${CMAKE_MATCH_1}" ${CMAKE_MATCH_2} IMPORTED)
      endif ()
    endforeach ()
  endforeach ()
endfunction ()

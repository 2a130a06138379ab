# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Sources that are made from the table of settings, cuda/optimize/Settings.xml, by settings.py.

set(LIMPID_SETTINGS_SOURCES
  "${CMAKE_CURRENT_LIST_DIR}/settings.py"
  "${CMAKE_CURRENT_LIST_DIR}/../../cuda/optimize/Settings.xml")

# Not find_package(Python3), which would decide here for which Python VTK and ParaView wrap.
find_program(LIMPID_PYTHON
  NAMES "${Python3_EXECUTABLE}" python3 python
  DOC "Python 3, which makes sources from the table of settings"
  REQUIRED)

# Writes <output> from the template <input>, whenever CMake configures.
function (limpid_fill_in_settings input output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${input}" ${LIMPID_SETTINGS_SOURCES})
  list(GET LIMPID_SETTINGS_SOURCES 0 program)
  execute_process(
    COMMAND "${LIMPID_PYTHON}" -B "${program}" "${input}" "${output}"
    COMMAND_ERROR_IS_FATAL ANY)
endfunction ()

# The same for a header whose macros VTK's wrappers expand. They look at the headers of classes only,
# so that what they made of the macros before is removed.
function (limpid_fill_in_wrapped_macros input output)
  set(before)
  if (EXISTS "${output}")
    file(READ "${output}" before)
  endif ()
  limpid_fill_in_settings("${input}" "${output}")
  file(READ "${output}" after)
  if (NOT before STREQUAL after)
    file(GLOB_RECURSE wrappings
      "${CMAKE_BINARY_DIR}/*/vtk*Python.cxx"
      "${CMAKE_BINARY_DIR}/*/vtk*ClientServer.cxx")
    list(FILTER wrappings INCLUDE REGEX "/vtkLimpid[A-Za-z]*(Python|CS)/")
    if (wrappings)
      file(REMOVE ${wrappings})
    endif ()
  endif ()
endfunction ()

# ParaView 6.1 shows rectilinear grids by a proxy of its own. They are refused by a message that says
# what to do, for which the representation type has to be there, too.
function (limpid_extend_rectilinear_grids text result)
  if (ParaView_VERSION VERSION_GREATER_EQUAL 6.1)
    set(images "<Extension name=\"UniformGridRepresentation\">")
    string(REGEX MATCH "${images}.*</Extension>" extension "${text}")
    if (extension)
      string(REPLACE "${images}" "<Extension name=\"RectilinearGridRepresentation\">"
        likewise "${extension}")
      string(REPLACE "${extension}" "${extension}\n\n    ${likewise}" text "${text}")
    endif ()
  endif ()
  set(${result} "${text}" PARENT_SCOPE)
endfunction ()

# Writes the server manager's XML file <output> from <input>, with all settings put in.
function (limpid_configure_xml input output)
  limpid_fill_in_settings("${input}" "${output}.in")
  file(READ "${output}.in" text)
  limpid_extend_rectilinear_grids("${text}" text)
  file(CONFIGURE OUTPUT "${output}" CONTENT "${text}" @ONLY)
endfunction ()

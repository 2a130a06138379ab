# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Whether the plugin for ParaView's window, lib/LimpidGui/LimpidGui.so, is built: it needs Qt's
# development files, which nothing else does.

set(LIMPID_ENABLE_GUI AUTO
  CACHE STRING "Build the plugin for ParaView's window: ON, OFF, or AUTO if Qt's files are there")
set_property(CACHE LIMPID_ENABLE_GUI PROPERTY STRINGS AUTO ON OFF)

# Sets <result> to the names of all libraries in the link closure of the target <name> for which
# there is no target.
function (limpid_missing_dependencies name result)
  set(waiting "${name}")
  set(seen)
  set(missing)
  while (waiting)
    list(POP_FRONT waiting library)
    if (library IN_LIST seen OR NOT library MATCHES "^[A-Za-z0-9_]+::[A-Za-z0-9_]+$")
      continue ()
    endif ()
    list(APPEND seen "${library}")
    if (NOT TARGET "${library}")
      list(APPEND missing "${library}")
      continue ()
    endif ()
    get_target_property(configurations "${library}" IMPORTED_CONFIGURATIONS)
    set(properties INTERFACE_LINK_LIBRARIES)
    foreach (configuration IN LISTS configurations)
      list(APPEND properties "IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration}")
    endforeach ()
    foreach (property IN LISTS properties)
      get_target_property(libraries "${library}" "${property}")
      if (libraries)
        list(APPEND waiting ${libraries})
      endif ()
    endforeach ()
  endwhile ()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction ()

# Sets <result> to the header of VTK's Qt module if it is missing, empty if not. The target alone
# tells nothing: Debian has the headers in a package of their own where VTK is its own.
function (limpid_missing_qt_header result)
  set(${result} "" PARENT_SCOPE)
  if (TARGET VTK::GUISupportQt)
    get_target_property(folders VTK::GUISupportQt INTERFACE_INCLUDE_DIRECTORIES)
    # Since VTK 9.6 they are those of a set of headers.
    get_target_property(foldersOfSet VTK::GUISupportQt HEADER_DIRS_vtk_module_headers)
    find_file(header vtkGUISupportQtModule.h PATHS ${folders} ${foldersOfSet}
      NO_DEFAULT_PATH NO_CACHE)
    if (NOT header)
      set(${result} "vtkGUISupportQtModule.h (Debian: libvtk9-qt-dev)" PARENT_SCOPE)
    endif ()
  endif ()
endfunction ()

# Sets <result> to what is missing for the plugin, empty if nothing. A function, because looking
# for ParaView's widgets must not change what the caller found.
function (limpid_find_gui result)
  if (NOT PARAVIEW_USE_QT OR NOT TARGET ParaView::pqComponents)
    set(${result} "a ParaView that was built with Qt" PARENT_SCOPE)
    return ()
  endif ()
  find_package(ParaView QUIET
    COMPONENTS RemotingViews
    OPTIONAL_COMPONENTS RemotingServerManager pqComponents pqCore)
  limpid_missing_dependencies(ParaView::pqComponents missing)
  set(qt "${missing}")
  list(FILTER qt INCLUDE REGEX "^Qt")
  limpid_missing_qt_header(header)
  list(APPEND qt ${header})
  list(JOIN qt " " qt)
  set(${result} "${qt}" PARENT_SCOPE)
  if (qt)
    return ()
  endif ()
  # CMake wants a target for every library in the closure, however far off (NetCDF, HDF5, ...),
  # although all it does with the distant ones is to look where they lie. Their development files
  # would be needed for nothing else.
  foreach (library IN LISTS missing)
    add_library("${library}" INTERFACE IMPORTED)
  endforeach ()
endfunction ()

set(LIMPID_GUI FALSE)
if (LIMPID_ENABLE_GUI)
  limpid_find_gui(missing)
  if (NOT missing)
    set(LIMPID_GUI TRUE)
    message(STATUS "Limpid: with the parts for ParaView's window (LimpidGui)")
  elseif (LIMPID_ENABLE_GUI STREQUAL "AUTO")
    message(STATUS "Limpid: without the parts for ParaView's window (LimpidGui); missing: ${missing}")
  else ()
    message(FATAL_ERROR
      "LIMPID_ENABLE_GUI is ${LIMPID_ENABLE_GUI}, but this is missing: ${missing} "
      "(the plugin for ParaView's window is made of Qt widgets). "
      "Install it, see README.md, or set LIMPID_ENABLE_GUI to AUTO or OFF.")
  endif ()
endif ()

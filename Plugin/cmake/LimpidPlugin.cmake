# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The ParaView plugin: lib/Limpid/Limpid.so, and for ParaView's window lib/LimpidGui/LimpidGui.so.

include(PredeclareMissingPythonTargets)
limpid_predeclare_missing_python_targets(ParaView)

# With COMPONENTS only what these components need must be installed, not what all of ParaView
# needs. RemotingServerManager, on which RemotingViews depends, is named for the packages that
# it looks for itself (Python); it is optional because that list is longer than what we use.
find_package(ParaView 5.11 REQUIRED
  COMPONENTS RemotingViews
  OPTIONAL_COMPONENTS RemotingServerManager)
message(STATUS "Limpid: plugin for ParaView ${ParaView_VERSION} (VTK ${VTK_VERSION})")

include(LimpidGui)
set(plugin_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin")
if (LIMPID_GUI)
  list(APPEND plugin_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Gui/paraview.plugin")
endif ()

paraview_plugin_scan(
  PLUGIN_FILES ${plugin_files}
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON)
# Installed, they lie where ParaView keeps its own plugins.
set(LIMPID_PLUGIN_DESTINATION "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
paraview_plugin_build(
  PLUGINS ${plugins}
  AUTOLOAD ${plugins}
  LIBRARY_DESTINATION "${LIMPID_PLUGIN_DESTINATION}"
  PLUGINS_COMPONENT runtime
  TARGET_COMPONENT runtime
  INSTALL_HEADERS OFF
  PLUGINS_FILE_NAME "limpid.plugins.xml")

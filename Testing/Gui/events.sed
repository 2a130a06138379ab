# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What stories press again and again, as events of ParaView's test player (run-story.sh). A word stands
# alone in a line. First what takes several steps.

# Tools > Manage Plugins
s|<load-plugins/>|\
  <pqevent object="pqClientMainWindow/menubar/menuTools" command="activate" arguments="actionManage_Plugins" />\
  <pqevent object="pqClientMainWindow/PluginManagerDialog/splitter/localGroup/loadLocal" command="activate" arguments="" />\
  <pqevent object="pqClientMainWindow/PluginManagerDialog/pqFileDialog" command="filesSelected" arguments="$PARAVIEW_TEST_ROOT/Limpid.so" />\
  <pqevent object="pqClientMainWindow/PluginManagerDialog/splitter/localGroup/loadLocal" command="activate" arguments="" />\
  <pqevent object="pqClientMainWindow/PluginManagerDialog/pqFileDialog" command="filesSelected" arguments="$PARAVIEW_TEST_ROOT/LimpidGui.so" />\
  <pqevent object="pqClientMainWindow/PluginManagerDialog/buttonBox/1QPushButton0" command="activate" arguments="" />|

# File > Open, Apply
s|<open-volume/>|\
  <pqevent object="pqClientMainWindow/menubar/menu_File" command="activate" arguments="actionFileOpen" />\
  <pqevent object="pqClientMainWindow/FileOpenDialog" command="filesSelected" arguments="$PARAVIEW_TEST_ROOT/volume.vti" />\
  <apply/>|

# Colors and opacity from fat upwards
s|<rescale-to-fat/>|\
  <pqevent object="pqClientMainWindow/variableToolbar/actionRescaleCustomRange" command="activate" arguments="" />\
  <pqevent object="pqClientMainWindow/pqRescaleRangeDialog/MinimumScalar" command="set_string" arguments="32" />\
  <pqevent object="pqClientMainWindow/pqRescaleRangeDialog/MaximumScalar" command="set_string" arguments="200" />\
  <pqevent object="pqClientMainWindow/pqRescaleRangeDialog/RescaleButton" command="activate" arguments="" />|

# Bone as what is important
s|<choose-bone/>|\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceArray/ComboBox" command="set_string" arguments="ct" />\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/UseImportanceFunction/CheckBox" command="set_boolean" arguments="true" />\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceFunction/rangeMin" command="set_string" arguments="85" />\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceFunction/rangeMax" command="set_string" arguments="115" />|

# The point of the curve where importance begins, from 80 on
s|<move-point-of-curve/>|\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceFunction/ImportanceEditor/Chart/1QVTKWidget0" command="mousePress" arguments="(0.37,0.9,1,1,0)" />\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceFunction/ImportanceEditor/Chart/1QVTKWidget0" command="mouseRelease" arguments="(0.37,0.9,1,0,0)" />\
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel/ImportanceFunction/ImportanceEditor/PointValue" command="set_string" arguments="80" />|

# File > Save State
s|<save-state/>|\
  <pqevent object="pqClientMainWindow/menubar/menu_File" command="activate" arguments="actionFileSaveServerState" />\
  <pqevent object="pqClientMainWindow/FileSaveServerStateDialog" command="filesSelected" arguments="$PARAVIEW_TEST_ROOT/state.pvsm" />|

# One press each
s|<apply/>|<pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/Accept" command="activate" arguments="" />|
s|<show-optimized/>|<pqevent object="pqClientMainWindow/representationToolbar/displayRepresentation/comboBox" command="set_string" arguments="Optimized Volume" />|
s|<undo/>|<pqevent object="pqClientMainWindow/MainControlsToolbar/actionUndo" command="activate" arguments="" />|
s|<redo/>|<pqevent object="pqClientMainWindow/MainControlsToolbar/actionRedo" command="activate" arguments="" />|
s|<delete-all/>|<pqevent object="pqClientMainWindow/menubar/menu_Edit" command="activate" arguments="actionDelete_All" />|
s|<press-original/>|<pqevent object="pqClientMainWindow/LimpidToolbar/ShowOriginal" command="mousePress" arguments="1,1,0,5,5" />|
s|<release-original/>|<pqevent object="pqClientMainWindow/LimpidToolbar/ShowOriginal" command="mouseRelease" arguments="1,0,0,5,5" />|

# <proceed/> presses the macro "Proceed", <proceed quietly="1"/> the key that story.listen waits for:
# F9, also in another frame of the layout.
s|<proceed/>|<pqevent object="pqClientMainWindow/MacrosToolbar/1QToolButton0" command="activate" arguments="" />|
s|<proceed quietly="1"/>|<proceed quietly="1" frame="0"/>|
s|<proceed quietly="1" frame="\(.\)"/>|<pqevent object="pqClientMainWindow/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1/Container/Frame.\1/CentralWidgetFrame/Viewport/1QVTKOpenGLNativeWidget0" command="keyEvent" arguments="6:16777272:0::0:1" />|

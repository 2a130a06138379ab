# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# One text for properties that several proxies have. Filters/VisibilitySettings.xml holds them, and a
# proxy takes one of them with
#   <Setting name="ViewWeight" shown_if="Method=0" panel_visibility="advanced"/>
# where shown_if names another property of the proxy and the value with which this one is shown;
# other attributes replace those of the property.

set(LIMPID_SETTINGS_XML "${CMAKE_CURRENT_LIST_DIR}/../../Filters/VisibilitySettings.xml")

# Sets <result> to the property that the element <use> stands for.
function (limpid_expand_setting use result)
  file(READ "${LIMPID_SETTINGS_XML}" settings)
  string(REGEX MATCH "name=\"[A-Za-z]+\"" name "${use}")
  if (NOT settings MATCHES "<([A-Za-z]+Property) ${name}[^>]*>")
    message(FATAL_ERROR "VisibilitySettings.xml has no property for ${use}")
  endif ()
  set(tag "${CMAKE_MATCH_0}")
  set(closing "</${CMAKE_MATCH_1}>")
  string(FIND "${settings}" "${tag}" begin)
  string(SUBSTRING "${settings}" ${begin} -1 property)
  string(FIND "${property}" "${closing}" end)
  string(LENGTH "${tag}" begin)
  math(EXPR length "${end} - ${begin}")
  string(SUBSTRING "${property}" ${begin} ${length} content)

  string(REGEX MATCHALL "[a-z_]+=\"[^\"]*\"" attributes "${use}")
  foreach (attribute IN LISTS attributes)
    if (attribute MATCHES "^shown_if=\"([A-Za-z]+)=([0-9]+)\"$")
      string(APPEND content
        "<Hints><PropertyWidgetDecorator type=\"GenericDecorator\" mode=\"visibility\" "
        "property=\"${CMAKE_MATCH_1}\" value=\"${CMAKE_MATCH_2}\"/></Hints>\n")
    elseif (NOT attribute MATCHES "^name=")
      string(REGEX REPLACE "=.*" "" kind "${attribute}")
      string(REGEX REPLACE "[ \n]+${kind}=\"[^\"]*\"" "" tag "${tag}")
      string(REGEX REPLACE ">$" " ${attribute}>" tag "${tag}")
    endif ()
  endforeach ()
  set(${result} "${tag}${content}${closing}" PARENT_SCOPE)
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
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${input}" "${LIMPID_SETTINGS_XML}")
  file(READ "${input}" text)
  string(REGEX MATCHALL "<Setting [^>]*/>" uses "${text}")
  list(REMOVE_DUPLICATES uses)
  foreach (use IN LISTS uses)
    limpid_expand_setting("${use}" property)
    string(REPLACE "${use}" "${property}" text "${text}")
  endforeach ()
  limpid_extend_rectilinear_grids("${text}" text)
  file(CONFIGURE OUTPUT "${output}" CONTENT "${text}" @ONLY)
endfunction ()

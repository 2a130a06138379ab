# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# CPack makes an archive and, on Debian, a package of what this configuration installs: one of
# limpid-paraview, limpid-vtk and limpid-core, see LimpidInstall.cmake.

if (NOT PROJECT_IS_TOP_LEVEL)
  return ()
endif ()

# Sets <result> to the dependence on <package> in any release of one minor version.
function (limpid_depend_on_minor package major minor result)
  math(EXPR next "${minor} + 1")
  set(${result} "${package} (>= ${major}.${minor}), ${package} (<< ${major}.${next}~)" PARENT_SCOPE)
endfunction ()

find_program(LIMPID_DPKG_SHLIBDEPS dpkg-shlibdeps)
set(CPACK_GENERATOR TGZ)
if (LIMPID_DPKG_SHLIBDEPS)
  list(APPEND CPACK_GENERATOR DEB)
endif ()

set(CPACK_PACKAGE_NAME "${LIMPID_PACKAGE}")
set(CPACK_PACKAGE_FILE_NAME
  "${LIMPID_PACKAGE}-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_PACKAGE_VENDOR "Limpid developers")
set(CPACK_PACKAGE_CONTACT "Limpid developers <maintainers@example.invalid>")
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# dpkg-shlibdeps finds the packages of the libraries; here stands what no library tells.
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "Given a scalar field and the important structures in it, makes transparent\n\
what hides them, and only that, and reports how much of them can be seen.")
if (LIMPID_ENABLE_PARAVIEW)
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "see important structures inside volumes (ParaView plugin)")
  # ParaView refuses plugins that were made for another minor version.
  limpid_depend_on_minor(paraview ${ParaView_VERSION_MAJOR} ${ParaView_VERSION_MINOR}
    CPACK_DEBIAN_PACKAGE_DEPENDS)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-paraview)
elseif (LIMPID_ENABLE_VTK)
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "see important structures inside volumes (VTK modules)")
  if (VTK_WRAP_PYTHON)
    limpid_depend_on_minor(python3 ${Python3_VERSION_MAJOR} ${Python3_VERSION_MINOR}
      CPACK_DEBIAN_PACKAGE_DEPENDS)
    # Of the VTK that this one is linked to: ParaView's own, or Debian's.
    set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-vtk9)
    if (VTK_DIR MATCHES "/paraview-")
      set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-paraview)
    endif ()
  endif ()
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libglm-dev, libtbb-dev")
else ()
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "see important structures inside volumes (core library)")
  set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libglm-dev, libtbb-dev")
endif ()
include(CPack)

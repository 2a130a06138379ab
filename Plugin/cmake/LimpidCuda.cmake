# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Whether there is a CUDA backend: LIMPID_ENABLE_CUDA is AUTO, ON or OFF; the answer is LIMPID_CUDA.

set(LIMPID_ENABLE_CUDA "AUTO" CACHE STRING "CUDA backend: AUTO (if there is a compiler), ON or OFF")
set_property(CACHE LIMPID_ENABLE_CUDA PROPERTY STRINGS AUTO ON OFF)

set(LIMPID_CUDA OFF)
if (LIMPID_ENABLE_CUDA)
  include(CheckLanguage)
  check_language(CUDA)
  if (CMAKE_CUDA_COMPILER)
    # Code for every generation from Turing on that the compiler knows, and intermediate code for
    # those to come.
    if (NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
      set(CMAKE_CUDA_ARCHITECTURES all-major)
    endif ()
    set(CMAKE_CUDA_STANDARD 17)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    enable_language(CUDA)
    find_package(CUDAToolkit REQUIRED)
    set(LIMPID_CUDA ON)
    message(STATUS "Limpid: CUDA ${CMAKE_CUDA_COMPILER_VERSION}, ${CMAKE_CUDA_ARCHITECTURES}")
  elseif (NOT LIMPID_ENABLE_CUDA STREQUAL "AUTO")
    message(FATAL_ERROR "LIMPID_ENABLE_CUDA is ON, but there is no CUDA compiler (the backend is "
      "written in CUDA C++). Install one, set CMAKE_CUDA_COMPILER, or set LIMPID_ENABLE_CUDA to "
      "AUTO or OFF.")
  else ()
    message(STATUS "Limpid: no CUDA compiler, no CUDA backend")
  endif ()
endif ()

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The only file that includes GLM.

#ifndef limpid_math_Vec_h
#define limpid_math_Vec_h

#include "math/Macros.h"

#ifdef __CUDACC__
#include <cuda.h> // GLM asks for CUDA_VERSION before it marks its functions
#pragma nv_diag_suppress 20012
#endif

#include <glm/glm.hpp>

#ifdef __CUDACC__
#pragma nv_diag_default 20012
#endif

#include <cstdint>

namespace limpid
{
using Vec3 = glm::dvec3; ///< double precision: positions, directions, lengths
using Mat3 = glm::dmat3; ///< columns are the images of the axes
using Int3 = glm::ivec3;
using Index = std::int64_t; ///< any count of voxels; volumes may have more than 2^31
}

#endif

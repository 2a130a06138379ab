// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_PartialPicture_h
#define limpid_render_PartialPicture_h

#include "backend/Communicator.h"
#include "render/Renderer.h"

#include <vector>

namespace limpid
{
/// What the part of a pixel's ray gives that one rank has.
struct PartialPixel
{
  float light[3];      ///< red, green, blue, multiplied by alpha
  float transmittance; ///< 1: nothing is there
  int first;           ///< number of the first segment: parts of a ray follow each other by these
};

/**
 * Puts the parts of all rays together, which ranks have, front to back, and rounds once: the
 * picture, which every rank gets, is that of one process. `picture`: of as many pixels.
 *
 * `opaqueBelow`: see View. All ranks have to call. Per pixel and rank 20 bytes travel, and 8 back.
 */
void Compose(const Communicator& ranks, const std::vector<PartialPixel>& parts, double opaqueBelow,
  Picture& picture);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_PartialPicture_h
#define limpid_render_PartialPicture_h

#include "render/Renderer.h"

#include <vector>

namespace limpid
{
/// The contribution of one part of a ray to a pixel.
struct PartialPixel
{
  float light[3];      ///< red, green, blue, premultiplied by alpha
  float transmittance; ///< 1: empty
  int first;           ///< number of the first segment, which orders the parts of a ray
};

/**
 * Composes the partial pictures of all processes front to back, and rounds once. Each gets the
 * picture, which equals that of a process alone. `picture`: must have the same number of pixels.
 *
 * `opaqueBelow`: see View. Collective. Per pixel and process, 20 bytes are sent and 8 received.
 */
void Compose(const DrawnPart& drawn, const std::vector<PartialPixel>& parts, double opaqueBelow,
  Picture& picture);
}

#endif

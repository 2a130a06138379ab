// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ExtinctionOverlay_h
#define limpid_render_ExtinctionOverlay_h

#include "render/Fields.h"

#include <vector>

namespace limpid
{
/// The extinction that is shown, as a change of a base extinction on a grid of its own.
class ExtinctionOverlay
{
public:
  /// Moves the change by `share` towards extinction - base; `unit`: the majorant [1/length].
  void MoveTo(
    const Grid& grid, const float* base, const float* extinction, float unit, double share);

  /// Forgets change and shadow.
  void Clear();

  /// A transmittance of 1 everywhere.
  void ClearShadow();

  /// Takes a transmittance at the nodes of a grid over the same box, interpolated.
  void SetShadow(const Int3& nodes, const float* transmittance);

  /// base + change at the nodes [1/length].
  std::vector<float> ShownExtinction(const float* base) const;

  const OverlayField& Field() const { return this->Packed; }
  float Majorant() const { return this->Unit; } ///< unit of what is added [1/length]
  const Grid& Nodes() const { return this->Place; }
  bool Empty() const { return this->Packed.packed.empty(); }

private:
  Grid Place;
  OverlayField Packed;
  float Unit = 0;
};
}

#endif

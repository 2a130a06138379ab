// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The part of a volume that this process draws. Only here, and where parts are put together, does
// drawing know that there are other processes.

#ifndef limpid_render_DrawnPart_h
#define limpid_render_DrawnPart_h

#include "distributed/Neighbourhood.h"
#include "scene/AxisFilter.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"
#include "scene/RaySource.h"

#include <memory>
#include <utility>

namespace limpid
{
class HostDevice;

/**
 * The nodes of a grid that this process has: those that it owns, and ghosts around them. Arrays of
 * a part have its nodes, first axis fastest. A process that works alone has and owns the whole.
 */
class DrawnPart
{
public:
  /// All nodes of a grid, for this process alone.
  DrawnPart(const Grid& whole = Grid()) // NOLINT(google-explicit-constructor): a grid is a part
    : All(whole)
    , Own(whole)
    , Shared(ScenePiece::Whole(whole))
  {
  }

  /// The nodes of this process's box.
  DrawnPart(const Grid& whole, std::shared_ptr<const ScenePiece> piece)
    : All(whole)
    , Own(GridOf(*piece, whole))
    , Shared(std::move(piece))
  {
  }

  const Grid& Whole() const { return this->All; }
  const Grid& Nodes() const { return this->Own; }                ///< grid of the nodes here
  const NodeBox& Box() const { return this->Shared->nodes; }     ///< the nodes here, in the whole
  const NodeBox& Owned() const { return this->Shared->Owned(); } ///< in the whole
  const std::shared_ptr<const ScenePiece>& Piece() const { return this->Shared; }

  /// Throws limpid::Error if a device is to draw less than the whole.
  void RequireOn(bool device) const;

  /// Returns whether this process draws alone and has all nodes.
  bool IsWhole() const { return this->Shared->IsWhole(); }

  /// Returns whether another part has the same nodes of a grid with as many nodes.
  bool HasSameNodes(const DrawnPart& other) const;

  /// Returns whether it has all nodes, or the same as another part.
  bool Covers(const DrawnPart& other) const;

  /// Returns the whole on a grid with about 1/factor as many nodes along each axis; with factor 1,
  /// this part itself.
  DrawnPart Coarse(int factor) const;

  /// Returns the box of this part with layers of nodes around it.
  Neighbourhood Around(int layers) const { return { *this->Shared, this->All, layers }; }

  // The following are collective: all processes that draw parts of the grid call them.

  /// Returns the maximum of a non-negative number over all parts.
  float LargestOf(float here) const;

  /// Returns whether a condition holds for any part.
  bool AnyOf(bool here) const;

  /// Resamples a field of this part to all nodes of another grid.
  void Resample(const float* field, const Grid& to, float* result) const;

  /// Computes the transmittance from a source through the extinctions of all parts, see
  /// TransmittanceSweep.
  void FillTransmittance(const float* extinction, const RaySource& source, double rayDensity,
    float* transmittance) const;

private:
  Grid All;
  Grid Own;
  std::shared_ptr<const ScenePiece> Shared;
};

/// Resamples a field of a part to all nodes of another grid, on a device that holds both. GPUs draw
/// the whole only.
template <class AnyDevice>
void ResamplePart(const std::shared_ptr<AnyDevice>& device, const DrawnPart& from,
  const float* field, const Grid& to, float* result)
{
  Resample(device, from.Nodes(), field, to, result);
}

inline void ResamplePart(const std::shared_ptr<HostDevice>&, const DrawnPart& from,
  const float* field, const Grid& to, float* result)
{
  from.Resample(field, to, result);
}
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ControlGrid_h
#define limpid_optimize_ControlGrid_h

#include "optimize/SceneFields.h"

#include <string>

namespace limpid
{
/// The memory that an owner of a solver needs beside its input.
struct NeedPerNode
{
  double ofData = 0;    ///< for a node of the data, whatever the control grid is [bytes]
  double ofControl = 0; ///< for a node of the control grid [bytes]
  double measuring = 0; ///< for a node of the data, if a coarser grid's results are measured there
};

/// The resolution of the grid on which the change of the extinction is found. The change is applied
/// to the base extinction of the data (CarriedChange), so that the data keep their detail.
struct ControlGrid
{
  int factor = 1;           ///< the data have about this many times as many nodes along each axis
  double bytes = 0;         ///< needed by the process that needs most
  double limit = 0;         ///< of a process [bytes]
  bool forced = false;      ///< whether it is coarser than the data because of the limit
  bool measuresData = true; ///< whether there is room to measure results on the data, too

  /// "half resolution", or because of the limit "half resolution: 8.1 of 10 GB".
  std::string Text() const;
};

/// Chooses the resolution that settings ask for: for FinestThatFits the finest whose need is within
/// the limit, and the coarsest if none is. `shared`: the decomposition of the data, or the parts of
/// it that processes have. Throws limpid::Error if a chosen resolution does not fit a chosen limit.
/// Collective.
ControlGrid ChooseControlGrid(
  const Settings& settings, const Grid& data, const ScenePiece& shared, const NeedPerNode& need);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What all rays of a picture share: numbers and addresses, nothing else.

#ifndef limpid_render_RayScene_h
#define limpid_render_RayScene_h

#include "render/BrickDistances.h"
#include "render/Classification.h"
#include "render/OverlayPlace.h"
#include "render/RayLight.h"
#include "render/Trilinear.h"

namespace limpid
{
struct RayScene
{
  CellGrid grid;
  const float* scalars = nullptr;
  const float* filled = nullptr; ///< see ScalarField; null: all nodes are
  OpticalTable table;
  const FourPacked* gradient = nullptr; ///< and shadow, see PackedGradientNode; null: not lit
  const float* importance = nullptr;    ///< at the nodes of the scalars [0, 1]; null: not asked for
  CellGrid overlayGrid;
  const TwoPacked* overlay = nullptr; ///< see ExtinctionOverlay; null: nothing is changed
  const float* shadow = nullptr; ///< at its nodes, see ExtinctionOverlay; null: with the gradient
  BrickDistances bricks;
  BrickDistances unimportant;          ///< if the importance is asked for
  bool overlaySameNodes = false;       ///< as the scalars
  float overlayShift[3] = { 0, 0, 0 }; ///< of the scalars in the box of the overlay [nodes]
  float overlayScale[3] = { 1, 1, 1 }; ///< nodes of the overlay per node of the scalars
  float opaqueBelow = 0;
  float stepLength = 1; ///< between samples [length]
  float majorant = 0;   ///< of the transfer function [1/length]
  float addedUnit = 1;  ///< of what the overlay adds [majorant]
  RayLight light;

  void PlaceOverlay(const OverlayPlace& place, const Int3& scalarNodes)
  {
    this->overlayGrid = CellGrid(place.nodes);
    this->overlaySameNodes = place.nodes == scalarNodes && place.boxNodes == scalarNodes;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->overlayShift[axis] = float(place.first[axis]);
      this->overlayScale[axis] = float(place.Scale(axis));
    }
  }
};
}

#endif

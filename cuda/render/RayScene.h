// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Numbers and addresses that are common to all rays of a picture.

#ifndef limpid_render_RayScene_h
#define limpid_render_RayScene_h

#include "render/BrickDistances.h"
#include "render/Classification.h"
#include "render/OverlayGeometry.h"
#include "render/RayLight.h"
#include "render/ScalarNodes.h"
#include "render/Trilinear.h"
#include "scene/Structures.h"

namespace limpid
{
struct RayScene
{
  CellGrid grid;
  ScalarNodes scalars;
  const float* filled = nullptr; ///< see ScalarField; null: all nodes are
  OpticalTable table;
  const FourPacked* gradient = nullptr; ///< see PackedGradientNode; null: not lit
  const float* importance = nullptr;    ///< at the nodes of the scalars [0, 1]; null: not needed
  const StructureRow* structures = nullptr; ///< at the nodes of the scalars; null: not tinted
  const FourFloats* tints = nullptr; ///< of each row: share of its colour in that of a sample, and
                                     ///< this share of red, green and blue
  CellGrid overlayGrid;
  const TwoPacked* overlay = nullptr; ///< see ExtinctionOverlay; null: no change
  const float* shadow = nullptr;      ///< at the nodes of the overlay, see ExtinctionOverlay; null:
                                      ///< stored with the gradient
  BrickDistances bricks;
  BrickDistances unimportant;          ///< used with importance only
  bool overlaySameNodes = false;       ///< whether it has the nodes of the scalars
  float overlayShift[3] = { 0, 0, 0 }; ///< position of the scalars in the box of the overlay
                                       ///< [nodes]
  float overlayScale[3] = { 1, 1, 1 }; ///< nodes of the overlay per node of the scalars
  float opaqueBelow = 0;
  float stepLength = 1; ///< distance of samples [length]
  float majorant = 0;   ///< of the transfer function [1/length]
  float addedUnit = 1;  ///< unit of the overlay's added extinction [majorant]
  RayLight light;

  void PlaceOverlay(const OverlayGeometry& place)
  {
    this->overlayGrid = CellGrid(place.nodes);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->overlayShift[axis] = float(place.first[axis]);
      this->overlayScale[axis] = float(place.scale[axis]);
    }
  }
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How S changes when the eye goes round the volume, by differences of the march.
//
// Rays that move along with the eye sample another part of the fields after every step, and a
// difference of two such scores is mostly the difference of their sampling errors. Here the rays of
// all eyes go through the same points of a plane, so that the errors cancel but for what changes
// with the angle.

#ifndef limpid_testing_TurnedMarch_h
#define limpid_testing_TurnedMarch_h

#include "RayMarch.h"

namespace truth
{
/// An eye on a sphere, or parallel rays from there, and two ways that it can go.
struct Viewer
{
  Vector centre{ { 0, 0, 0 } }; ///< of the sphere
  double distance = 1;          ///< its radius; the box lies within half of it [length]
  bool parallel = false;
  Vector direction{ { 0, 0, 1 } }; ///< from the centre to the eye, of length 1
  Vector ways[2];                  ///< at right angles to it and to each other, of length 1
};

struct TurnedScore
{
  double score = 0;           ///< S of Eq. (32) [length^2]
  double slope[2] = { 0, 0 }; ///< per radian along either way [length^2]
  double bend[2] = { 0, 0 };  ///< by how much the slopes forward and backward differ [length^2]
};

/// By central differences over `angle` [rad] to either side.
template <class Value>
TurnedScore ScoreTurned(
  const Volume<Value>& volume, const Viewer& viewer, double angle, const Sampling& sampling);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_HighestView_h
#define limpid_viewpoint_HighestView_h

#include "viewpoint/Search.h"

namespace limpid
{
/// First step of a climb from samples of all sides, and of a move along the slope of the score
/// [radians].
constexpr double firstMove = 0.25;

/// Returns the orbit on which a camera is, round its focal point. Cameras on it see everything.
Orbit OrbitOf(const Camera& camera);

/// A view, and the number of views that were evaluated to find it.
struct HighestView
{
  ScoredView view;
  Index evaluations = 0;
};

/// Returns the view of an orbit with the highest score, by sampling all sides and climbing from the
/// best samples, which include `start`.
HighestView FindHighestView(const ViewScore& score, const Orbit& orbit, const ScoredView& start,
  const SearchProgress& progress);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of any size to measure with, and views round them.

#ifndef limpid_testing_benchmarks_Volume_h
#define limpid_testing_benchmarks_Volume_h

#include "SceneForSolver.h"

#include "viewpoint/Search.h"

namespace limpid::benchmark
{
/// [-1, 1]^3 with an important core inside a shell that hides it, seen obliquely from outside and
/// lit from above. `filling`: "onion" leaves the corners of the box empty, "dense" has a haze that
/// leaves nothing empty, "waves" is important everywhere and opaque. Throws limpid::Error on other
/// names.
SceneForSolver MakeVolume(const std::string& filling, int nodes);

/// The orbit of the viewpoint filter's defaults.
Orbit OrbitAround(const Grid& grid);

/// Directions all over a sphere, about equally far apart.
std::vector<Vec3> SpreadDirections(int count);
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long a search for viewpoints takes, and how far its scores are from the truth.

#ifndef limpid_testing_benchmarks_Viewpoints_h
#define limpid_testing_benchmarks_Viewpoints_h

#include "Options.h"
#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// The parts of a search, or the medians over several [s].
struct SearchTimes
{
  double fields = 0;     ///< the constructor: copies, spans of what is not empty
  double score = 0;      ///< of one direction, nothing else going on
  double slope = 0;      ///< likewise, and its derivative
  double directions = 0; ///< scores of all directions
  double climbs = 0;     ///< and from the best of them upwards
  double whole = 0;      ///< fields, directions and climbs
};

/// A search at the default ray density.
struct SearchResultTimes
{
  SearchTimes median;
  double spread = 0; ///< slowest less fastest whole search over the median
  Index evaluations = 0;
  double best = 0;  ///< visible share of what is important, of the best view [0, 1]
  double worst = 0; ///< ... of the worst direction
};

/// Run time against error.
struct DensityResult
{
  double rayDensity = 0;
  double score = 0;        ///< time of one direction, median [s]
  double meanError = 0;    ///< of S, relative to the march, without sign
  double largestError = 0; ///< likewise
};

/// One scene with one extinction.
struct ViewpointResult
{
  std::string scene;
  std::string field;
  Int3 nodes{ 0 };
  double filled = 0; ///< share of the nodes with extinction or importance [0, 1]
  SearchResultTimes search;
  std::vector<DensityResult> densities;
};

/// With the importance proxy and with the base extinction.
std::vector<ViewpointResult> MeasureViewpoints(const Scene& scene, const Options& options);

void WriteViewpoints(
  std::ostream& stream, const std::vector<ViewpointResult>& results, const Options& options);
}

#endif

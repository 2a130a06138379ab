// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Options_h
#define limpid_testing_benchmarks_Options_h

#include <string>
#include <vector>

namespace limpid::benchmark
{
struct Options
{
  std::vector<std::string> scenes; ///< paths of scene files
  std::vector<std::string> parts{ "quality", "time", "paper", "memory", "sizes", "threads",
    "skips" }; ///< those that a program has
  std::string output;       ///< empty: standard output
  int repeats = 5;          ///< of a timed run
  int threads = 0;          ///< zero: all
  double marchRays = 3;     ///< rays per voxel and axis of the independent march
  double paperSamples = 2;  ///< samples per voxel and axis of the paper's grids
  int paperIterations = 12; ///< timed Adam iterations of the paper's scheme, at most
  double paperSeconds = 20; ///< no further iteration of it after, but at least three [s]
  std::string json;         ///< numbers for plots; empty: none
  bool quick = false;       ///< fewer settings and repeats
  double gridSeconds = 100; ///< limit of the paper's grids, per scene [s]
  double gridGigabytes = 8; ///< ... and of their memory
  int largest = 512;        ///< nodes along each axis of the largest procedural volume

  bool Wants(const std::string& part) const;
};

/// Throws limpid::Error with the usage on what it does not understand. Without scene files, those
/// of the test data.
Options ParseOptions(const std::vector<std::string>& arguments);
}

#endif

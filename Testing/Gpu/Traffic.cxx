// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Traffic.h"

namespace limpid::benchmark
{
namespace
{
/// What things are counted in [bytes].
struct Sizes
{
  double all = 0;    ///< one field at all nodes
  double filled = 0; ///< one field at the nodes that are not empty
};

Sizes SizesOf(const Problem& problem)
{
  return { 4.0 * double(problem.grid.NodeCount()),
    4.0 * double(problem.occupancy->FilledVoxels()) };
}

void AddSums(Traffic& bytes, const Sizes& size)
{
  bytes["sums"] = 4 * size.all; // extinction and base, extinction and the last one
}

/// The derivative of one term whose optical depths are known.
void AddDerivative(Traffic& bytes, const Sizes& size)
{
  bytes["derivative"] += 5 * size.filled; // extinction, importance twice, derivative twice
}
}

Traffic PolicyTraffic(const Problem& problem)
{
  const Sizes size = SizesOf(problem);
  Traffic bytes;
  // Base, importance twice, last, derivative of the light; next is written and read.
  bytes["policy sweep"] = 7 * size.filled;
  bytes["forward sweep"] = 2 * size.filled; // extinction, importance
  AddDerivative(bytes, size);
  AddSums(bytes, size);
  return bytes;
}

Traffic AdamTraffic(const Problem& problem)
{
  const Sizes size = SizesOf(problem);
  Traffic bytes;
  bytes["set to zero"] = size.all;
  bytes["optical depths"] = 2 * size.filled; // extinction
  AddDerivative(bytes, size);
  AddDerivative(bytes, size);
  bytes["copy"] = 2 * size.all; // of the best extinction
  // Base is read; derivative, which becomes the change, both means and the extinction are read and
  // written.
  bytes["Adam"] = 9 * size.all;
  AddSums(bytes, size);
  bytes["sums"] = 3 * size.all; // the change is a field already
  return bytes;
}
}

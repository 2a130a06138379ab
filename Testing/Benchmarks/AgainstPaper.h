// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Adam iterations of the paper's scheme to the letter beside ours: same process, same threads, same
// compiler flags, in turns.

#ifndef limpid_testing_benchmarks_AgainstPaper_h
#define limpid_testing_benchmarks_AgainstPaper_h

#include "Options.h"
#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// What a number of Adam iterations on the full resolution led to.
struct AdamResult
{
  double seconds = 0;   ///< median of an iteration
  double baseScore = 0; ///< S of the base extinction by its own means [length^2]
  double score = 0;     ///< S after the iterations by its own means   [length^2]
  double march = 0;     ///< the same by the independent march         [length^2]
  double energy = 0;    ///< F after the iterations by Limpid's sweeps, world units
};

struct PaperResult
{
  std::string scene;
  Int3 cameraCells{ 0 };
  Int3 lightCells{ 0 };
  int timed = 0;        ///< iterations, after one that warms up
  double baseMarch = 0; ///< S of the base extinction by the march [length^2]
  AdamResult paper;
  AdamResult limpid;
};

PaperResult MeasureAgainstPaper(const Scene& scene, const Options& options);
void WriteAgainstPaper(
  std::ostream& stream, const std::vector<PaperResult>& results, const Options& options);
}

#endif

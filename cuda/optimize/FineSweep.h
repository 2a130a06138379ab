// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FineSweep_h
#define limpid_optimize_FineSweep_h

#include "energy/Score.h"
#include "optimize/CoarseFields.h"
#include "optimize/Solver.h"

namespace limpid
{
/// What is seen at the resolution of the data: of the base extinction, of a result, and at most.
struct ScoresOnData
{
  Score base;
  Score result;
  Ceiling ceiling;    ///< see CeilingOfScores
  double seconds = 0; ///< for sweep and scores
};

/// Whether SweepData can improve a result with these settings: policy sweeps are wanted, a single
/// camera counts, the light has no extinction of its own, and nothing is to stay near another
/// result.
bool CanSweepData(const Settings& settings);

/**
 * Improves a change that was found on a coarser grid by one policy sweep of the camera at the
 * resolution of the data (Documentation/Method.md, section on coarser grids). Of the fields of the
 * data, only the extinction is in memory, and a derivative if the camera is in the volume; all
 * others are made where a sweep is. A process alone only; on the processor.
 *
 * `majorant`: upper bound of the extinction [1/length]; `progress`: if it returns false, the result
 * is the change as it was found; `extinction`: out: the result [1/length].
 */
void SweepData(const Grid& data, const FieldsOfBox& ofBox, const CarriedChange& change,
  float majorant, const Progress& progress, float* extinction);

/// SweepData, whose result is then measured in the same way. It is the base extinction if that
/// shows more of the important structures.
ScoresOnData SweepAndMeasureData(const Grid& data, const FieldsOfBox& ofBox,
  const CarriedChange& change, float majorant, const Progress& progress, float* extinction);
}

#endif

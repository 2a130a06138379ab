// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StartingImportance.h"

#include "SharedArray.h"

#include <vector>

namespace limpid
{
ImportanceRamp StartingImportance(const SharedArray& array)
{
  const std::vector<double> samples = array.Samples(mostSamplesOfQuantiles);
  return samples.empty() ? ImportanceRamp() : RampOf(samples, array.FiniteRange());
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StartingImportance.h"

#include "Choices.h"
#include "SettingsConversion.h"
#include "SharedArray.h"
#include "vtkVisibilitySettings.h"

#include "vtkImageData.h"

#include "math/Require.h"

#include <sstream>
#include <vector>

namespace limpid
{
ImportanceRamp StartingImportance(const SharedArray& array)
{
  const std::vector<double> sorted = array.Samples(mostSamplesOfQuantiles);
  const ImportanceRamp first =
    sorted.empty() ? ImportanceRamp() : RampOf(sorted, array.FiniteRange());
  return first.IsKnown()
    ? CleanRamp(first, sorted, array.SamplesAbove(first.begin, mostSamplesOfQuantiles))
    : first;
}

ScalarMapping MappingOf(const ImportanceRamp& ramp)
{
  LIMPID_REQUIRE(ramp.IsKnown(),
    "No importance is set, and all scalars are equal (no important structures can be derived from "
    "them). Choose an importance array, or set ImportanceFunction.");
  return Ramp(ramp.begin, ramp.end);
}

std::string WarningOf(const ImportanceRamp& ramp)
{
  std::ostringstream text;
  text << "No importance is set: the largest scalars are taken as important, from " << ramp.begin
       << " (0) to " << ramp.end
       << " (1) (what is cleared depends on this). If that is right, give ImportanceFunction these "
          "two points and turn UseImportanceFunction on; else choose an importance array.";
  return text.str();
}

bool ImportanceChoice::IsAssumed(vtkVisibilitySettings* settings) const
{
  return this->IsOfScalars() && !settings->GetUseImportanceFunction();
}

FieldSource ImportanceChoice::Source(
  vtkVisibilitySettings* settings, const ScalarMapping& assumed, vtkImageData* image) const
{
  if (this->labels.array)
  {
    return this->labels;
  }
  FieldSource source = this->IsOfScalars() ? this->scalars : this->array;
  LIMPID_REQUIRE(source.array,
    "The importance array \"" << this->name
                              << "\" is not among the input's numeric arrays (it defines which "
                                 "structures to reveal). Choose one of these: "
                              << ArrayNames(image) << ".");
  if (!this->IsOfScalars())
  {
    source.component = settings->GetImportanceComponent();
    RequireComponent("ImportanceComponent", source.array, source.component);
  }
  source.mapping = this->IsAssumed(settings) ? assumed : ImportanceMapping(settings);
  return source;
}
}

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "methods/Method.h"

#include "math/Require.h"

#include <cmath>
#include <tuple>

namespace limpid
{
const MethodInfo& InfoOf(Method method)
{
  static const MethodInfo all[methodCount] = {
    { "Optimized", Compositing::FrontToBack, true, false, true },
    { "Ordinary", Compositing::FrontToBack, false, false, true },
    { "Viola 2004", Compositing::FromObject, false, false, false },
    { "Marchesin 2010", Compositing::ImportanceMean, false, false, false },
    { "Ament 2017", Compositing::FrontToBack, false, true, true },
  };
  return all[static_cast<int>(method)];
}

void AmentWeights::Require() const
{
  const struct
  {
    const char* name;
    double value;
  } weights[] = { { "exponent", this->exponent }, { "weight against occluders", this->occluders },
    { "weight against the background", this->background },
    { "weight against occluders for the shadows", this->lightOccluders },
    { "weight against the background for the shadows", this->lightBackground } };
  for (const auto& weight : weights)
  {
    LIMPID_REQUIRE(std::isfinite(weight.value) && weight.value >= 0,
      "The " << weight.name << " of Ament 2017 is " << weight.value
             << " (a negative value would hide important structures). Set it to zero or more.");
  }
  LIMPID_REQUIRE(std::isfinite(this->regularization) && this->regularization > 0,
    "The regularization of Ament 2017 is "
      << this->regularization
      << " (at zero, the smallest weight would remove everything). Set it above zero.");
  LIMPID_REQUIRE(this->smoothingPasses >= 0 && this->smoothingPasses <= 100,
    "The number of smoothing passes of Ament 2017 is "
      << this->smoothingPasses
      << " (it cannot be negative, and 100 passes smooth everything away). Set 0 to 100.");
}

bool operator==(const AmentWeights& one, const AmentWeights& other)
{
  const auto values = [](const AmentWeights& a)
  {
    return std::tie(a.exponent, a.regularization, a.occluders, a.background, a.lightOccluders,
      a.lightBackground, a.smoothingPasses);
  };
  return values(one) == values(other);
}
}

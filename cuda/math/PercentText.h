// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_PercentText_h
#define limpid_math_PercentText_h

#include <iomanip>
#include <sstream>
#include <string>

namespace limpid
{
/// Returns a share as a text for the user: "33.3 %".
inline std::string PercentText(double share)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << 100 * share << " %";
  return text.str();
}
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transfer functions as the rays read them.

#ifndef limpid_render_Classification_h
#define limpid_render_Classification_h

#include "render/OpticalTable.h"
#include "render/Renderer.h"

#include <vector>

namespace limpid
{
/// Transfer functions as rays read them, see OpticalTable.
class Classification
{
public:
  Classification() = default;
  explicit Classification(const TransferFunctions& functions);

  /// Numbers and addresses, which hold as long as this object stays where it is.
  OpticalTable<FourFloats> Table() const;

  float Majorant() const { return this->LargestExtinction; } ///< [1/length]
  bool Empty() const { return this->Values.empty(); }

  const std::vector<FourFloats>& Entries() const { return this->Values; }
  const std::vector<FourFloats>& IntegralsOfEntries() const { return this->Integrals; }
  const std::vector<float>& LargestOfEntries() const { return this->Maxima; }

private:
  float Low = 0;
  float Scale = 1;
  float LargestExtinction = 0;
  std::vector<FourFloats> Values; ///< extinction [majorant], red, green, blue
  std::vector<FourFloats> Integrals;
  std::vector<float> Maxima; ///< see OpticalTable
};
}

#endif

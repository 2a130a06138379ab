// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_MadeFields_h
#define limpid_sweep_MadeFields_h

#include "scene/FieldView.h"
#include "scene/NodeBox.h"

#include <vector>

namespace limpid
{
/// Fields that do not fit into memory: sweeps have them made a box of nodes at a time. Each is
/// known by an address, which is never read.
class MadeFields
{
public:
  virtual ~MadeFields() = default;

  /// Whether an address stands for one of these fields.
  virtual bool Has(const float* field) const = 0;

  /// Makes some of the fields in a box.
  virtual void MoveTo(const NodeBox& box, const std::vector<const float*>& fields) = 0;

  /// Returns a field that was made by the last MoveTo, valid in its box.
  virtual FieldView Values(const float* field) = 0;
};
}

#endif

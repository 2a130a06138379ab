// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ProblemFields_h
#define limpid_optimize_ProblemFields_h

#include "backend/CompiledDevice.h"
#include "optimize/Problem.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The fields of a problem in device memory. The processor reads the caller's arrays; a GPU keeps
/// copies as long as the scene exists.
template <class AnyDevice>
struct ProblemFields
{
  using Field = BorrowedArray<AnyDevice, float>;

  ProblemFields(const std::shared_ptr<AnyDevice>& device, const Problem& problem)
    : where(device)
  {
    const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
    this->base = Field(device, problem.baseExtinction, count, "the base extinction");
    this->importance = Field(device, problem.importance, count, "the importance");
    this->nodeImportance =
      Field(device, problem.nodeImportance, problem.nodeImportance ? count : 0, "the importance");
  }

  std::shared_ptr<AnyDevice> where;
  Field base;           ///< [1/length]
  Field importance;     ///< [0, 1]
  Field nodeImportance; ///< [0, 1]; empty if the problem has none

  /// Returns the fields of a problem. They are copied on first use, and again for another device.
  static std::shared_ptr<ProblemFields> Of(
    const std::shared_ptr<AnyDevice>& device, const Problem& problem)
  {
    if (!problem.resident || !Field::isCopy)
    {
      return std::make_shared<ProblemFields>(device, problem);
    }
    return problem.resident->fields.template On<ProblemFields>(device, problem);
  }
};

/// All pulls of a problem, with references in device memory.
template <class AnyDevice>
class PullsOnDevice
{
public:
  /// `base`: the base extinction on the device.
  PullsOnDevice(const std::shared_ptr<AnyDevice>& device, const Problem& problem, const float* base)
    : List(problem.Pulls())
  {
    const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
    for (Pull& pull : this->List)
    {
      if (pull.reference == problem.baseExtinction)
      {
        pull.reference = base;
        continue;
      }
      if (pull.onDevice)
      {
        continue;
      }
      this->References.emplace_back(device, pull.reference, count, "a reference extinction");
      pull.reference = this->References.back().Data();
    }
  }

  const std::vector<Pull>& All() const { return this->List; }

private:
  std::vector<Pull> List;
  std::vector<BorrowedArray<AnyDevice, float>> References;
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a pipeline says while a filter updates it.

#ifndef limpid_UpstreamErrors_h
#define limpid_UpstreamErrors_h

#include "vtkSmartPointer.h"

#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkCallbackCommand;
class vtkObject;

namespace limpid
{
/// As long as it lives, the errors of all algorithms in front of a filter, and of their executives,
/// are not shown but kept, so that the filter can say in one message what went wrong, and where.
class UpstreamErrors
{
public:
  explicit UpstreamErrors(vtkAlgorithm* filter);
  ~UpstreamErrors();
  UpstreamErrors(const UpstreamErrors&) = delete;
  void operator=(const UpstreamErrors&) = delete;

  /// The first error of an algorithm, without where in the source code it is; empty if there was
  /// none.
  const std::string& First() const { return this->Text; }

private:
  void Observe(vtkObject* object);
  void ObserveInputsOf(vtkAlgorithm* filter);
  bool IsObserved(vtkObject* object) const;

  vtkSmartPointer<vtkCallbackCommand> Command;
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> Observed; // and its tag
  std::string Text;
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Collects the errors of a pipeline while a filter updates it.

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
/// During the lifetime of this object, errors of all algorithms upstream of a filter, and of their
/// executives, are kept instead of shown. The filter can then report in one message what failed,
/// and where.
class UpstreamErrors
{
public:
  explicit UpstreamErrors(vtkAlgorithm* filter);
  ~UpstreamErrors();
  UpstreamErrors(const UpstreamErrors&) = delete;
  void operator=(const UpstreamErrors&) = delete;

  /// Returns the first error of an algorithm, without its position in the source code; empty if
  /// none.
  const std::string& First() const { return this->Text; }

private:
  void Observe(vtkObject* object);
  void ObserveInputsOf(vtkAlgorithm* filter);
  bool IsObserved(vtkObject* object) const;

  vtkSmartPointer<vtkCallbackCommand> Command;
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> Observed; // objects, tags
  std::string Text;
};
}

#endif

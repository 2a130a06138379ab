// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_PropertyPrinter_h
#define limpid_PropertyPrinter_h

#include "vtkIndent.h"

#include <ostream>

namespace limpid
{
/// Prints properties for PrintSelf, one a line.
struct PropertyPrinter
{
  std::ostream& os;
  vtkIndent indent;

  template <class Value>
  void operator()(const char* name, const Value& value) const
  {
    this->os << this->indent << name << ": " << value << "\n";
  }

  template <class Value>
  void operator()(const char* name, const Value (&vector)[3]) const
  {
    this->os << this->indent << name << ": " << vector[0] << " " << vector[1] << " " << vector[2]
             << "\n";
  }
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_PropertyPrinter_h
#define limpid_PropertyPrinter_h

#include "vtkIndent.h"

#include <cstddef>
#include <ostream>

namespace limpid
{
/// Prints properties for PrintSelf, one per line.
struct PropertyPrinter
{
  std::ostream& os;
  vtkIndent indent;

  template <class Value>
  void operator()(const char* name, const Value& value) const
  {
    this->os << this->indent << name << ": " << value << "\n";
  }

  template <class Value, std::size_t Count>
  void operator()(const char* name, const Value (&vector)[Count]) const
  {
    this->os << this->indent << name << ":";
    for (const Value& value : vector)
    {
      this->os << " " << value;
    }
    this->os << "\n";
  }
};
}

#endif

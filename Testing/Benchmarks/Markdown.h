// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Numbers and tables as Markdown.

#ifndef limpid_testing_benchmarks_Markdown_h
#define limpid_testing_benchmarks_Markdown_h

#include "math/Vec.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
std::string Fixed(double value, int decimals);
std::string Significant(double value, int digits); ///< never in powers of ten
std::string Milliseconds(double seconds);
std::string Deviation(double value, double truth); ///< "+0.12 %"
std::string Sizes(const Int3& nodes);              ///< "3 × 4 × 5"

/// A table; its first column has names, the others numbers.
class Table
{
public:
  explicit Table(const std::vector<std::string>& headings);
  void Add(const std::vector<std::string>& cells);
  void Write(std::ostream& stream) const;

private:
  std::vector<std::vector<std::string>> Rows; // first the headings
};
}

#endif

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Markdown.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace limpid::benchmark
{
namespace
{
void WriteRow(std::ostream& stream, const std::vector<std::string>& cells)
{
  for (const std::string& cell : cells)
  {
    stream << "| " << cell << ' ';
  }
  stream << "|\n";
}
}

std::string Fixed(double value, int decimals)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string Significant(double value, int digits)
{
  if (value == 0 || !std::isfinite(value))
  {
    return Fixed(value, 0);
  }
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return Fixed(value, std::max(0, digits - before));
}

std::string Milliseconds(double seconds)
{
  return Significant(1e3 * seconds, 3);
}

std::string Deviation(double value, double truth)
{
  std::ostringstream text;
  text << std::showpos << std::fixed << std::setprecision(2)
       << 100 * (value - truth) / std::abs(truth) << " %";
  return text.str();
}

std::string Sizes(const Int3& nodes)
{
  std::ostringstream text;
  text << nodes.x << " × " << nodes.y << " × " << nodes.z;
  return text.str();
}

Table::Table(const std::vector<std::string>& headings)
{
  this->Rows.push_back(headings);
}

void Table::Add(const std::vector<std::string>& cells)
{
  LIMPID_EXPECT(cells.size() == this->Rows.front().size());
  this->Rows.push_back(cells);
}

void Table::Write(std::ostream& stream) const
{
  std::vector<std::string> rule(this->Rows.front().size(), "---:");
  rule.front() = "---";
  stream << '\n';
  WriteRow(stream, this->Rows.front());
  WriteRow(stream, rule);
  for (std::size_t row = 1; row < this->Rows.size(); ++row)
  {
    WriteRow(stream, this->Rows[row]);
  }
  stream << '\n';
}
}
